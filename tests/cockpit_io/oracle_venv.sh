#!/bin/sh
# oracle_venv.sh DIR [PACKAGES]: a Python environment with the packages that tests compare with, or with those named,
# made once and then found again.
# Exit 77 and one line where it cannot be had (no python3, no network).
set -u
dir=$1
packages=${2:-cantools==45.1.0 autosar-e2e==1.0.0}
mkdir -p "$(dirname "$dir")" || exit 77
exec 9>"$dir.lock"
command -v flock >/dev/null && flock 9  # tests of several builds may come at once
[ "$(cat "$dir/made" 2>/dev/null)" = "$packages" ] && exit 0
command -v python3 >/dev/null || { echo "no python3"; exit 77; }
rm -rf "$dir"
python3 -m venv "$dir" >"$dir.log" 2>&1 || { echo "no Python environment: $(tail -n 1 "$dir.log")"; exit 77; }
# shellcheck disable=SC2086
timeout 120 "$dir/bin/python" -m pip install --disable-pip-version-check --retries 1 --timeout 10 -q $packages \
  >"$dir.log" 2>&1 || { echo "pip: $(tail -n 1 "$dir.log")"; exit 77; }
echo "$packages" >"$dir/made"
