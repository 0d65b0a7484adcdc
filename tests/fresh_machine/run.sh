#!/usr/bin/env bash
# process: what happens to someone who has Debian 12 and nothing else. mmdebstrap makes such systems (no sudo, no git,
# no locale), and in them
#   1. ./phare drive of these sources installs, builds and leaves a report, with no package that packages.txt marks "test",
#      and with a display a person drives in its window (Xvfb and xdotool of the host);
#   2. ./phare package makes a Debian package;
#   3. ./phare test --only-configure adds the packages of the tests and configures every preset;
#   4. the package of 2 is installed by apt on a second bare system and drives from /usr, where nothing is written.
# run.sh            all of it; the steps with what they took are on standard output
# run.sh --package FILE   only 4, with that package
# run.sh --shell    a shell in a bare system with these sources in /root/phare
# Kept in build/fresh: the bare system (for a week) and the packages apt fetched; and the compiler cache is the host's.
# Where the kernel lets no file system be mounted: one line and 77 (ctest: skipped), or 1 with PHARE_REQUIRE_BARE=1.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_dir=$(cd "$here/../.." && pwd)
work=$source_dir/build/fresh
port_base=$((8000 + $$ % 40 * 40))  # below those of other tests (10000 up)

without() {
  echo "SKIPPED: no bare Debian to try the first drive on: $1"
  [ "${PHARE_REQUIRE_BARE:-0}" = 1 ] && exit 1
  exit 77
}
failed() {
  echo "FAILED: $1"
  [ ! -s "$work/log" ] || tail -n 40 "$work/log"
  exit 1
}

# ---- outside: a namespace in which file systems may be mounted, as root or as anyone

if [ "${PHARE_IN_NAMESPACE:-0}" != 1 ]; then
  command -v mmdebstrap >/dev/null || without "mmdebstrap missing"
  mkdir -p "$work"
  namespace=(unshare --mount --pid --fork --kill-child)
  [ "$(id -u)" = 0 ] || namespace+=(--user --map-root-user --map-auto)
  why=$("${namespace[@]}" sh -c "mount --bind '$work' '$work' && mount -t proc proc /proc" 2>&1) || without "this kernel forbids mounting (${why##*$'\n'})"
  exec 9>"$work/lock"
  flock 9
  # Removed by one who sees none of the mounts: those of the compiler cache are in the namespace of the tests alone.
  remove() { "${namespace[@]}" rm -rf "$work/first" "$work/second"; }
  trap remove EXIT
  remove
  status=0
  PHARE_IN_NAMESPACE=1 "${namespace[@]}" "${BASH_SOURCE[0]}" "$@" || status=$?
  exit $status
fi
mount -t proc proc /proc

# ---- the bare system

# Debian 12's own sources on this machine, so that its mirror and proxy are used; else Debian's.
sources() {
  { apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) main' "Created-By: Packages" "Component: main" 2>/dev/null || true; } |
    grep -E ' bookworm(-updates|-security)? main$' | sort -u || echo "deb http://deb.debian.org/debian bookworm main"
}

make_bare() {
  if [ -s "$work/bare.tar" ] && [ -n "$(find "$work/bare.tar" -mtime -7)" ]; then return; fi
  local include=()
  ! sources | grep -q https: || include=(--include=ca-certificates)
  # No waiting for the disk: the system is thrown away. Nodes of /dev are the host's, see enter().
  sources | mmdebstrap --format=tar --variant=minbase --skip=output/dev --dpkgopt=force-unsafe-io "${include[@]}" bookworm "$work/bare.tar.new" - >"$work/log" 2>&1 ||
    failed "mmdebstrap makes no bare system"
  mv "$work/bare.tar.new" "$work/bare.tar"
}

# fresh NAME: a new bare system in $work/NAME.
fresh() {
  local root=$work/$1 node
  mkdir -p "$root" "$work/archives/partial"
  tar -C "$root" -xpf "$work/bare.tar"
  mkdir -p "$root/proc" "$root/dev"  # mmdebstrap leaves out the folder too, or keeps it, by its version and by who runs it
  mount -t proc proc "$root/proc"
  mount -t tmpfs tmpfs "$root/dev"
  for node in null zero full random urandom; do
    : >"$root/dev/$node"
    mount --bind "/dev/$node" "$root/dev/$node"
  done
  ln -s /proc/self/fd "$root/dev/fd"
  mkdir "$root/dev/shm"
  mount --bind "$work/archives" "$root/var/cache/apt/archives"
  cat /etc/resolv.conf >"$root/etc/resolv.conf"
  # What this machine needs to reach its mirror.
  apt-config dump 2>/dev/null | grep -E '^Acquire::(https?::|Check-|Retries|ForceIPv)' >"$root/etc/apt/apt.conf.d/99host" || true
}

# enter NAME [FOLDER] COMMAND…: as root of that system, with the environment of a bare container.
enter() {
  local root=$work/$1 folder=$2 proxies=() name
  shift 2
  for name in http_proxy https_proxy no_proxy; do [ -z "${!name:-}" ] || proxies+=("$name=${!name}"); done
  # The host's compiler cache is not to be cleaned by another's measure.
  chroot "$root" /usr/bin/env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb \
    CCACHE_MAXSIZE=0 "${proxies[@]}" /bin/sh -c 'cd "$0" && exec "$@"' "$folder" "$@"
}

# took BEGIN WHAT: seconds since BEGIN by the clock.
took() { printf '%4d s  %s\n' $((SECONDS - $1)) "$2"; }

# step WHAT NAME FOLDER COMMAND…: with its seconds; its output is in the log.
step() {
  local what=$1 begin=$SECONDS
  shift
  enter "$@" >"$work/log" 2>&1 </dev/null || failed "$what"
  took "$begin" "$what"
}

# The files of the clone, as they are (not what is only built or lies about).
put_sources() {
  local root=$work/$1/root/phare cache
  mkdir -p "$root"
  git -C "$source_dir" ls-files -z | tar -C "$source_dir" --null -T - --ignore-failed-read -c | tar -C "$root" --no-same-owner -x
  if cache=$(ccache --get-config cache_dir 2>/dev/null) && mkdir -p "$cache"; then
    mkdir -p "$work/$1/root/.cache/ccache"
    mount --bind "$cache" "$work/$1/root/.cache/ccache"
  fi
}

# has_report NAME FOLDER: a drive of three frames came to its end there.
has_report() {
  local out=$work/$1$2 file
  for file in report.json index.html drivers_view.png frames/000002.png; do
    [ -s "$out/$file" ] || { ls -R "$out" >"$work/log" 2>&1 || true; failed "$2/$file is not there"; }
  done
}

# ---- what is tried

drive=(drive --headless --lockstep --frames 3 --port-base "$port_base")

# has_window ROOT FOLDER: a person presses Up in the window of `./phare drive` until the car moves, then Esc until it ends.
has_window() {
  local root=$work/$1 display drive status=0 begin=$SECONDS
  command -v Xvfb >/dev/null && command -v xdotool >/dev/null || { echo "        SKIPPED: the window: no Xvfb, or no xdotool"; return; }
  # It takes a free number and tells it when it listens: one of a run that was killed may have left its lock behind.
  mkdir -p /tmp/.X11-unix
  : >"$work/display"
  Xvfb -displayfd 5 -screen 0 1280x720x24 -nolisten tcp >"$work/xvfb" 2>&1 5>"$work/display" &
  local server=$! tries
  for ((tries = 0; tries < 600; ++tries)); do
    [ ! -s "$work/display" ] || break
    sleep 0.1
  done
  display=:$(tr -d '\n' <"$work/display")
  [ "$display" != : ] || failed "no display for the window"
  # Its socket, where the bare system looks for it.
  mkdir -p "$root/tmp/.X11-unix" /tmp/.X11-unix
  mount --bind /tmp/.X11-unix "$root/tmp/.X11-unix"
  enter "$1" "$2" env "DISPLAY=$display" ./phare drive --size 320x180 --set reach=on --port-base "$port_base" --out /root/window >"$work/log" 2>&1 </dev/null &
  drive=$!
  pressed() { DISPLAY=$display timeout 60 xdotool search --sync --onlyvisible --name '^Phare$' windowfocus "$@" >/dev/null 2>&1; }
  for ((tries = 0; ; ++tries)); do  # a window that is just being mapped takes no focus yet
    ! pressed sleep 0 || break
    [ "$tries" -lt 30 ] || failed "no window in the bare system"
    sleep 1
  done
  while ! grep -q "ready after" "$work/log"; do
    kill -0 "$drive" 2>/dev/null || failed "the drive in the window ended before its picture was ready"
    sleep 1
  done
  pressed keydown Up
  sleep 8
  pressed keyup Up
  for _ in 1 2 3 4 5 6 7 8 9 10; do
    pressed key Escape || true
    sleep 1
    kill -0 "$drive" 2>/dev/null || break
  done
  wait "$drive" || status=$?
  kill "$server" 2>/dev/null || true
  wait "$server" 2>/dev/null || true
  umount "$root/tmp/.X11-unix"
  [ "$status" = 0 ] || failed "the drive in the window ended with $status"
  # What was driven stands in the rows of its probes.csv, column by the name in the first.
  awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "speed_mps") column = i } NR > 1 && $column > 1 { moved = 1 } END { exit !moved }' \
    "$root/root/window/probes.csv" || failed "the car did not move in the window"
  took "$begin" "a person drives in the window of ./phare drive"
}

# The clone drives, makes its Debian package (left in $work) and configures its tests.
try_clone() {
  local mark name preset
  step "./phare ${drive[*]}" first /root/phare ./phare "${drive[@]}"
  grep '^phare: ' "$work/log" | sed 's/^/        /'
  has_report first /root/phare/out
  has_window first /root/phare
  # What was asked for; xz-utils, say, comes with build-essential.
  enter first / apt-mark showmanual >"$work/asked_for"
  while read -r name mark _; do
    [ "$mark" != test ] || ! grep -qxF "$name" "$work/asked_for" || failed "the drive installed $name, which packages.txt marks \"test\""
  done <"$source_dir/packages.txt"
  step "./phare doctor finds all that driving needs" first /root/phare ./phare doctor
  grep -q '^This machine can drive\.$' "$work/log" || failed "./phare doctor does not say that this machine can drive"
  enter first /root/phare build/release/bin/phare-dynamics --batch none.csv --integrator reference >"$work/log" 2>&1 && failed "a reference integrator without SUNDIALS"
  grep -q "apt-get install libsundials-dev" "$work/log" || failed "no word on where the reference integrator is to be had"

  step "./phare package" first /root/phare ./phare package
  cp "$work/first/root/phare/build/"phare-*.deb "$work/"

  step "./phare test --only-configure" first /root/phare ./phare test --only-configure
  for preset in release asan tsan; do
    grep -q '^PHARE_TESTS:BOOL=ON' "$work/first/root/phare/build/$preset/CMakeCache.txt" || failed "$preset is configured without tests"
  done
}

# try_package FILE: apt installs it on a second bare system, and it drives from /usr.
try_package() {
  local package=${1##*/}
  fresh second
  mkdir "$work/second/root/empty"
  cp "$1" "$work/second/root/"
  step "apt-get update" second /root apt-get update
  step "apt-get install ./$package" second /root apt-get install -y --no-install-recommends "./$package"
  of_system() { (cd "$work/second" && find usr etc opt -printf '%p %s %T@\n' | sort); }
  of_system >"$work/before"
  step "phare ${drive[*]} from /usr" second /root/empty phare "${drive[@]}" --out /tmp/x
  has_report second /tmp/x
  of_system >"$work/after"
  cmp -s "$work/before" "$work/after" || { diff "$work/before" "$work/after" >"$work/log" || true; failed "a drive wrote beside the installed program"; }
  [ -z "$(ls -A "$work/second/root/empty")" ] || failed "a drive with --out wrote into the folder it was started in"
  step "phare doctor of an installed phare" second /root phare doctor
  grep -q '^This machine can drive\.$' "$work/log" || failed "phare doctor does not say that this machine can drive"
}

begin=$SECONDS
make_bare
if [ "${1:-}" = --package ]; then
  try_package "$2"
  exit
fi
rm -f "$work"/phare-*.deb
fresh first
put_sources first
took "$begin" "a bare Debian 12 ($(grep -c '^Package:' "$work/first/var/lib/dpkg/status") packages)"
if [ "${1:-}" = --shell ]; then
  enter first /root/phare /bin/bash -i
  exit
fi
try_clone
try_package "$work"/phare-*.deb
times >"$work/times"  # not in $(…), which has no children yet
took "$begin" "in all; processor time (user, system): $(tail -n 1 "$work/times")"
