"""Reads what `lukou export` writes with readers of other makers, and recomputes the summary from it."""

import csv
import json
import os
import sqlite3
import struct
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
LUKOU = Path(os.environ.get("LUKOU_BIN", ROOT / "build/bin")) / "lukou"
DURATION_S = 300
# Seed 3 has encounters with a TTC below 3 s.
SETS = ["record.log=FULL", "record.guidance=true", "radio.preset=PC5_MODE4", "run.warmup_s=60", "vehicles.equipped_ratio=0.4"]


def lukou(*arguments, check=True, cwd=None):
    done = subprocess.run([LUKOU, *map(str, arguments)], capture_output=True, text=True, cwd=cwd)
    if check and done.returncode != 0:
        raise AssertionError(f"{arguments}: exit code {done.returncode}\n{done.stderr}")
    return done


def run(folder, duration_s, sets):
    options = [part for one in sets for part in ("--set", one)]
    lukou("run", "paper", "--mode", "in-process", "--quiet", "--seed", 3, "--duration", duration_s, "--out", folder, *options)


def table(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


class Exports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="lukou-exports-")
        cls.folder = Path(cls.temporary.name)
        cls.result = cls.folder / "run"
        run(cls.result, DURATION_S, SETS)
        cls.csv = cls.folder / "csv"
        lukou("export", cls.result, "--format", "csv", "--out", cls.csv)
        cls.trajectories = table(cls.csv / "trajectories.csv")

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def at(self, time_s):
        return [row for row in self.trajectories if float(row["time_s"]) == time_s]

    def test_a_name_without_a_folder_is_written_here(self):
        for arguments, name in [
            (("plot", self.result, "--figure", "stop-time"), "stop-time.svg"),
            (("plot", self.result, "--figure", "delay", "--out", "figure.svg"), "figure.svg"),
            (("export", self.result, "--format", "sqlite", "--what", "cars", "--out", "cars.sqlite"), "cars.sqlite"),
            (("report", self.result, "--out", "page.html"), "page.html"),
        ]:
            with self.subTest(arguments=arguments):
                lukou(*arguments, cwd=self.folder)
                self.assertGreater((self.folder / name).stat().st_size, 0)
        drawn = xml.etree.ElementTree.parse(self.folder / "figure.svg").getroot()
        self.assertEqual(drawn.tag, "{http://www.w3.org/2000/svg}svg")
        self.assertEqual(lukou("plot", self.result, "--figure", "stop-time", cwd=self.folder, check=False).returncode, 5)

    def test_the_example_recomputes_the_summary_from_csv_alone(self):
        example = ROOT / "docs/examples/measures.py"
        done = subprocess.run([sys.executable, example, self.csv], capture_output=True, text=True, check=True)
        recomputed = json.loads(done.stdout)
        summary = json.loads((self.result / "summary.json").read_text())
        for count in ("cars_measured", "stops_total"):
            self.assertEqual(recomputed[count], summary[count], count)
        self.assertEqual(recomputed["ttc"], summary["safety"]["ttc"])
        self.assertGreater(recomputed["ttc"], 0)
        self.assertGreater(recomputed["stops_total"], 20)
        for mean in (
            "throughput_veh_per_h",
            "mean_delta_s",
            "mean_delay_s",
            "mean_stop_time_s",
            "stops_per_vehicle",
        ):
            self.assertAlmostEqual(recomputed[mean], summary[mean], delta=1e-8, msg=mean)

    def test_csv_holds_every_car_as_car_csv_does(self):
        cars = {row["vehicle"]: row for row in table(self.csv / "cars.csv")}
        finished = table(self.result / "car.csv")
        self.assertGreater(len(finished), 300)
        for row in finished:
            car = cars[row["vehicle"]]
            self.assertEqual((car["lane"], car["equipped"]), (row["lane"], row["equipped"]))
            self.assertAlmostEqual(float(car["left_s"]), float(row["left_s"]), delta=1e-6)
            crossed_s = float(row["entered_s"]) + float(row["act_time_s"])
            self.assertAlmostEqual(float(car["crossed_s"]), crossed_s, delta=2e-6)
        still_there = [car for car in cars.values() if not car["left_s"]]
        self.assertEqual({car["vehicle"] for car in still_there}, {row["vehicle"] for row in self.at(DURATION_S)})

    def test_csv_holds_signals_messages_and_advice(self):
        green_s = {}
        end_s = {}
        for row in table(self.csv / "signals.csv"):
            self.assertEqual(float(row["from_s"]), end_s.get(row["lane"], 0.0))  # no gap
            end_s[row["lane"]] = float(row["to_s"])
            if row["state"] == "green":
                green_s[row["lane"]] = green_s.get(row["lane"], 0) + end_s[row["lane"]] - float(row["from_s"])
        self.assertEqual(set(end_s.values()), {float(DURATION_S)})
        # Cycles of 90 s, 45 s green each: in 300 s one side has 150 s, the other 150 s.
        self.assertEqual(len(green_s), 12)
        self.assertAlmostEqual(green_s["WC"] + green_s["SC"], DURATION_S, delta=1e-6)

        radio = table(self.result / "radio.csv")
        sent = sum(int(row["sent"]) for row in radio if row["direction"] == "uplink")
        receptions = table(self.csv / "receptions.csv")
        self.assertEqual(len(receptions), sent)
        heard = sum(int(row["heard"]) for row in radio if row["direction"] == "uplink")
        in_time = [row for row in receptions if row["fate"] == "heard"]
        self.assertLessEqual(abs(len(in_time) - heard), 200)  # those of the last steps are under way
        messages = table(self.csv / "messages.csv")
        self.assertEqual({row["kind"] for row in messages if row["direction"] == "uplink"}, {"bsm"})
        self.assertTrue(all(bytes.fromhex(row["payload"]) for row in messages[:1000]))

        advice = table(self.csv / "advice.csv")
        summary = json.loads((self.result / "summary.json").read_text())
        again = sum(row["again"] == "1" for row in advice)
        applied = sum(row["fate"] == "applied" for row in advice)
        self.assertEqual(applied - again, summary["advice_applied"])

    def test_sqlite_holds_what_csv_holds(self):
        file = self.folder / "run.sqlite"
        lukou("export", self.result, "--format", "sqlite", "--out", file)
        with sqlite3.connect(file) as database:
            self.assertEqual(database.execute("PRAGMA integrity_check").fetchone(), ("ok",))
            names = {name for (name,) in database.execute("SELECT name FROM sqlite_master WHERE type='table'")}
            self.assertEqual(names, {path.stem for path in self.csv.iterdir()})
            for name in names - {"messages"}:
                columns = [row[1] for row in database.execute(f"PRAGMA table_info({name})")]
                with open(self.csv / f"{name}.csv", newline="") as stream:
                    rows = csv.reader(stream)
                    self.assertEqual(columns, next(rows))
                    for ours, other in zip(database.execute(f"SELECT * FROM {name}"), rows, strict=True):
                        self.assertEqual([self.cell(value) for value in ours], [self.cell(text) for text in other])
        database.close()

    @staticmethod
    def cell(value):
        """A number as a number, whatever it was written as; nothing as nothing."""
        if value is None or value == "":
            return None
        try:
            return float(value)
        except ValueError:
            return value

    def test_fcd_is_what_sumo_tools_read(self):
        file = self.folder / "run.fcd.xml"
        lukou("export", self.result, "--format", "fcd", "--period", "1s", "--out", file)
        root = xml.etree.ElementTree.parse(file).getroot()
        self.assertEqual(root.tag, "fcd-export")
        self.assertEqual([float(step.get("time")) for step in root], [float(s) for s in range(DURATION_S + 1)])
        cars = {car.get("id"): car for car in root[200]}
        rows = self.at(200.0)
        self.assertEqual(set(cars), {row["vehicle"] for row in rows})
        lanes = set()
        for row in rows:
            car = cars[row["vehicle"]]
            for ours, theirs in (("x_m", "x"), ("y_m", "y"), ("speed_mps", "speed")):
                self.assertAlmostEqual(float(row[ours]), float(car.get(theirs)), delta=6e-4)
            lanes.add(car.get("lane"))
        self.assertIn("W_1", lanes)
        self.assertTrue(lanes <= {f"{a}_{i}" for a in "WSEN" for i in range(3)} | {f"{a}{t}_exit_0" for a in "WSEN" for t in "LCR"})

    def test_ssam_is_a_sequence_of_whole_records(self):
        file = self.folder / "run.trj"
        lukou("export", self.result, "--format", "ssam", "--period", "500ms", "--out", file)
        data = file.read_bytes()
        kind, endian, version = struct.unpack_from("<Bcf", data)
        self.assertEqual((kind, endian, round(version, 4)), (0, b"L", 1.04))
        kind, metric, scale, west, south, east, north = struct.unpack_from("<BBfiiii", data, 6)
        self.assertEqual((kind, metric, scale), (1, 1, 1.0))
        place = 6 + 22
        steps = {}
        while place < len(data):
            if data[place] == 2:
                (time_s,) = struct.unpack_from("<f", data, place + 1)
                cars = steps[round(time_s, 3)] = {}
                place += 5
            else:
                self.assertEqual(data[place], 3)
                vehicle, link, lane, *numbers = struct.unpack_from("<iiB8f", data, place + 1)
                cars[str(vehicle)] = (link, lane, *numbers)
                place += 42
        self.assertEqual(sorted(steps), [step / 2 for step in range(2 * DURATION_S + 1)])
        rows = self.at(150.5)
        self.assertEqual(set(steps[150.5]), {row["vehicle"] for row in rows})
        for row in rows:
            link, lane, x, y, back_x, back_y, length, width, speed, acceleration = steps[150.5][row["vehicle"]]
            self.assertTrue(west <= min(x, back_x) and max(x, back_x) <= east and south <= min(y, back_y) <= north)
            self.assertAlmostEqual(x, float(row["x_m"]), delta=1e-3)
            self.assertAlmostEqual(speed, float(row["speed_mps"]), delta=1e-4)
            self.assertAlmostEqual(acceleration, float(row["acceleration_mps2"]), delta=1e-4)
            chord = ((x - back_x) ** 2 + (y - back_y) ** 2) ** 0.5
            self.assertTrue(0.9 * length < chord < length + 1e-3)
            if row["past_line"] == "0":
                self.assertEqual((link, lane), (1 + "WSEN".index(row["lane"][0]), 1 + "LCR".index(row["lane"][1])))
        self.assertEqual(round(width, 3), 1.8)

    def test_refuses_what_the_record_does_not_hold_and_replaces_nothing(self):
        second = self.folder / "second"
        run(second, 20, ["record.log=SECOND"])
        done = lukou("export", second, "--format", "fcd", "--period", "0.5s", check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--period 0.5s: must be whole seconds", done.stderr)
        done = lukou("export", second, "--format", "csv", "--what", "messages", check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("record.log=SECOND; an export of messages needs FULL", done.stderr)
        done = lukou("export", second, "--format", "ssam", "--what", "signals", check=False)
        self.assertEqual(done.returncode, 2)
        none = self.folder / "none"
        run(none, 5, [])
        done = lukou("export", none, "--format", "sqlite", check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--set record.log=", done.stderr)
        for out, form in (("taken.csv", "sqlite"), ("csv", "csv")):
            (self.folder / "taken.csv").write_text("mine")
            done = lukou("export", second, "--format", form, "--out", self.folder / out, check=False)
            self.assertEqual(done.returncode, 5, done.stderr)
        self.assertEqual((self.folder / "taken.csv").read_text(), "mine")
        self.assertEqual([path.name for path in self.folder.glob("*unfinished*")], [])

    def test_a_log_without_its_end_gives_its_whole_chunks(self):
        cut = self.folder / "cut"
        cut.mkdir()
        (cut / "scenario.textproto").write_bytes((self.result / "scenario.textproto").read_bytes())
        log = (self.result / "run.mcap").read_bytes()
        (cut / "run.mcap").write_bytes(log[: len(log) // 2])
        out = self.folder / "cut-csv"
        lukou("export", cut, "--format", "csv", "--what", "trajectories", "--out", out)
        rows = table(out / "trajectories.csv")
        self.assertGreater(len(rows), 1000)
        self.assertEqual(rows, self.trajectories[: len(rows)])


if __name__ == "__main__":
    unittest.main()
