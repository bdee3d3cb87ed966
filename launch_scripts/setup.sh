#!/usr/bin/env bash
# Installs what is missing (Debian 12 packages) and builds the release preset into build/. Quick when there is nothing to do.
#   launch_scripts/setup.sh            programs only
#   launch_scripts/setup.sh --tests    also everything that launch_scripts/test.sh needs
#   launch_scripts/setup.sh --bench    programs, and SUMO, the peer of launch_scripts/bench.sh
#   launch_scripts/setup.sh --full     also what test.sh --full needs
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(g++ make cmake ninja-build ccache cyclonedds-dev cyclonedds-tools libprotobuf-dev protobuf-compiler libzstd-dev libsqlite3-dev zlib1g-dev libspdlog-dev
          libcli11-dev nlohmann-json3-dev libssl-dev librandom123-dev pybind11-dev python3-dev python3-numpy libboost1.81-dev libgtest-dev librapidcheck-dev libbenchmark-dev)
# The console's page is built with npm: a package of its own in Debian, inside nodejs elsewhere.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)
tier=${1:-}
case "$tier" in
  "" ) ;;
  --tests ) packages+=(clang-format-19 chromium fonts-wqy-zenhei) ;;
  --bench ) packages+=(sumo) ;;
  --full ) packages+=(clang-format-19 clang-tidy-19 time chromium fonts-wqy-zenhei
                      iproute2 nftables openssh-client faketime sumo slurm-wlm munge) ;;
  * ) echo "setup.sh: unknown argument $tier; use --tests, --bench or --full" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  sudo=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "setup.sh: missing packages: ${missing[*]}; install them as root" >&2; exit 1; }
    sudo=(sudo)
  fi
  echo "installing: ${missing[*]}" >&2
  # The lists are refreshed only when they do not know a package, or know one that is gone.
  install() { "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" >&2; }
  if ! apt-cache show "${missing[@]}" >/dev/null 2>&1 || ! install; then
    "${sudo[@]}" apt-get update >&2
    install
  fi
fi

# SUMO may have come after the last look for it.
sumo_waits() { [ -x /usr/bin/sumo ] && ! grep -q '^SUMO_LIBRARY:FILEPATH=/' build/CMakeCache.txt; }
[ -f build/build.ninja ] && ! sumo_waits || cmake --preset release >/dev/null
if [ -n "$tier" ] && [ "$tier" != --bench ]; then
  cmake --build build
else
  cmake --build build --target lukou_programs
fi
