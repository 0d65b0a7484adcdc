#!/bin/sh
# Runs phare_can_test on the kernel's real CAN: run.sh PROGRAM BUILD_DIR
#   in an emulated machine with Debian's kernel (canvm), which has vcan, slcan and two controllers on a bus; or
#   where QEMU is missing and the host's kernel has CAN, in a network namespace of its own on vcan.
# Neither there: one line and exit 77 (ctest: skipped), or 1 with PHARE_REQUIRE_CAN=1.
set -u
program=$(realpath "$1")
build=$(realpath "$2")
here=$(cd "$(dirname "$0")" && pwd)
cache=$here/../../build/canvm

without() {
  echo "SKIPPED: no SocketCAN to test on: $1"
  [ "${PHARE_REQUIRE_CAN:-0}" = 1 ] && exit 1
  exit 77
}

# PHARE_CAN_NO_VM=1: the host's kernel in any case.
if [ "${PHARE_CAN_NO_VM:-0}" != 1 ] && command -v qemu-system-x86_64 >/dev/null && command -v busybox >/dev/null && why=$("$here/canvm" prepare "$cache" 2>&1); then
  # Two processors: on one the sender of the full bus takes the receiver's time.
  "$here/canvm" run --rw "$build" --smp 2 --timeout 150 "$cache" -- "$here/guest.sh" "$program" --gtest_color=no
  exit $?
fi
for namespace in "unshare -rn" "unshare -n"; do  # as any user, or as root where that is not allowed
  if $namespace sh -c 'ip link add t0 type vcan' 2>/dev/null; then
    exec $namespace sh -c 'ip link set lo up; exec "$@"' sh "$here/guest.sh" "$program" --gtest_color=no
  fi
done
without "this kernel has no CAN, and no machine to emulate one: ${why:-qemu-system-x86 or busybox-static missing}"
