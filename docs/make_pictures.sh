#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and README.md anew, by the commands that stand there: docs/make_pictures.sh [phare]
# Needs ImageMagick's convert (apt-get install imagemagick) to make JPEGs of them. Two drives of 75 s and three short ones.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
phare=${1:-./phare}
ports=${2:-47000}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
mkdir -p docs/pictures

picture() { convert "$1" -resize '1280x1280>' -quality 88 -strip "docs/pictures/$2.jpg"; }
# One picture is kept of every second of the drive.
at_second() { find "$1/frames" -name '*.png' | sort | sed -n "$(($2 + 1))p"; }

"$phare" drive --headless --samples 4 --still-at 20 --out "$out/low" --port-base "$ports"
for name in drivers_view birds_eye wall_25m; do picture "$out/low/$name.png" $name; done
"$phare" drive --headless --lockstep --frames 60 --samples 4 --camera chase --out "$out/chase" --port-base "$ports"
picture "$out/chase/frames/000059.png" chase
"$phare" drive --headless --samples 4 --false-colour --out "$out/false" --port-base "$ports"
picture "$(at_second "$out/false" 20)" false_colour
"$phare" drive --headless --lockstep --frames 60 --samples 4 --set visibility_m=80 --out "$out/fog" --port-base "$ports"
picture "$out/fog/frames/000059.png" fog
"$phare" drive --headless --lockstep --frames 60 --samples 4 --set grid_m=10 --set road_isolux=on --out "$out/grid" --port-base "$ports"
picture "$out/grid/frames/000059.png" grid
ls -l docs/pictures
