#!/bin/sh
# Runs phare_can_rig_test with the emulated machine at hand: run_rig.sh PROGRAM. Without QEMU: one line and exit 77
# (ctest: skipped), or 1 with PHARE_REQUIRE_CAN=1.
set -u
here=$(cd "$(dirname "$0")" && pwd)
cache=$here/../../build/canvm
if command -v qemu-system-x86_64 >/dev/null && why=$("$here/canvm" prepare "$cache" 2>&1); then
  PHARE_CANVM=$(cd "$cache" && pwd) exec "$1"
fi
echo "SKIPPED: no machine to emulate: ${why:-qemu-system-x86 missing}"
[ "${PHARE_REQUIRE_CAN:-0}" = 1 ] && exit 1
exit 77
