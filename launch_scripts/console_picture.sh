#!/usr/bin/env bash
# Makes docs/console.png, the README's picture of the console, anew.
set -euo pipefail
cd "$(dirname "$0")/.."
exec node tests/browser/picture.mjs docs/console.png
