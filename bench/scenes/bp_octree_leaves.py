#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the leaves of BP-octrees with tables 3.1 and 3.2 of F. J. Melero's thesis (2008): leaves of each level under its
three criteria, fewer than 50 triangles (a leaf, or siblings in sum), 20 on average among siblings, none.

    bp_octree_leaves.py OCTAVO FOLDER > bench/results/DATE-bp-octree-leaves.csv

FOLDER holds the models. What meets no joining (`none`) depends on the surface alone, so it compares for any simplification.
"""
import json
import subprocess
import sys

# Leaves of levels 2 to 9.
THESIS = {
    "Bunny": {"count": [1, 17, 189, 1706, 11694, 13, 0, 0], "mean": [0, 1, 10, 177, 3779, 12, 0, 0],
              "none": [0, 0, 0, 0, 0, 0, 0, 1089598]},
    "Fertility": {"count": [0, 0, 8, 898, 8280, 66824, 18187, 6], "mean": [0, 3, 62, 781, 20564, 2533, 0, 0],
                  "none": [0, 0, 0, 0, 0, 0, 0, 1551983]},
}
# The scan that the thesis used itself (71 040 triangles there, holes closed), and one of an eighth of its triangles.
MODELS = [("bunny-stanford", "Bunny"), ("bunny-closed-100k", "Bunny"), ("fertility-60k", "Fertility")]
OPTIONS = {"count": ["--leaf-triangles", "49"], "sum": ["--coalesce", "sum", "--leaf-triangles", "49"], "mean": ["--coalesce", "mean"], "none": ["--coalesce", "none"]}


def main():
    program, folder = sys.argv[1:3]
    print("model,triangles,criterion,level,leaves,thesis_leaves")
    for criterion, options in OPTIONS.items():
        for model, name in MODELS:
            run = subprocess.run([program, "build", f"{folder}/{model}.ply", "--json", "--quality", "fast", *options],
                                 capture_output=True, check=True)
            tree = json.loads(run.stdout)["result"]
            for level in tree["levels"][2:]:
                i = level["level"]
                print(model, tree["triangles"], criterion, i, level["gray"], THESIS[name]["count" if criterion == "sum" else criterion][i - 2], sep=",")
            sys.stdout.flush()


main()
