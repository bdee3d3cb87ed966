#!/usr/bin/env bash
# Prints the project's whole table of figures with its bands: the paper's traffic without guidance, and what guidance
# gains, over 10 seeds each. Exit code 1 if a figure lies outside. Takes a few minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
launch_scripts/setup.sh --tests >&2
failed=0
echo "== without guidance =="
build/tests/paper_bands || failed=1
echo
echo "== with arrive_on_green, 1800 veh/h =="
build/tests/guidance_bands --seeds 10 || failed=1
exit $failed
