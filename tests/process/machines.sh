#!/bin/sh
# A rig on three machines and the network between them, each a network namespace of its own:
#   unshare -Urn machines.sh FOLDER PROGRAMS PORT_BASE "RELAY OPTIONS" "OPTIONS OF ALL" "OF COCKPIT" "OF DYNAMICS" "OF PICTURES"
# A (10.77.1.1) the cockpit, B (10.77.2.1) the car and picture 0, C (10.77.3.1) pictures 1 and 2, each with
# FOLDER/{a,b,c}.toml. The machine between them has a wire to each, and for each pair an address on which a relay
# listens: what A sends to 10.77.1.102 reaches B. Ends when the pictures do.
# Clocks: $CLOCK_A, $CLOCK_B, $CLOCK_C ms off. Prints "ends: …" with the exit codes of the pictures, the cockpit, the car.
set -u
folder=$1 bin=$2 base=$3 faults=$4 all=$5 cockpit=$6 dynamics=$7 pictures=$8
ip link set lo up

machines=
for n in 1 2 3; do
  unshare -n sleep 1000 &
  eval "m$n=$!"
  machines="$machines $!"
done
# Nothing outlives this script, whatever ends it.
relays= cockpit_pid= dynamics_pid= v0= v1= v2=
trap 'kill -KILL $machines $relays $cockpit_pid $dynamics_pid $v0 $v1 $v2 2>/dev/null' EXIT
trap 'exit 1' TERM INT HUP
in_machine() {  # N COMMAND …
  eval "to=\$m$1"
  shift
  nsenter -t "$to" -n -- "$@"
}
program_in() {  # the same in the background: its process id is the program's
  eval "to=\$m$1"
  shift
  exec nsenter -t "$to" -n -- "$@"
}
for n in 1 2 3; do
  eval "pid=\$m$n"
  for try in $(seq 100); do  # until it has left our namespace
    [ "$(readlink /proc/$pid/ns/net)" != "$(readlink /proc/self/ns/net)" ] && break
    sleep 0.05
  done
  ip link add "wire$n" type veth peer name eth0 netns "$pid" || exit 77
  ip link set "wire$n" up
  for other in 1 2 3; do
    [ $other = $n ] || ip address add "10.77.$n.10$other/24" dev "wire$n"
  done
  in_machine $n ip link set lo up
  in_machine $n ip address add "10.77.$n.1/24" dev eth0
  in_machine $n ip link set eth0 up
done

for n in 1 2 3; do
  for other in 1 2 3; do
    [ $other = $n ] && continue
    "$bin/phare" bus-relay --port-base "$base" --listen "10.77.$n.10$other" --to "10.77.$other.1" --seed "$n$other" $faults \
      >"$folder/relay-$n$other.txt" 2>&1 &
    relays="$relays $!"
  done
done

export PHARE_CLOCK_OFFSET_MS
PHARE_CLOCK_OFFSET_MS=$CLOCK_A
program_in 1 "$bin/phare-cockpit" --rig "$folder/a.toml" $all $cockpit --stats "$folder/cockpit.json" 2>"$folder/cockpit.log" &
cockpit_pid=$!
PHARE_CLOCK_OFFSET_MS=$CLOCK_B
program_in 2 "$bin/phare-dynamics" --rig "$folder/b.toml" $all $dynamics --stats "$folder/dynamics.json" 2>"$folder/dynamics.log" &
dynamics_pid=$!
program_in 2 "$bin/phare-visual" --rig "$folder/b.toml" --channel 0 $all $pictures --out "$folder/out-0" 2>"$folder/visual-0.log" &
v0=$!
PHARE_CLOCK_OFFSET_MS=$CLOCK_C
program_in 3 "$bin/phare-visual" --rig "$folder/c.toml" --channel 1 $all $pictures --out "$folder/out-1" 2>"$folder/visual-1.log" &
v1=$!
program_in 3 "$bin/phare-visual" --rig "$folder/c.toml" --channel 2 $all $pictures --out "$folder/out-2" 2>"$folder/visual-2.log" &
v2=$!
ends=
for picture in $v0 $v1 $v2; do
  wait $picture
  ends="$ends $?"
done
kill -TERM $cockpit_pid $dynamics_pid 2>/dev/null
wait $cockpit_pid
ends="$ends $?"
wait $dynamics_pid
ends="$ends $?"
kill -INT $relays
wait $relays
echo "ends:$ends"
