#!/usr/bin/env bash
# Makes the pictures of docs/gallery.md, docs/accuracy.md and README.md anew, by the commands that stand there: docs/make_pictures.sh [phare]
# Needs ImageMagick's convert (apt-get install imagemagick) to make JPEGs of them, and xvfb-run (xvfb, xauth) for the window. Two drives of 75 s and some short ones, and eight minutes of phare cost.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
phare=${1:-./phare}
ports=${2:-47000}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
mkdir -p docs/pictures

picture() { convert "$1" -resize '1280x1280>' -quality 88 -strip "docs/pictures/$2.jpg"; }
# The first picture that is kept of this second or after it.
at_second() {
  awk -F, -v second="$2" 'NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    NR > 1 && $column["picture"] == 1 && $column["time_s"] >= second { printf "%06d\n", $column["frame"] }' "$1/drive.csv" |
    while read -r frame; do [ ! -f "$1/frames/$frame.png" ] || { echo "$1/frames/$frame.png"; break; }; done
}

"$phare" drive --headless --samples 4 --still-at 20 --out "$out/low" --port-base "$ports"
for name in drivers_view birds_eye wall_25m; do picture "$out/low/$name.png" $name; done
"$phare" drive --headless --lockstep --frames 60 --samples 4 --camera chase --out "$out/chase" --port-base "$ports"
picture "$out/chase/frames/000059.png" chase
"$phare" drive --headless --samples 4 --false-colour --out "$out/false" --port-base "$ports"
picture "$(at_second "$out/false" 20)" false_colour
"$phare" drive --headless --lockstep --frames 60 --samples 4 --set visibility_m=80 --out "$out/fog" --port-base "$ports"
picture "$out/fog/frames/000059.png" fog
"$phare" drive --headless --lockstep --frames 60 --samples 4 --traffic config/examples/column.toml --set visibility_m=300 --out "$out/fog_300m" --port-base "$ports"
picture "$out/fog_300m/frames/000059.png" fog_300m
"$phare" drive --headless --lockstep --frames 200 --samples 4 --set snow_mmph=2 --out "$out/snow" --port-base "$ports"
picture "$out/snow/frames/000199.png" snow
"$phare" drive --headless --lockstep --frames 60 --samples 4 --traffic config/examples/column.toml --set rain_mmph=10 --out "$out/wet" --port-base "$ports"
picture "$out/wet/frames/000059.png" wet
"$phare" drive --headless --lockstep --frames 200 --samples 4 --lamp config/examples/high_beam.ies --set rain_mmph=50 --out "$out/rain" --port-base "$ports"
picture "$out/rain/frames/000199.png" rain
"$phare" drive --headless --lockstep --frames 60 --samples 4 --camera oncoming --out "$out/oncoming" --port-base "$ports"
picture "$out/oncoming/frames/000059.png" oncoming
"$phare" drive --headless --lockstep --frames 60 --samples 4 --traffic config/examples/column.toml --out "$out/traffic" --port-base "$ports"
picture "$out/traffic/frames/000059.png" traffic
"$phare" drive --headless --samples 4 --traffic config/examples/crossing.toml --out "$out/crossing" --port-base "$ports"
picture "$(at_second "$out/crossing" 21.2)" crossing
"$phare" drive --headless --lockstep --frames 640 --samples 4 --traffic config/examples/deer.toml --out "$out/deer" --port-base "$ports"
picture "$out/deer/frames/000639.png" deer
"$phare" drive --headless --lockstep --frames 60 --samples 4 --traffic config/examples/column.toml --set snow_cover=0.9 --set exposure_per_cdm2=0.06 --out "$out/snow_cover" --port-base "$ports"
picture "$out/snow_cover/frames/000059.png" snow_cover
"$phare" drive --headless --lockstep --frames 80 --samples 4 --traffic config/examples/column.toml --set rain_mmph=10 --set windscreen=on --set wiper=off --out "$out/windscreen" --port-base "$ports"
picture "$out/windscreen/frames/000079.png" windscreen
"$phare" drive --headless --lockstep --frames 45 --samples 4 --traffic config/examples/spray.toml --set rain_mmph=25 --out "$out/spray" --port-base "$ports"
picture "$out/spray/frames/000044.png" spray
# At ten frames a second, for these begin later than the others: the moments of the commands in the gallery.
for scene in town:24 town_wet:23 tunnel:48 motorway:25; do
  name=${scene%:*} frames=${scene#*:}
  rig=${name%_wet} rain=(); [ "$name" = "$rig" ] || rain=(--set rain_mmph=4)
  sed "s#\"\.\./#\"$PWD/config/#; s/^frame_rate_hz = 60/frame_rate_hz = 10/" "config/rigs/$rig.toml" > "$out/$name.toml"
  "$phare" drive --rig "$out/$name.toml" --script "config/drives/${rig}_script.toml" --headless --lockstep --frames "$frames" --samples 4 ${rain[@]+"${rain[@]}"} --out "$out/$name" --port-base "$ports"
  picture "$out/$name/frames/$(printf %06d $((frames - 1))).png" "$name"
done
"$phare" drive --headless --lockstep --frames 60 --samples 4 --set grid_m=10 --set road_isolux=on --out "$out/grid" --port-base "$ports"
picture "$out/grid/frames/000059.png" grid
"$phare" drive --rig config/rigs/three_channels.toml --headless --lockstep --frames 60 --size 640x360 --samples 4 --out "$out/three" --port-base "$ports"
convert "$out"/three/{left,.,right}/frames/000059.png +append "$out/three.png"
picture "$out/three.png" three
"$phare" drive --design halogen --versus led --headless --lockstep --frames 60 --samples 4 --out "$out/ab" --port-base "$ports"
picture "$out/ab/frames/000059.png" versus
"$phare" drive --headless --lockstep --frames 60 --samples 4 --camera wall --design halogen --versus led --out "$out/wall" --port-base "$ports"
picture "$out/wall/frames/000059.png" wall_versus
"$phare" drive --headless --lockstep --frames 60 --samples 4 --set layout=inset --set compare=difference --design halogen --versus led --out "$out/difference" --port-base "$ports"
picture "$out/difference/frames/000059.png" difference
xvfb-run -a "$phare" drive --lockstep --frames 60 --samples 4 --set panel=on --out "$out/panel" --port-base "$ports"
picture "$out/panel/frames/000059.png" panel
"$phare" cost --out "$out/cost"
for ladder in light shadows lens fog vehicle-full poses; do cp "$out/cost/$ladder.svg" "docs/pictures/cost_$ladder.svg"; done
ls -l docs/pictures
