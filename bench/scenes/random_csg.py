#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a random scene as an OpenSCAD tree: balls, boxes and cylinders about a unit cube, turned at random.

usage: random_csg.py PRIMITIVES SEED > SCENE.csg
"""
import math
import random
import sys


def turned(rng):
    q = [rng.gauss(0, 1) for _ in range(4)]
    norm = math.sqrt(sum(c * c for c in q))
    w, x, y, z = (c / norm for c in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), rng.random()],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), rng.random()],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), rng.random()], [0, 0, 0, 1]]


def primitive(rng, size):
    r = size * (0.5 + rng.random())
    kind = rng.randrange(3)
    if kind == 0:
        shape = f"sphere(r = {r:.6g});"
    elif kind == 1:
        shape = f"cube(size = [{2 * r:.6g}, {1.4 * r:.6g}, {1.6 * r:.6g}], center = true);"
    else:
        shape = f"cylinder(h = {2 * r:.6g}, r1 = {0.6 * r:.6g}, r2 = {0.6 * r:.6g}, center = true);"
    rows = ", ".join("[" + ", ".join(f"{c:.6g}" for c in row) + "]" for row in turned(rng))
    return f"multmatrix([{rows}]) {{ {shape} }}"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    count, rng = int(sys.argv[1]), random.Random(int(sys.argv[2]))
    size = 0.8 / count ** (1 / 3)
    print("difference() {\n\tgroup() {")
    for _ in range(count - count // 4):
        print("\t\t" + primitive(rng, size))
    print("\t}")
    for _ in range(count // 4):
        print("\t" + primitive(rng, size))
    print("}")


if __name__ == "__main__":
    main()
