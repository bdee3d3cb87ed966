#!/usr/bin/env bash
# The main job: installs what is missing, builds, runs the paper's scenario over DDS as separate processes, prints a
# summary and where the results lie. Arguments go to `lukou run paper`, for example: demo.sh --duration 3600 --seed 7
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/setup.sh" >&2
exec "$here/../build/bin/lukou" run paper "$@"
