"""Rounds of runs side by side whose pace is switched while they go on; prints a table of how they ended.

Exit code: 0 if every run ended well, without an anomaly and after at least one switch of its pace; 1 if not, and the
results of those that did not are kept; 2 usage; 130 or 143 if interrupted, after the runs have been ended.
"""

import argparse
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

LUKOU = pathlib.Path(__file__).resolve().parents[2] / "build/bin/lukou"
PACES = ("fast", "max", "medium", "max", "slow", "max")  # as on the paper's panel, and back to full speed; from fast on
SLOW_S = 1.0  # wall time at a pace that is not max
RETRY_S = 0.2


class Interrupted(Exception):
    pass


class PacedRun:
    """A run as processes, and the switches of its pace that its clock has answered."""

    def __init__(self, round_number, scenario, options, folder):
        self.round = round_number
        self.scenario = scenario
        self.name = f"{pathlib.Path(scenario).stem}-{round_number}"
        self.run_id = f"{self.name}-{os.getpid()}"
        self.result = folder / self.name
        self.log = open(folder / f"{self.name}.log", "w+", encoding="utf-8")
        self.switches = 0
        self.begin_s = time.monotonic()
        self.wall_s = 0.0
        self.due_s = self.begin_s + SLOW_S
        self.every_s = options.every
        command = [str(LUKOU), "run", str(scenario), "--quiet", "--run-id", self.run_id, "--pace", PACES[0],
                   "--out", str(self.result), "--duration", str(options.duration), "--seed", str(round_number), "--set",
                   f"run.warmup_s={min(2000.0, options.duration / 2)}"]
        self.process = subprocess.Popen(command, stdout=self.log, stderr=self.log, start_new_session=True)

    def over(self):
        if self.process.poll() is None:
            return False
        if not self.wall_s:
            self.wall_s = time.monotonic() - self.begin_s
        return True

    def switch_if_due(self):
        if self.over() or time.monotonic() < self.due_s:
            return
        pace = PACES[(self.switches + 1) % len(PACES)]
        try:
            asked = subprocess.run([str(LUKOU), "ctl", self.run_id, "pace", pace], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, timeout=30, check=False)
            answered = asked.returncode == 0
        except subprocess.TimeoutExpired:
            answered = False
        # A pace that was not taken, since the run is not up yet, is asked for again.
        self.switches += int(answered)
        self.due_s = time.monotonic() + (RETRY_S if not answered else self.every_s if pace == "max" else SLOW_S)

    def end(self):
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(30)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()

    def outcome(self):
        """What the table and the verdict need; of a run without a summary only its exit code."""
        found = {"exit": self.process.returncode, "simulated_s": None, "ended_by": "?", "collisions": None}
        try:
            summary = json.loads((self.result / "summary.json").read_text(encoding="utf-8"))
            manifest = json.loads((self.result / "manifest.json").read_text(encoding="utf-8"))
            found.update(simulated_s=summary["simulated_s"], collisions=summary["collisions"],
                         ended_by=manifest["ended_by"])
        except (OSError, ValueError, KeyError):
            pass
        ended = str(found["ended_by"])
        stopped_by_one = ended.startswith("anomaly") and not (ended == "anomaly:collision" and found["collisions"])
        found["anomalies"] = None if found["collisions"] is None else found["collisions"] + int(stopped_by_one)
        return found


def row(cells):
    widths = (5, 14, 11, 9, 8, 8, 9, 4)
    print("| " + " | ".join(str(cell).rjust(width) for cell, width in zip(cells, widths)) + " |", flush=True)


def report(run, duration_s):
    """Prints the run's row; whether it is as it should be."""
    found = run.outcome()

    def text(value):
        return "?" if value is None else f"{value:g}"

    row((run.round, pathlib.Path(run.scenario).stem, text(found["simulated_s"]), f"{run.wall_s:.1f}", run.switches,
         found["ended_by"], text(found["anomalies"]), found["exit"]))
    good = found["exit"] == 0 and found["anomalies"] == 0 and found["simulated_s"] == duration_s and run.switches > 0
    if good:
        shutil.rmtree(run.result)
    else:
        run.log.seek(0)
        print(f"{run.log.read()}kept: {run.result}", file=sys.stderr)
    return good


def round_of(number, options, folder):
    runs = []
    try:
        for scenario in options.scenarios:
            runs.append(PacedRun(number, scenario, options, folder))
        while not all([run.over() for run in runs]):
            for run in runs:
                run.switch_if_due()
            time.sleep(0.05)
        return sum(not report(run, options.duration) for run in runs)
    finally:
        for run in runs:
            run.end()
            run.log.close()


def arguments():
    parser = argparse.ArgumentParser(description="Runs side by side, their pace switched while they go on.")
    parser.add_argument("scenarios", nargs="+", help="started at once, in each round")
    parser.add_argument("--rounds", type=int, default=10, help="one after the other, round n with seed n [10]")
    parser.add_argument("--first", type=int, default=1, help="number of the first round [1]")
    parser.add_argument("--duration", type=float, required=True, help="simulated seconds of each run")
    parser.add_argument("--every", type=float, default=5.0, help="wall seconds at full speed between switches [5]")
    options = parser.parse_args()
    if options.rounds < 1 or options.first < 1 or not options.duration > 0 or not options.every > 0:
        parser.error("--rounds, --first, --duration and --every are greater than 0")
    return options


def interrupted(number, _frame):
    raise Interrupted(number)


def main():
    options = arguments()
    signal.signal(signal.SIGINT, interrupted)
    signal.signal(signal.SIGTERM, interrupted)
    head = ("round", "scenario", "simulated s", "wall s", "switches", "ended", "anomalies", "exit")
    row(head)
    row(["---"] * len(head))
    bad = 0
    folder = pathlib.Path(tempfile.mkdtemp(prefix="lukou-stability-"))
    try:
        for number in range(options.first, options.first + options.rounds):
            bad += round_of(number, options, folder)
    except Interrupted as stop:
        return 128 + stop.args[0]
    total = options.rounds * len(options.scenarios)
    if not bad:
        shutil.rmtree(folder)
    print(f"{total - bad} of {total} runs ended well, without an anomaly")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
