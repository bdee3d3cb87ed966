#!/usr/bin/env bash
# Builds docker/Dockerfile and smoke-runs it: the demo, and one run as docker/compose.yaml has it, a process per container.
#   launch_scripts/containers.sh
# With Docker it uses Docker. Without, as root, buildah: from a Debian that debootstrap makes, in build-containers/, with the
# network of this host while it builds and none but loopback while it runs. Some 20 minutes and 6 GB the first time.
set -euo pipefail
cd "$(dirname "$0")/.."
fail() { echo "containers.sh: $*" >&2; exit 1; }

if docker info >/dev/null 2>&1; then
  docker build -f docker/Dockerfile -t lukou .
  docker run --rm lukou run paper --duration 600
  LUKOU_NAME=smoke-$$ LUKOU_ARGUMENTS="paper --duration 600" docker compose -f docker/compose.yaml up --abort-on-container-failure
  docker compose -f docker/compose.yaml down --volumes
  echo "containers.sh: built, ran the demo, ran a process per container"
  exit 0
fi

[ "$(id -u)" -eq 0 ] || fail "there is no Docker engine; building without one needs root"
missing=()
for tool in buildah:buildah debootstrap:debootstrap unshare:util-linux ip:iproute2; do
  command -v "${tool%%:*}" >/dev/null || missing+=("${tool##*:}")
done
python3 -c 'import yaml' 2>/dev/null || missing+=(python3-yaml)
if [ ${#missing[@]} -gt 0 ]; then
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends "${missing[@]}" >&2
fi

work=$PWD/build-containers
mkdir -p "$work"
export BUILDAH_ISOLATION=chroot
driver=vfs
! grep -qw overlay /proc/filesystems || driver=overlay
store=(buildah --root "$work/store" --runroot "$work/run" --storage-driver "$driver")
base=docker.io/library/debian:bookworm-slim
if ! "${store[@]}" inspect --type image "$base" >/dev/null 2>&1; then
  [ -f "$work/base/etc/debian_version" ] || debootstrap --variant=minbase bookworm "$work/base"
  # Where packages come from, with security updates, is as on this host.
  container=$("${store[@]}" from scratch)
  "${store[@]}" add "$container" "$work/base" / >/dev/null
  if [ -f /etc/apt/sources.list.d/debian.sources ]; then
    "${store[@]}" add "$container" /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list.d/ >/dev/null
    "${store[@]}" run "$container" -- rm -f /etc/apt/sources.list
  fi
  "${store[@]}" commit --rm "$container" "$base" >/dev/null
fi
# npm's way to its registry, while the page is built; a part of no image.
way=()
if [ -f "$HOME/.npmrc" ]; then
  { grep -v '^cafile' "$HOME/.npmrc" || true; echo "cafile=/root/certificates.pem"; } > "$work/npmrc"
  way=(--volume "$work/npmrc:/root/.npmrc:ro" --volume /etc/ssl/certs/ca-certificates.crt:/root/certificates.pem:ro)
fi
"${store[@]}" bud --layers --pull-never --network host --format docker "${way[@]}" -f docker/Dockerfile -t lukou .
"${store[@]}" images
python3 tests/containers/smoke.py docker/compose.yaml -- "${store[@]}"
python3 tests/containers/smoke.py docker/compose.yaml --profile three -- "${store[@]}"
