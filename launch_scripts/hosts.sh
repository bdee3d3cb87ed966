#!/usr/bin/env bash
# Runs a scenario with its processes on several hosts: the clock, the recorder and what is not named stay here.
#   launch_scripts/hosts.sh --hosts FILE [SCENARIO] [arguments of lukou run]
#       FILE: lines `role = host`, as ssh knows the host; # begins a comment. The same build at the same path on all.
#       LUKOU_SSH: the ssh command, by default `ssh`
#   launch_scripts/hosts.sh --namespaces N [--loss PERCENT] [SCENARIO] [arguments of lukou run]
#       tries it out on this host: N network namespaces on a bridge, RSUs on the second, the signal controller on the
#       last; PERCENT of all packets between them are lost. Needs root.
# docs/hosts.md says what hosts need, and what can go wrong.
set -euo pipefail
bin=$(cd "$(dirname "$0")/.." && pwd)/build/bin
fail() { echo "hosts.sh: $*" >&2; exit 2; }

hosts='' namespaces='' loss=0
while [ $# -gt 0 ]; do
  case "$1" in
    --hosts ) hosts=${2:?--hosts needs a file}; shift 2 ;;
    --namespaces ) namespaces=${2:?--namespaces needs a number}; shift 2 ;;
    --loss ) loss=${2:?--loss needs a percentage}; shift 2 ;;
    * ) break ;;
  esac
done
if [ -n "$hosts" ] && [ -n "$namespaces" ] || [ -z "$hosts$namespaces" ]; then
  fail "give either --hosts FILE or --namespaces N; the first lines of this script explain both"
fi
[ -x "$bin/lukou" ] || fail "$bin/lukou is missing; launch_scripts/setup.sh builds it"
scenario=paper
if [ $# -gt 0 ] && [[ $1 != -* ]]; then scenario=$1; shift; fi

run_over_ssh() {
  read -ra ssh <<< "${LUKOU_SSH:-ssh}"
  # Never asks, and notices a dead host within three seconds.
  ssh+=(-o BatchMode=yes -o ServerAliveInterval=1 -o ServerAliveCountMax=3)
  [ -r "$hosts" ] || fail "$hosts: cannot be read"
  local -A role_host=() address=()
  local -a prefixes=() line=0 role host
  while IFS= read -r text || [ -n "$text" ]; do
    line=$((line + 1))
    text=${text%%#*}
    [ -n "${text//[[:space:]]/}" ] || continue
    IFS='= ' read -r role host rest <<< "$text"
    if [[ $text != *=* ]] || [ -z "$host" ] || [ -n "$rest" ]; then fail "$hosts:$line: must be \`role = host\`"; fi
    [ -z "${role_host[$role]:-}" ] || fail "$hosts:$line: $role is here for the second time"
    role_host[$role]=$host
  done < "$hosts"
  [ ${#role_host[@]} -gt 0 ] || fail "$hosts: names no role"

  local here own='' ours
  here=$(cd "$bin" && sha256sum lukou lukou-rsu lukou-traffic-engine lukou-signal-controller)
  for host in "${role_host[@]}"; do
    [ -z "${address[$host]:-}" ] || continue
    local name found there
    name=$("${ssh[@]}" -G "$host" | sed -n 's/^hostname //p')
    found=$(getent ahostsv4 "$name" | awk 'NR == 1 { print $1 }') || true
    [ -n "$found" ] || fail "$host: no address is known for $name"
    address[$host]=$found
    ours=$(ip -4 route get "$found" | sed -n 's/.* src \([0-9.]*\).*/\1/p')
    [ -z "$own" ] || [ "$own" = "$ours" ] || fail "$host is reached from $ours, another host from $own: all must share a network"
    own=$ours
    there=$("${ssh[@]}" "$host" "cd '$bin' && sha256sum lukou lukou-rsu lukou-traffic-engine lukou-signal-controller") ||
      fail "$host: cannot be reached, or has no build in $bin"
    [ "$there" = "$here" ] || fail "$host: the build in $bin is another one than here; copy it: rsync -a '$bin/' '$host:$bin/'"
  done
  for role in "${!role_host[@]}"; do
    prefixes+=(--prefix "$role=${ssh[*]} ${role_host[$role]}")
  done
  local peers
  peers=$(printf '%s\n' "$own" "${address[@]}" | sort -u | paste -sd,)
  echo "hosts: $peers" >&2
  exec "$bin/lukou" run "$scenario" --peers "$peers" "${prefixes[@]}" "$@"
}

run_in_namespaces() {
  [[ $namespaces =~ ^[2-9]$ ]] || fail "--namespaces: must be 2 to 9"
  [[ $loss =~ ^[0-9]{1,2}$ ]] || fail "--loss: must be a whole percentage, 0 to 99"
  [ "$(id -u)" -eq 0 ] || fail "--namespaces needs root"
  command -v ip >/dev/null || fail "--namespaces needs ip (package iproute2)"
  [ "$loss" -eq 0 ] || command -v nft >/dev/null || fail "--loss needs nft (package nftables)"
  local net="lukou-$$" peers=''
  trap 'for i in $(seq 0 "$namespaces"); do ip netns del "'"$net"'-$i" 2>/dev/null || true; done' EXIT
  # Number 0 is the switch between them.
  ip netns add "$net-0"
  ip -n "$net-0" link add bridge type bridge
  ip -n "$net-0" link set bridge up
  for i in $(seq "$namespaces"); do
    ip netns add "$net-$i"
    ip -n "$net-$i" link set lo up
    ip link add eth0 netns "$net-$i" type veth peer name "port$i" netns "$net-0"
    ip -n "$net-0" link set "port$i" master bridge up
    ip -n "$net-$i" addr add "10.199.0.$i/24" dev eth0
    ip -n "$net-$i" link set eth0 up
    peers+=${peers:+,}10.199.0.$i
    # As they come from the wire, before they are put together to datagrams.
    [ "$loss" -eq 0 ] || ip netns exec "$net-$i" nft -f - <<END
table inet loss { chain wire { type filter hook prerouting priority -450
  iifname "eth0" numgen random mod 100 < $loss counter drop
  }
}
END
  done
  local -a prefixes=(--prefix "signal-controller=ip netns exec $net-$namespaces")
  local rsus
  rsus=$("$bin/lukou" validate "$scenario" --print 2>/dev/null | grep -c '^rsus {')
  for ((rsu = 0; rsu < rsus; ++rsu)); do prefixes+=(--prefix "rsu$rsu=ip netns exec $net-2"); done
  echo "namespaces: $net-1 to $net-$namespaces, $loss % lost" >&2
  ip netns exec "$net-1" "$bin/lukou" run "$scenario" --peers "$peers" "${prefixes[@]}" "$@" &
  local run=$!
  # Ctrl-C and an end from outside are the run's business, which then tells how it ended.
  trap 'kill -INT $run' INT
  trap 'kill -TERM $run' TERM
  local code=0
  wait "$run" || code=$?
  while kill -0 "$run" 2>/dev/null; do wait "$run" && code=0 || code=$?; done
  return "$code"
}

if [ -n "$hosts" ]; then
  run_over_ssh "$@"
else
  run_in_namespaces "$@"
fi
