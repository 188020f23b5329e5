#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A first look: generates a part, checks it, turns it into an exact octree, asks about points and draws pictures.
#   tools/demo.sh PROGRAM OUTPUT_FOLDER
set -euo pipefail
program=$1 out=$2
mkdir -p "$out"

step() {
    printf '\n\033[1m$ octavo %s\033[0m\n' "$*"
    "$program" "$@"
}

step shape housing -o "$out/part.stl"
step check "$out/part.stl"
step info "$out/part.stl"
step octree "$out/part.stl" --depth 8 -o "$out/part.oct"
step stats "$out/part.oct"

# A line of points through the part's middle.
awk 'BEGIN { print "x,y,z"; for (i = -20; i <= 20; ++i) printf "%g,0,%g\n", 3 * i, 5 }' > "$out/points.csv"
step contains "$out/part.stl" "$out/points.csv" -o "$out/sides.csv"

step octree "$out/part.stl" --depth 6 -o "$out/coarse.oct"
step render "$out/part.stl" -o "$out/part.png"
step render "$out/part.stl" --cut x -o "$out/cut.png"
step render "$out/coarse.oct" --cut x -o "$out/cells.png"
step octree "$out/part.stl" --depth 7 -o "$out/part.vtu"

printf '\nThe outputs are in %s:\n' "$out"
ls -1sh "$out"
