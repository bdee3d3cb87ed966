#!/usr/bin/env bash
# Measures speed and memory and prints them beside the floors. Leave the machine alone meanwhile.
#   launch_scripts/bench.sh                          prints
#   launch_scripts/bench.sh --enforce                also fails below a floor
#   launch_scripts/bench.sh --repeats 5 --duration 7200
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh --tests >&2
exec build/tests/run_speed "$@"
