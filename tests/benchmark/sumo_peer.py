"""Writes the intersection, the signals and the cars of a Lukou run as input of SUMO.

    sumo_peer.py CAR_CSV DURATION_S FOLDER

Geometry, plan and driver figures are those of the scenario `paper`; the cars are those of a run's car.csv: same entrance
time, lane and on-board unit ("e..." equipped, "h..." not). Let that run last a few minutes longer than DURATION_S, since
car.csv holds only cars that have crossed the line. Opposed left turns do not wait for a gap, as in Lukou: every movement
of a green axis has 'G', and there are no lanes inside the junction, whose length is added to the exits.
"""

import csv
import pathlib
import subprocess
import sys

APPROACH_M = 500
EXIT_M = 123  # 100 m and the mean way through the junction
SPEED_MPS = 60 / 3.6
GREEN_S = 42
YELLOW_S = 3  # the plan PAPER has none, but SUMO's cars would brake with 9 m/s2 and more
ARMS = {"W": (-1, 0), "S": (0, -1), "E": (1, 0), "N": (0, 1)}
COURSE = "WSEN"  # counter-clockwise, so that the arm to the right of an entering car is the next one
SUMO_LANE = {"R": 0, "C": 1, "L": 2}  # from the kerb
STEPS_TO = {"R": 1, "C": 2, "L": 3}  # arms further in COURSE

NETWORK = ["nodes.nod.xml", "edges.edg.xml", "turns.con.xml", "lights.tll.xml"]


def target(arm: str, turn: str) -> str:
    return COURSE[(COURSE.index(arm) + STEPS_TO[turn]) % 4]


def turns() -> list[tuple[str, str]]:
    return [(arm, turn) for arm in COURSE for turn in "RCL"]


def nodes() -> str:
    lines = ['<node id="J" x="0" y="0" type="traffic_light"/>']
    for arm, (x, y) in ARMS.items():
        lines.append(f'<node id="{arm}_from" x="{x * (APPROACH_M + 16)}" y="{y * (APPROACH_M + 16)}"/>')
        lines.append(f'<node id="{arm}_to" x="{x * (EXIT_M + 16)}" y="{y * (EXIT_M + 16)}"/>')
    return "\n".join(["<nodes>", *lines, "</nodes>"])


def edges() -> str:
    lines = []
    for arm in ARMS:
        form = f'numLanes="3" speed="{SPEED_MPS:.4f}"'
        lines.append(f'<edge id="{arm}_in" from="{arm}_from" to="J" length="{APPROACH_M}" {form}/>')
        lines.append(f'<edge id="{arm}_out" from="J" to="{arm}_to" length="{EXIT_M}" {form}/>')
    return "\n".join(["<edges>", *lines, "</edges>"])


def connections(light: str = "") -> str:
    lines = []
    for index, (arm, turn) in enumerate(turns()):
        at = f'from="{arm}_in" to="{target(arm, turn)}_out" fromLane="{SUMO_LANE[turn]}" toLane="{SUMO_LANE[turn]}"'
        lines.append(f"<connection {at}" + (f' tl="{light}" linkIndex="{index}"' if light else "") + "/>")
    return "\n".join(lines)


def lights() -> str:
    phases = []
    for axis in ("WE", "SN"):
        for aspect, duration_s in (("G", GREEN_S), ("y", YELLOW_S)):
            state = "".join(aspect if arm in axis else "r" for arm, _ in turns())
            phases.append(f'<phase duration="{duration_s}" state="{state}"/>')
    logic = ['<tlLogic id="J" type="static" programID="0" offset="0">', *phases, "</tlLogic>"]
    return "\n".join(["<tlLogics>", *logic, connections("J"), "</tlLogics>"])


def cars(car_csv: pathlib.Path, duration_s: float) -> str:
    with car_csv.open(newline="") as file:
        entered = sorted(csv.DictReader(file), key=lambda row: float(row["entered_s"]))
    # Krauss with the paper's limits; desired speeds as equation of the paper, spacing 5.5 m, safe time 1.98 s.
    driver = 'length="4.5" minGap="1" accel="3" decel="3" tau="1.98" speedFactor="normc(0.9,0.05,0.75,1)"'
    lines = [f'<vType id="{kind}" {driver}/>' for kind in ("equipped", "human")]
    for arm, turn in turns():
        lines.append(f'<route id="{arm}{turn}" edges="{arm}_in {target(arm, turn)}_out"/>')
    for row in entered:
        at_s = float(row["entered_s"])
        if at_s >= duration_s:
            break
        kind = "equipped" if row["equipped"] == "1" else "human"
        lane = row["lane"]
        name = kind[0] + row["vehicle"]
        how = f'departLane="{SUMO_LANE[lane[1]]}" departSpeed="max" departPos="base"'
        lines.append(f'<vehicle id="{name}" type="{kind}" route="{lane}" depart="{at_s:.1f}" {how}/>')
    return "\n".join(["<routes>", *lines, "</routes>"])


def main() -> int:
    car_csv, duration_s, folder = pathlib.Path(sys.argv[1]), float(sys.argv[2]), pathlib.Path(sys.argv[3])
    contents = [nodes(), edges(), "<connections>\n" + connections() + "\n</connections>", lights()]
    for name, text in zip(NETWORK, contents):
        (folder / name).write_text(text + "\n")
    (folder / "cars.rou.xml").write_text(cars(car_csv, duration_s) + "\n")
    options = ["--node-files", "--edge-files", "--connection-files", "--tllogic-files"]
    files = [word for option, name in zip(options, NETWORK) for word in (option, str(folder / name))]
    command = ["netconvert", *files, "--no-internal-links", "--no-turnarounds", "-o", str(folder / "paper.net.xml")]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        print(f"netconvert failed:\n{done.stdout}{done.stderr}", file=sys.stderr)
    return done.returncode


if __name__ == "__main__":
    raise SystemExit(main())
