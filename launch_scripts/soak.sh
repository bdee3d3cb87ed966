#!/usr/bin/env bash
# The paper's section 5.1: ten runs of 36,000 s one after the other, paces switched in between.
#   launch_scripts/soak.sh
#   launch_scripts/soak.sh --rounds 5; launch_scripts/soak.sh --rounds 5 --first 6    the same in halves
#   launch_scripts/soak.sh --rounds 1 --duration 600 --every 2                a short form
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh >&2
exec python3 launch_scripts/stability/paced_runs.py --duration 36000 "$@" paper
