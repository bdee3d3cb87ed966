"""Where the time of a step goes, as two Markdown tables.

    step_account.py LUKOU in-process       instructions of each part, counted by callgrind (package valgrind)
    step_account.py LUKOU processes        processor time of each process and library, sampled by perf (linux-perf, root)

In the first, the rows of a node are disjoint parts and a remainder, counted between two runs of different length: what a
run does once is in neither. In the second, `waiting` is the time in which the core of the run was idle.
"""

import pathlib
import re
import subprocess
import sys
import tempfile

SHORT_STEPS = 2000  # by then the road is full
STEPS = {"in-process": 5000, "processes": 12000}

# Node: its step function, and disjoint parts of it.
NODES = {
    "traffic engine": (
        "lukou::EngineNode::step(",
        {
            "model: following, lights, arrivals": "lukou::traffic::Engine::step(",
            "BSM frames, built and encoded": "lukou::say_safety_messages(",
            "RSC frames, decoded": "lukou::EngineNode::hear(",
            "report to the recorder": "lukou::report(lukou::traffic::Engine",
        },
    ),
    "RSU": (
        "lukou::RsuNode::step(",
        {
            "BSM frames, decoded and matched to the map": "lukou::RsuNode::hear(",
            "algorithm": "lukou::RsuNode::answer(",
            "RSC frames, encoded": "lukou::RsuNode::say_guidance(",
            "SPAT frames, encoded": "lukou::RsuNode::say_spat(",
        },
    ),
    "recorder": (
        "lukou::RecorderNode::step(",
        {
            "safety measures": "lukou::SafetyMeasures::add(lukou::TrafficBatch",
            "run measures": "lukou::RunMeasures::add(lukou::TrafficBatch",
            "picture for observers": "lukou::RunPicture::add(",
        },
    ),
    "signal controller": ("lukou::SignalControllerNode::step(", {}),
}


def run_words(lukou: str, mode: str, steps: int, folder: str) -> list[str]:
    duration = f"{steps / 10}"
    words = [lukou, "run", "paper", "--quiet", "--mode", mode, "--duration", duration, "--out", f"{folder}/result"]
    return words + ["--set", "vehicles.equipped_ratio=0.5"]


def output(words: list[str]) -> str:
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{words[0]} ended with code {done.returncode}:\n{done.stderr}")
    return done.stdout


def inclusive_counts(lukou: str, steps: int) -> list[tuple[int, str]]:
    """Instructions of each function with all that it calls, in a run of so many steps."""
    with tempfile.TemporaryDirectory() as folder:
        counts = f"{folder}/counts"
        run = run_words(lukou, "in-process", steps, folder)
        output(["valgrind", "--tool=callgrind", f"--callgrind-out-file={counts}", *run])
        text = output(["callgrind_annotate", "--inclusive=yes", "--threshold=100", counts])
    found = re.findall(r"^\s*([\d,]+) \([^)]*\)\s+\S*?:((?:\(anonymous namespace\)|\w).*)$", text, re.MULTILINE)
    return [(int(count.replace(",", "")), name) for count, name in found]


def instructions(lukou: str) -> None:
    long_run = inclusive_counts(lukou, STEPS["in-process"])
    short_run = inclusive_counts(lukou, SHORT_STEPS)

    def of(function: str) -> int:
        most = [max((n for n, name in run if name.startswith(function)), default=0) for run in (long_run, short_run)]
        return most[0] - most[1]

    total = of("lukou::launch::run_in_process(") - of("lukou::launch::finish_result(")
    steps = STEPS["in-process"] - SHORT_STEPS
    print(f"{total / steps:.0f} instructions a step, between step {SHORT_STEPS} and step {STEPS['in-process']}\n")
    print("| node | part | instructions a step | share |\n|---|---|---|---|")
    told = 0

    def row(node: str, part: str, count: int) -> None:
        print(f"| {node} | {part} | {count / steps:.0f} | {100 * count / total:.1f} % |")

    for node, (function, parts) in NODES.items():
        whole = of(function)
        told += whole
        counted = {part: of(name) for part, name in parts.items()}
        for part, count in counted.items():
            row(node, part, count)
        row(node, "the rest" if parts else "all", whole - sum(counted.values()))
    row("", "sum of the rows", told)


def processor_time(lukou: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        samples = f"{folder}/samples"
        run = ["taskset", "-c", "0", *run_words(lukou, "processes", STEPS["processes"], folder)]
        output(["perf", "record", "-C", "0", "-F", "1999", "-o", samples, "--", *run])
        text = output(["perf", "script", "-i", samples, "-F", "pid,comm,ip,sym,dso"])
    lines = [re.match(r"\s*(.{1,15}?)\s+(\d+)\s+[0-9a-f]+ .*\((.*)\)$", line) for line in text.splitlines()]
    found = [(m[2], pathlib.Path(m[3]).name) for m in lines if m]
    # Threads of Cyclone have names of their own; the process has that of its program.
    program_of = {pid: name for pid, name in found if name.startswith("lukou")}
    others = "others"
    samples_of: dict[tuple[str, str], int] = {}
    for pid, library in found:
        program = "waiting" if pid == "0" else program_of.get(pid, others)
        part = "kernel" if "kernel" in library else "Cyclone DDS" if "ddsc" in library else "itself and its libraries"
        samples_of[program, part] = samples_of.get((program, part), 0) + 1
    strangers = sum(n for (program, _), n in samples_of.items() if program == others)
    total = sum(samples_of.values()) - strangers
    print(f"{100 * strangers / len(found):.1f} % of the core went to other programs and is left out\n")
    parts = ["itself and its libraries", "Cyclone DDS", "kernel"]
    print("| process | " + " | ".join(parts) + " | sum |\n|---|---|---|---|---|")

    def row(name: str, counts: list[int]) -> None:
        print(f"| {name} | " + " | ".join(f"{100 * n / total:.1f} %" for n in [*counts, sum(counts)]) + " |")

    counts_of = {program: [samples_of.get((program, part), 0) for part in parts] for program, _ in samples_of}
    counts_of.pop(others, None)
    for program, counts in sorted(counts_of.items(), key=lambda item: -sum(item[1])):
        row(program, counts)
    row("sum", [sum(column) for column in zip(*counts_of.values())])


def main() -> int:
    if len(sys.argv) != 3 or sys.argv[2] not in STEPS:
        print(__doc__, file=sys.stderr)
        return 2
    if sys.argv[2] == "in-process":
        instructions(sys.argv[1])
    else:
        processor_time(sys.argv[1])
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
