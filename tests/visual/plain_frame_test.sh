#!/usr/bin/env bash
# A frame that calls for no effect takes the same passes, draws, binds, images and bytes, and is the same picture, whether
# effects are built or not. With fog the two differ, and the one without effects takes what it took.
set -euo pipefail
with=$1/phare_plain_frame_with without=$1/phare_plain_frame_without
plain=$("$with") bare=$("$without") foggy=$("$with" fog) bare_in_fog=$("$without" fog)
echo "$plain"
if [[ $plain != "$bare" ]]; then
  printf 'a road that calls for no effect takes another frame than one built without effects:\n'
  diff <(echo "$plain") <(echo "$bare") || true
  exit 1
fi
grep -qx 'passes 1' <<<"$plain"
grep -qx 'validation 0' <<<"$plain"
if [[ $foggy == "$plain" ]]; then
  echo 'fog changes nothing: what is compared here has no effects'
  exit 1
fi
if [[ $bare_in_fog != "$plain" ]]; then
  echo 'the frame built without effects has some:'
  diff <(echo "$plain") <(echo "$bare_in_fog")
fi
