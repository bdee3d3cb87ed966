#!/usr/bin/env bash
# Prints how the gain of guidance degrades with latency, loss and bursts on the downlink (the table of the README).
#   launch_scripts/robustness.sh [--seeds 3]
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh --tests >&2
exec build/tests/robustness "$@"
