#!/bin/sh
# The cockpit's half of the whole rig, in the emulated machine: phare-cockpit on vcan, the bus carried to the host.
#   rig_guest.sh FOLDER PORT_BASE COCKPIT_PROGRAM RELAY_PROGRAM RIG_FILE COCKPIT_FILE
# The host asks for high beam by making FOLDER/high, and for the end by FOLDER/stop.
set -u
folder=$1
base=$2
printf 'link add phc0 mtu 72 txqueuelen 1000 type vcan\nlink set phc0 up\n' | ip -batch - || exit 1
"$4" "127.0.0.1:$((base + 1))=10.0.2.2:$((base + 1))" "127.0.0.1:$((base + 2))=10.0.2.2:$((base + 2))" \
  "127.0.0.1:$((base + 10))=10.0.2.2:$((base + 10))" "10.0.2.15:$base=127.0.0.1:$base" &
relay=$!
"$3" --open-bus --rig "$5" --cockpit "$6" --port-base "$base" --stats "$folder/cockpit.json" 2>"$folder/cockpit.log" &
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
kill $relay
exit $status
