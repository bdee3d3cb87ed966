#!/usr/bin/env bash
# Exit code 0 if every source file of the project looks as .clang-format says.
set -euo pipefail
cd "$(dirname "$0")/../.."
find . \( -name .git -o -path './build*' -o -path ./result \) -prune -o \( -name '*.cpp' -o -name '*.hpp' \) -print0 |
  sort -z | xargs -0 clang-format-19 --dry-run -Werror
