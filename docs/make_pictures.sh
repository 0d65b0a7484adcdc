#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md and README.md anew, by the commands that stand there: docs/make_pictures.sh [phare]
# Needs ImageMagick's convert (apt-get install imagemagick) to make JPEGs of them. Takes some minutes without a GPU.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
phare=${1:-./phare}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
mkdir -p docs/pictures

picture() { convert "$1" -resize '1280x1280>' -quality 88 -strip "docs/pictures/$2.jpg"; }

"$phare" drive --headless --lockstep --frames 1300 --still-at 20 --samples 4 --out "$out/low"
for name in drivers_view birds_eye wall_25m; do picture "$out/low/$name.png" $name; done
"$phare" drive --headless --lockstep --frames 400 --camera chase --samples 4 --out "$out/chase"
picture "$out/chase/frames/000399.png" chase
"$phare" drive --headless --lockstep --frames 400 --false-colour --out "$out/false"
picture "$out/false/frames/000399.png" false_colour
ls -l docs/pictures
