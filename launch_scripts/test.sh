#!/usr/bin/env bash
# Installs what is missing, builds, runs the tests.
#   launch_scripts/test.sh           the fast tier: unit, integration, short figures, verify, a few faults; sanitizers
#   launch_scripts/test.sh --full    everything: all figures, long runs, -O0, clang-tidy, thread sanitizer, benchmarks
set -euo pipefail
cd "$(dirname "$0")/.."
tier=${1:-}
case "$tier" in
  "" ) launch_scripts/setup.sh --tests ;;
  --full ) launch_scripts/setup.sh --full ;;
  * ) echo "test.sh: unknown argument $tier; use --full or nothing" >&2; exit 2 ;;
esac

# Address and undefined-behaviour sanitizers over unit and integration tests.
[ -f build-asan/build.ninja ] || cmake --preset asan >/dev/null
cmake --build build-asan --target lukou_sanitized_tests
ctest --test-dir build-asan -L 'unit|integration' --output-on-failure -j2

if [ "$tier" = --full ]; then
  [ -f build-tsan/build.ninja ] || cmake --preset tsan >/dev/null
  cmake --build build-tsan --target lukou_sanitized_tests
  ctest --test-dir build-tsan -L 'unit|integration' --output-on-failure -j2
  [ -f build-debug/build.ninja ] || cmake --preset debug >/dev/null
  cmake --build build-debug --target lukou
  ctest --test-dir build --output-on-failure
else
  ctest --test-dir build -L fast --output-on-failure
fi
