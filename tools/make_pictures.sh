#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draws the pictures of the documentation with Octavo itself, from parts that it generates.
#   tools/make_pictures.sh PROGRAM
set -euo pipefail
cd "$(dirname "$0")/.."
octavo() { "$program" "$@" --quiet; }
program=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

octavo shape housing -o "$scratch/housing.ply"
octavo shape gear -o "$scratch/gear.ply"
for depth in 5 6 7; do octavo octree "$scratch/housing.ply" --depth $depth -o "$scratch/housing-$depth.oct"; done
octavo octree "$scratch/gear.ply" --depth 7 -o "$scratch/gear.oct"

mkdir -p docs/pictures
octavo render "$scratch/housing.ply" -o docs/pictures/housing.png --size 800x600
octavo render "$scratch/housing.ply" -o docs/pictures/housing-cut.png --cut x --size 800x600
octavo render "$scratch/gear.ply" -o docs/pictures/gear.png --size 800x600
octavo render "$scratch/gear.oct" -o docs/pictures/gear-cells.png --cut z:0.5 --elevation 50 --size 800x600
for depth in 5 6 7; do
    octavo render "$scratch/housing-$depth.oct" -o docs/pictures/housing-cells-$depth.png --cut x --size 800x600
done

# Drawings: every line is a line, every face an area.
octavo render "$scratch/housing.ply" -o docs/pictures/housing-drawing.svg --cut x:0.5,y:0:0.5 --hidden-lines \
    --perspective 25 --size 800x600
octavo render docs/examples/bracket.csg -o docs/pictures/bracket-sources.svg --paint source --size 800x600
octavo bsp "$scratch/gear.ply" -o "$scratch/gear.bso"
octavo render "$scratch/gear.bso" -o docs/pictures/gear-nodes.svg --paint node --elevation 50 --size 800x600

octavo shape knot --detail 200 -o "$scratch/knot.ply"
octavo build "$scratch/knot.ply" -o "$scratch/knot.bpo"
octavo render "$scratch/knot.ply" -o docs/pictures/knot.png --size 400x300
for level in 0 1 2 3; do
    octavo convert "$scratch/knot.bpo" "$scratch/level.ply" --level $level
    octavo render "$scratch/level.ply" -o docs/pictures/knot-level-$level.png --size 400x300
done
octavo shape sphere --detail 48 --size 0.65 -o "$scratch/ball.ply"
octavo shape menger --detail 3 -o "$scratch/sponge.ply"
octavo intersection "$scratch/sponge.ply" "$scratch/ball.ply" -o "$scratch/cut.ply" \
    --transform "$scratch/ball.ply:1,0,0,0.5,0,1,0,0.5,0,0,1,0.5"
octavo render "$scratch/cut.ply" -o docs/pictures/boolean.png --azimuth 35 --elevation 25 --edges sharp --size 600x500
octavo hexmesh "$scratch/housing.ply" --level 6 -o "$scratch/housing-mesh.oct"
octavo render "$scratch/housing-mesh.oct" -o docs/pictures/housing-hexmesh.png --cut x --size 800x600
octavo hexmesh "$scratch/housing.ply" --level 6 --fit --picture docs/pictures/housing-fitted.png

# A bracket from OpenSCAD to stresses; the last picture needs CalculiX.
cp docs/examples/bracket.inp docs/examples/mises.awk "$scratch"
bracket=(docs/examples/bracket.csg -p 1 --largest 2 --fit)
octavo hexmesh "${bracket[@]}" -o "$scratch/bracket_mesh.inp" --picture docs/pictures/bracket-mesh.png
if command -v ccx > /dev/null; then
    (cd "$scratch" && ccx bracket > bracket.log && awk -f mises.awk bracket.dat > stress.csv)
    octavo hexmesh "${bracket[@]}" --values "$scratch/stress.csv" --picture docs/pictures/bracket-stress.png
fi
ls -sh docs/pictures
