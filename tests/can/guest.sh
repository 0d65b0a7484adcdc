#!/bin/sh
# Inside the namespace or machine: makes the tests' interfaces by one call of ip, then runs the program.
for i in 0 1 2 3 4 5 6 7 8 9; do
  printf 'link add phc%s mtu 72 txqueuelen 1000 type vcan\nlink set phc%s up\n' "$i" "$i"
done | ip -batch - || exit 1
export PHARE_CAN_HERE=1
exec "$@"
