#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares BP-octrees with F. J. Melero's thesis (2008): planes (table 4.1) and volumes (table 4.3) of each level.

    bp_octree_thesis.py OCTAVO FOLDER [greedy|k-medoids] [normal|fast] > bench/results/DATE-bp-octree.csv

FOLDER holds the models. Ours are other simplifications of the same scans; leaf_triangles is scaled by the number of
triangles, so that leaves are as deep as the thesis's, whose leaves hold fewer than 50.
"""
import json
import subprocess
import sys

# Triangles, planes of each level, volumes of each level in per cent of the solid.
THESIS = {
    "Bunny": (71040, [656, 2004, 4976, 11716, 25093, 53180, 86010, 50],
              [171.41, 144.71, 119.92, 107.33, 103.11, 101.14, 100.55, 100.55]),
    "Armadillo": (150000, [1228, 3497, 7543, 16548, 35022, 72610, 144834, 160059, 645],
                  [388.73, 214.88, 139.57, 116.78, 107.99, 103.45, 101.57, 100.92, 100.92]),
    "Fertility": (483226, [4462, 12053, 25689, 49840, 96595, 184336, 349661, 592770, 88237],
                  [203.49, 182.88, 140.04, 114.99, 104.17, 101.20, 100.48, 100.24, 100.22]),
    "Stanford Dragon": (871414, [2955, 7287, 18373, 43876, 99023, 203160, 408036, 754485, 672812],
                        [277.82, 199.08, 165.60, 135.50, 111.44, 103.68, 101.30, 100.50, 100.32]),
}
MODELS = [("bunny-closed-100k", "Bunny"), ("armadillo-100k", "Armadillo"), ("armadillo-346k", "Armadillo"),
          ("fertility-60k", "Fertility"), ("dragon-closed-100k", "Stanford Dragon"), ("igea-269k", None)]


def build(program, path, options):
    run = subprocess.run([program, "build", path, "--json", "--certify", *options], capture_output=True, check=True)
    return json.loads(run.stdout)["result"]


def main():
    program, folder = sys.argv[1:3]
    planes_by = sys.argv[3] if len(sys.argv) > 3 else "greedy"
    quality = sys.argv[4] if len(sys.argv) > 4 else "normal"
    print("model,triangles,leaf_triangles,level,planes,volume_percent,bytes,thesis_planes,thesis_volume_percent,planes_ratio")
    for model, name in MODELS:
        path = f"{folder}/{model}.ply"
        options = ["--planes", planes_by, "--quality", quality]
        tree = build(program, path, options)
        leaf = 50
        if name:
            leaf = min(50, max(1, 49 * tree["triangles"] // THESIS[name][0]))
        if leaf != 50:
            tree = build(program, path, [*options, "--leaf-triangles", str(leaf)])
        for level in tree["levels"]:
            i = level["level"]
            thesis = ["", "", ""]
            if name and i < len(THESIS[name][1]):
                planes, volume = THESIS[name][1][i], THESIS[name][2][i]
                thesis = [planes, volume, f"{level['planes'] / planes:.3f}"]
            print(model, tree["triangles"], leaf, i, level["planes"], f"{level['volume_percent']:.3f}", level["bytes"],
                  *thesis, sep=",")
        sys.stdout.flush()


main()
