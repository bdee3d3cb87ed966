#!/usr/bin/env python3
"""Redraws the paper's figure 6, mean stop time over time, from an exported folder (Debian: python3-pandas,
python3-matplotlib).

    lukou run paper --set record.log=FULL --out run
    lukou export run --format csv --out run-csv
    python3 docs/examples/figure6.py run-csv figure6.svg

Reads run.csv, cars.csv and trajectories.csv (docs/export.md). Stop time is the time slower than the stop speed before
the stop line, of all cars so far; the mean is over the cars that have entered so far (docs/results.md, stop_time.csv).
"""

import sys
from pathlib import Path

import matplotlib
import pandas as pd

STEP_S = 0.1


def mean_stop_time_s(folder):
    """By step: index is the time in s, values are s per car."""
    run = pd.read_csv(folder / "run.csv", index_col="name")["value"]
    cars = pd.read_csv(folder / "cars.csv")
    paths = pd.read_csv(folder / "trajectories.csv", usecols=["time_s", "past_line", "speed_mps"])
    standing = (paths["past_line"] == 0) & (paths["speed_mps"] < float(run["stop_speed_mps"]))
    total_s = STEP_S * standing.groupby(paths["time_s"]).sum().cumsum()
    entered = cars.groupby("entered_s").size().cumsum().reindex(total_s.index, method="ffill")
    return total_s / entered


def main():
    if len(sys.argv) != 3:
        sys.exit("usage: figure6.py EXPORTED_FOLDER PICTURE")
    matplotlib.use("Agg")
    curve = mean_stop_time_s(Path(sys.argv[1]))
    axes = curve.plot(xlabel="time [s]", ylabel="mean stop time [s per car]", grid=True, legend=False)
    axes.set_ylim(bottom=0)
    axes.figure.savefig(sys.argv[2])
    print(f"{curve.iloc[-1]:.6f} s per car after {curve.index[-1]:g} s")


if __name__ == "__main__":
    main()
