#!/usr/bin/env bash
# Measures speed and memory beside floors, goals and SUMO, and prints one table; exit code 1 below a floor.
# Leave the machine alone meanwhile (about twelve minutes on two cores).
#   launch_scripts/bench.sh                            without SUMO unless it is there
#   launch_scripts/bench.sh --peers                    installs Debian's sumo first
#   launch_scripts/bench.sh --write                    also puts the table into docs/performance.md
#   launch_scripts/bench.sh --repeats 5 --duration 3600 --long 36000
set -euo pipefail
cd "$(dirname "$0")/.."
peers=()
write=
arguments=()
for argument in "$@"; do
  case "$argument" in
    --peers ) peers=(--bench) ;;
    --write ) write=yes ;;
    * ) arguments+=("$argument") ;;
  esac
done
launch_scripts/setup.sh "${peers[@]}" >&2
cmake --build build --target run_speed >&2
export LUKOU_SCENARIOS=$PWD/launch_scripts/scenarios
table=$(mktemp)
trap 'rm -f "$table"' EXIT
code=0
build/tests/run_speed --enforce "${arguments[@]}" | tee "$table" || code=$?
if [ -n "$write" ] && [ "$code" -le 1 ] && grep -q '^| what' "$table"; then
  versions=$({ dpkg-query -W -f='${Package} ${Version}\n' cyclonedds-dev sumo g++ 2>/dev/null || true; } | paste -sd, | sed 's/,/, /g')
  {
    sed '/<!-- table -->/q' docs/performance.md
    printf '\n%s. Linux %s, %s.\n\n' "$(head -1 "$table")" "$(uname -r)" "$versions"
    grep '^|' "$table"
    printf '\n'
    sed -n '/<!-- end of table -->/,$p' docs/performance.md
  } > docs/performance.md.new
  mv docs/performance.md.new docs/performance.md
fi
exit "$code"
