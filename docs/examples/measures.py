#!/usr/bin/env python3
"""Recomputes the figures of a run from an exported folder alone, with nothing but the standard library.

    lukou run paper --set record.log=FULL --out run
    lukou export run --format csv --out run-csv
    python3 docs/examples/measures.py run-csv

Reads run.csv, cars.csv and trajectories.csv (docs/export.md) and prints one JSON object with the fields of
summary.json of the same names. Definitions: docs/results.md.
"""

import csv
import json
import math
import sys
from pathlib import Path

STEP_S = 0.1
TTC_S = 3.0
OVER_AFTER_S = 1.0  # an encounter is over when its threshold has not been met for so long


def rows(file):
    with open(file, newline="") as stream:
        yield from csv.DictReader(stream)


def theoretical_time_s(run, speed):
    """Entrance to stop line: full acceleration up to the limit, then constant."""
    limit, acceleration, length = run["speed_limit_mps"], run["acceleration_max_mps2"], run["approach_length_m"]
    if speed >= limit:
        return length / limit
    ramp_m = (limit**2 - speed**2) / (2 * acceleration)
    if ramp_m >= length:
        return (math.sqrt(speed**2 + 2 * acceleration * length) - speed) / acceleration
    return (limit - speed) / acceleration + (length - ramp_m) / limit


def free_time_s(run, speed, desired):
    """Entrance to the end of the exit if nobody hinders the driver: dv/dt = (desired - v) / tau within the limit of
    acceleration."""
    length = run["approach_length_m"] + run["exit_length_m"]
    tau, most = run["speed_relaxation_s"], run["acceleration_max_mps2"]
    passed_s = 0.0
    if abs(desired - speed) > most * tau:
        acceleration = math.copysign(most, desired - speed)
        soft = desired - acceleration * tau  # from here on less than the limit
        passed_s = (soft - speed) / acceleration
        length -= (speed + soft) / 2 * passed_s
        speed = soft
    low, high = 0.0, length / desired + tau
    for _ in range(200):  # bisection: the way driven grows with the time
        middle = (low + high) / 2
        way_m = desired * middle + (speed - desired) * tau * (1 - math.exp(-middle / tau))
        low, high = (middle, high) if way_m < length else (low, middle)
    return passed_s + low


class Car:
    def __init__(self, row):
        self.entered_s = float(row["entered_s"])
        self.speed_mps = float(row["entered_speed_mps"])
        self.desired_mps = float(row["desired_speed_mps"])
        self.crossed_s = float(row["crossed_s"]) if row["crossed_s"] else None
        self.left_s = float(row["left_s"]) if row["left_s"] else None
        self.stops = 0
        self.standing_steps = 0
        self.armed = True  # was faster than the upper threshold since the last stop
        self.encounter = None  # (car ahead, time) of the last instant with a small TTC


def watch(run, cars, trajectories):
    """Follows every car through time; returns how many encounters had a TTC below 3 s."""
    encounters = 0
    ahead = None
    for row in trajectories:
        time_s, vehicle, speed = float(row["time_s"]), row["vehicle"], float(row["speed_mps"])
        position, lane, car = float(row["position_m"]), row["lane"], cars[vehicle]
        if row["past_line"] == "0":
            if speed < run["stop_speed_mps"]:
                car.standing_steps += 1
                car.stops += car.armed
                car.armed = False
            elif speed > run["stop_rearm_speed_mps"]:
                car.armed = True
        # Cars stand lane after lane, front to back.
        if ahead and ahead["time_s"] == time_s and ahead["lane"] == lane:
            closing = speed - ahead["speed"]
            gap = ahead["position"] - position - run["vehicle_length_m"]
            if closing > 0 and gap < TTC_S * closing:
                other, last_s = car.encounter or (None, -math.inf)
                if other != ahead["vehicle"] or time_s - last_s > OVER_AFTER_S + STEP_S / 2:
                    encounters += 1
                car.encounter = (ahead["vehicle"], time_s)
        ahead = {"time_s": time_s, "lane": lane, "vehicle": vehicle, "speed": speed, "position": position}
    return encounters


def mean(values):
    values = list(values)
    return math.fsum(values) / len(values) if values else None


def measures(folder):
    run = {row["name"]: float(row["value"]) for row in rows(folder / "run.csv")}
    if run["period_s"] != STEP_S:
        sys.exit(f"{folder / 'run.csv'}: period_s is {run['period_s']}; export with --period 0.1s (record.log=FULL)")
    cars = {row["vehicle"]: Car(row) for row in rows(folder / "cars.csv")}
    ttc = watch(run, cars, rows(folder / "trajectories.csv"))
    counted = [car for car in cars.values() if car.entered_s >= run["warmup_s"] and car.crossed_s is not None]
    crossings = sum(car.crossed_s is not None and car.crossed_s >= run["warmup_s"] for car in cars.values())
    hours = (run["simulated_s"] - run["warmup_s"]) / 3600
    return {
        "cars_measured": len(counted),
        "throughput_veh_per_h": crossings / hours / 4 if hours > 0 else None,
        "mean_delta_s": mean(c.crossed_s - c.entered_s - theoretical_time_s(run, c.speed_mps) for c in counted),
        "mean_delay_s": mean(
            c.left_s - c.entered_s - free_time_s(run, c.speed_mps, c.desired_mps)
            for c in counted
            if c.left_s is not None
        ),
        "mean_stop_time_s": mean(c.standing_steps * STEP_S for c in counted),
        "stops_per_vehicle": mean(c.stops for c in counted),
        "stops_total": sum(c.stops for c in cars.values()),
        "ttc": ttc,
    }


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    print(json.dumps(measures(Path(sys.argv[1])), indent=2))
