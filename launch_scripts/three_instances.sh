#!/usr/bin/env bash
# The paper's section 5.2: three different simulations at once, 7200 s each, ten times, paces switched in between.
#   launch_scripts/three_instances.sh
#   launch_scripts/three_instances.sh --rounds 1 --duration 600 --every 2     a short form
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh >&2
exec python3 launch_scripts/stability/paced_runs.py --duration 7200 "$@" \
  paper launch_scripts/stability/short_cycle.textproto launch_scripts/stability/main_road.textproto
