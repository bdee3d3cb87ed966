#!/usr/bin/env bash
# clang_tidy.sh BUILD: exit code 0 if clang-tidy finds nothing in the programs' sources. On all processors; a quarter of an
# hour on two.
set -euo pipefail
build=$1
cd "$(dirname "$0")/../.."
find common services -name '*.cpp' -print0 | sort -z |
  xargs -0 -P "$(nproc)" -n 1 clang-tidy-19 -p "$build" --quiet
