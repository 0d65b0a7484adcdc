#!/bin/sh
# The cockpit's half of the whole rig, in the emulated machine: phare-cockpit on vcan, the others on the host.
#   rig_guest.sh FOLDER COCKPIT_PROGRAM RIG_FILE COCKPIT_FILE
# The host asks for high beam by making FOLDER/high, and for the end by FOLDER/stop.
set -u
folder=$1
printf 'link add phc0 mtu 72 txqueuelen 1000 type vcan\nlink set phc0 up\n' | ip -batch - || exit 1
"$2" --rig "$3" --cockpit "$4" --stats "$folder/cockpit.json" 2>"$folder/cockpit.log" &
cockpit=$!
stalk=02
while [ ! -e "$folder/stop" ]; do
  if [ -e "$folder/high" ] && [ $stalk = 02 ]; then
    stalk=03
    candump -n 2 phc0,503:7FF >"$folder/telltales" &  # the second was sent after the stalk has moved
    sleep 0.3
  fi
  cansend phc0 500#${stalk}01000000000000
  cansend phc0 501#0000000000000000
  cansend phc0 502#0000000000000000
  sleep 0.2
done
kill -TERM $cockpit
wait $cockpit
status=$?
exit $status
