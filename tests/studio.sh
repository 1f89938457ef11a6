#!/usr/bin/env bash
# The studio as a person uses it: the real program on a virtual screen, real pointer and keys. From a picture to a saved tour
# with a floating boat in it and a camera path, which is opened again, mended, checked and rendered. Screenshots of every step
# stay in the folder that is named, or a new one.
#
#   bash tests/studio.sh [FOLDER]
#
# Needs Xvfb, xdotool and ImageMagick (Debian: xvfb xdotool imagemagick) and the program built with --features app.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=${PICTURE_TOUR:-${CARGO_TARGET_DIR:-$root/target}/release/picture-tour}
out=$(realpath -m "${1:-$(mktemp -d)}")
work=$(mktemp -d)
export DISPLAY=:93 HOME=$work/home XDG_RUNTIME_DIR=${XDG_RUNTIME_DIR:-/tmp}
mkdir -p "$out" "$HOME"

fail() { echo "studio: $1 (see $out)" >&2; exit 1; }
shot() { import -window root "$out/$1.png"; }
# Waits until the window shows the same twice: whatever was pressed has been drawn, however slow the machine is.
settle() {
    local before now=none i
    for i in $(seq 30); do
        before=$now
        now=$(import -window root -depth 8 rgb:- | cksum)
        [ "$now" = "$before" ] && return
        sleep 0.7
    done
}
# Frames on a software GPU take a moment: whatever is pressed stays down for one.
press() { xdotool keydown "$@" sleep 0.5 keyup "$@" sleep 0.3; settle; }
control() { xdotool keydown ctrl sleep 0.5 key "$1" sleep 0.5 keyup ctrl sleep 0.3; settle; }
click() { xdotool mousemove "$1" "$2" sleep 0.5 mousedown 1 sleep 0.4 mouseup 1 sleep 0.4; settle; }
drag() {
    xdotool mousemove "$1" "$2" sleep 0.5 mousedown 1 sleep 0.4 mousemove $((($1 + $3) / 2)) $((($2 + $4) / 2)) \
        sleep 0.5 mousemove "$3" "$4" sleep 0.5 mouseup 1 sleep 0.4
    settle
}
# In the tour: a camera turns by how far the pointer was moved, wherever it is.
turn() {
    xdotool mousemove 1250 440 sleep 0.5 mousedown 1 sleep 0.4
    for _ in 1 2 3 4 5 6; do xdotool mousemove_relative -- "$1" 1 sleep 0.3; done
    xdotool mouseup 1
    settle
}
# The button is near the end of the panel, above the keyframes that there are.
take_keyframe() {
    xdotool mousemove 150 700 sleep 0.5
    for _ in $(seq 15); do xdotool click 5 sleep 0.1; done
    settle
    click 69 "$1"
}
keyframes() { grep -c 'position:' "$work/pond.tour.ron" || true; }
await() { # seconds, what, command
    local left=$1 what=$2
    shift 2
    until "$@"; do
        left=$((left - 1))
        [ "$left" -gt 0 ] || { shot failed || true; fail "waited in vain for $what"; }
        sleep 1
    done
}

Xvfb $DISPLAY -screen 0 1440x860x24 >/dev/null 2>&1 &
screen=$!
studio=
trap 'kill $studio $screen 2>/dev/null || true; rm -rf "$work"' EXIT
await 20 "the virtual screen" sh -c "xdotool getmouselocation >/dev/null 2>&1"
cp "$root/tests/data/a1/input.png" "$work/pond.png"
began=$SECONDS
"$program" edit "$work/pond.png" >"$out/log" 2>&1 &
studio=$!

# The first draft is there once there is something to recover.
await 90 "the first draft" test -f "$work/.pond.tour.ron.recovery"
drafted=$((SECONDS - began))
sleep 4
xdotool search --sync --name "Picture tour" windowfocus
shot 1_draft

click 39 59 # the message was read
press 4
click 77 231 # draw a new object
click 18 264 # without clinging to edges
for corner in "528 492" "663 492" "663 538" "528 538"; do click $corner; done
press Return
shot 2_outline
click 158 323 # find it in a box
drag 522 466 668 542
await 60 "the boat's mask" sh -c "sleep 3; test \"$work/.pond.tour.ron.recovery\" -nt \"$out/2_outline.png\""
sleep 4
shot 3_boat
turn -15
shot 4_flight
press 5
shot 5_report
press 6
click 223 376 # it moves as ...
click 201 578 # ... a boat at anchor
take_keyframe 726
sleep 10 # what moves is built anew, and frames are few meanwhile
settle
turn 15
take_keyframe 726
shot 6_motion
control s
await 20 "the saved tour" test -f "$work/pond.tour.ron"
grep -q 'motion: Floating' "$work/pond.tour.ron" || fail "the boat does not float"
[ "$(keyframes)" = 2 ] || fail "the path has $(keyframes) keyframes, not 2"
[ "$(grep yaw_deg "$work/pond.tour.ron" | sort -u | wc -l)" = 2 ] || fail "both keyframes look the same way"

# Opened again it is the same: one more keyframe is all that another save adds.
cp "$work/pond.tour.ron" "$out/before.tour.ron"
kill $studio
wait $studio 2>/dev/null || true
"$program" edit "$work/pond.tour.ron" >>"$out/log" 2>&1 &
studio=$!
await 60 "the studio" sh -c "xdotool search --name 'Picture tour' >/dev/null 2>&1"
sleep 8
xdotool search --sync --name "Picture tour" windowfocus
settle
press 6
take_keyframe 681
shot 7_reopened
control s
await 20 "the tour saved again" sh -c "! cmp -s '$work/pond.tour.ron' '$out/before.tour.ron'"
[ "$(keyframes)" = 3 ] || fail "the path has $(keyframes) keyframes, not 3"
lost=$(diff "$out/before.tour.ron" "$work/pond.tour.ron" | grep -c '^<') || true
[ "$lost" = 0 ] || fail "$lost lines of the tour changed when it was opened and saved again"

cp -r "$work/pond.tour.ron" "$work/masks" "$out/"

# What was made: a sound tour, its horizon and pairs where the world has them, and a first view that is the picture.
"$program" check "$work/pond.tour.ron" >"$out/check.txt" || fail "the tour has problems"
pairs=$(grep -c ' yes$' "$out/check.txt") || true
[ "$pairs" -ge 8 ] || fail "$pairs reflection pairs are used, 8 at least are expected"
grep -q '"object 1"' "$work/pond.tour.ron" || fail "the boat is not in the tour"
"$program" render "$work/pond.tour.ron" --reference --still --out "$work/frames" >/dev/null
off=$(compare -metric PAE "$work/pond.png" "$work/frames/first_view.png" null: 2>&1 | sed 's/.*(\(.*\))/\1/') || true
awk -v off="$off" 'BEGIN { exit !(off * 255 <= 1.01) }' || fail "the first view differs from the picture by $off of white"
# The box cuts the flag pole off, and holds half of the hull's mirror image.
truth=$root/tests/data/a1/masks/obj_4_boat.png
area() { convert "$work"/masks/object*.png "$truth" -compose "$1" -composite -format '%[fx:mean*w*h]' info:; }
shared=$(awk -v both="$(area multiply)" -v either="$(area lighten)" 'BEGIN { printf "%.2f", both / either }')
awk -v shared="$shared" 'BEGIN { exit !(shared > 0.6) }' || fail "the boat's mask shares $shared with the boat"
echo "a draft after $drafted s; $pairs pairs; the boat is found to $shared; screenshots in $out"
