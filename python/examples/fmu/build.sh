#!/bin/sh
# build.sh [FMU]: the example as an FMU for this machine; without a name high_beam.fmu where you are. Needs gcc and python3.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
fmu=$(realpath "${1:-high_beam.fmu}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/binaries/$(uname -m)-linux"
${CC:-gcc} -std=c11 -O2 -Wall -Wextra -Werror -shared -fPIC -fvisibility=hidden "$here/high_beam.c" \
  -o "$work/binaries/$(uname -m)-linux/high_beam.so"
cp "$here/modelDescription.xml" "$work"
(cd "$work" && python3 -m zipfile -c "$fmu" modelDescription.xml binaries)
echo "$fmu"
