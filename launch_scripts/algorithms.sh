#!/usr/bin/env bash
# Prints what each shipped RSU algorithm gains and costs, as the tables of docs/algorithms.md.
#   launch_scripts/algorithms.sh [--seeds 10] [--flow 1800] [--ratio 0.7]
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh --tests >&2
exec build/tests/algorithm_gains "$@"
