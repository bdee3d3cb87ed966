#!/usr/bin/env bash
# What the console's page costs and how quick it is: size, first picture, echo, frames; or, with --minutes N, the memory.
set -euo pipefail
cd "$(dirname "$0")/.."
exec node tests/browser/benchmark.mjs "$@"
