#!/bin/sh
# A machine whose QEMU hangs when it is told to end is ended all the same, with its own status. Without QEMU: one line and
# exit 77 (ctest: skipped), or 1 with PHARE_REQUIRE_CAN=1.
set -u
here=$(cd "$(dirname "$0")" && pwd)
cache=$here/../../build/canvm
if ! command -v qemu-system-x86_64 >/dev/null || ! why=$("$here/canvm" prepare "$cache" 2>&1); then
  echo "SKIPPED: no machine to emulate: ${why:-qemu-system-x86 missing}"
  [ "${PHARE_REQUIRE_CAN:-0}" = 1 ] && exit 1
  exit 77
fi
# QEMU is stopped in the tenth of a second between the machine's last word and its end; a busy host may be late for that.
for try in 1 2 3 4 5; do
  "$here/canvm" run --timeout 60 "$cache" -- sh -c "exit 37 # hung-$$-$try" 2>/dev/null &
  machine=$!
  stopped=no
  while kill -0 $machine 2>/dev/null; do
    if run=$(grep -ls -e "hung-$$-$try" "$cache"/run.*/command) && grep -qs 'leaves with 37\.' "${run%command}console"; then
      kill -STOP "$(cat "${run%command}qemu.pid")" 2>/dev/null && stopped=yes
      break
    fi
    sleep 0.01
  done
  wait $machine
  status=$?
  echo "stopped: $stopped, status $status of 37"
  [ $status = 37 ] || exit 1
  [ $stopped = no ] || exit 0
done
echo "QEMU was never stopped in time"
exit 1
