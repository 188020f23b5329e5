#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Octavo beside Manifold on the same files, one thread, CPU time, arrays in memory → closed indexed mesh in memory.

usage: boolean.py PROGRAM MODELS [CASE...]
PROGRAM is octavo_boolean_scene, MODELS the folder of test models; needs the PyPI packages manifold3d, numpy, trimesh.
Prints a line per case: input triangles, CPU seconds of both, their ratio, relative difference of the volumes.
"""
import json
import math
import os
import resource
import subprocess
import sys
import tempfile

import manifold3d
import numpy
import trimesh


def cpu():
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return usage.ru_utime + usage.ru_stime


def sphere(segments, centre=(0, 0, 0), radius=1.0, degrees=0.0):
    """An octahedral sphere of 8 segments² triangles, turned about z."""
    grid = {}
    triangles = []

    def vertex(key):
        return grid.setdefault(key, len(grid))

    for sx in (1, -1):
        for sy in (1, -1):
            for sz in (1, -1):
                for i in range(segments):
                    for j in range(segments - i):
                        def at(a, b):
                            return vertex((sx * (segments - a - b), sy * a, sz * b))
                        corners = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                        if i + j + 1 < segments:
                            corners.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                        triangles += corners if sx * sy * sz > 0 else [(a, c, b) for a, b, c in corners]
    points = numpy.array(list(grid), float)
    points /= numpy.linalg.norm(points, axis=1)[:, None]
    angle = math.radians(degrees)
    turn = numpy.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    return trimesh.Trimesh(radius * points @ turn.T + numpy.array(centre), triangles, process=False)


def moved_copy(mesh):
    """The copy that the classic models lose: turned 30° about z, shifted by 20 % of the longest side."""
    angle = math.radians(30)
    turn = numpy.array([[math.cos(angle), -math.sin(angle), 0], [math.sin(angle), math.cos(angle), 0], [0, 0, 1]])
    shift = 0.2 * mesh.extents.max() * numpy.array([1, 0, 0])
    return trimesh.Trimesh(mesh.vertices @ turn.T + shift, mesh.faces, process=False)


def cases(models):
    def load(name):
        return trimesh.load(os.path.join(models, name), process=False, force="mesh")

    second = dict(centre=(1, .0131, .0077), degrees=17)
    for name, segments in (("spheres-20k", 50), ("spheres-200k", 158), ("spheres-1M", 354)):
        yield name, "union", lambda n=segments: [sphere(n), sphere(n, **second)]
    for name in ("bunny-closed-100k.ply", "armadillo-100k.ply", "fertility-60k.ply", "igea-269k.ply"):
        yield name[:-4] + "-minus-copy", "difference", lambda n=name: [load("classic/" + n), moved_copy(load("classic/" + n))]
    yield "bunny-twice", "union", lambda: [load("classic/bunny-closed-100k.ply")] * 2
    for pair in ("twin7081", "twin7863", "havocglass", "hull", "offset34", "self-intersect"):
        for operation in ("union", "difference"):
            yield pair, operation, lambda p=pair: [load(f"boolean-pairs/manifold-{p}-{side}.obj") for side in "ab"]
    generator = numpy.random.default_rng(1)
    spheres = [(generator.uniform(0, 1, 3), generator.uniform(.028, .056)) for _ in range(1000)]
    yield "spheres-1000", "union", lambda: [sphere(16, c, r) for c, r in spheres]


def run_manifold(operation, meshes):
    arrays = [(numpy.asarray(m.vertices, numpy.float64), numpy.asarray(m.faces, numpy.uint64)) for m in meshes]
    start = cpu()
    solids = [manifold3d.Manifold(manifold3d.Mesh64(v, f)) for v, f in arrays]
    kind = {"union": manifold3d.OpType.Add, "difference": manifold3d.OpType.Subtract,
            "intersection": manifold3d.OpType.Intersect}[operation]
    result = manifold3d.Manifold.batch_boolean(solids, kind)
    result.to_mesh64()
    seconds = cpu() - start
    return seconds, result.num_tri(), result.volume(), str(result.status())


def main():
    program, models, wanted = sys.argv[1], sys.argv[2], sys.argv[3:]
    os.environ["OMP_NUM_THREADS"] = "1"
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    print(f"{'case':34} {'operation':12} {'input':>8} {'octavo s':>9} {'manifold s':>10} {'ratio':>6} {'volume':>9}")
    ratios = []
    for name, operation, make in cases(models):
        if wanted and not any(part in name for part in wanted):
            continue
        meshes = make()
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for number, mesh in enumerate(meshes):
                paths.append(os.path.join(folder, f"{number:05}.off"))
                with open(paths[-1], "w") as file:
                    file.write(f"OFF\n{len(mesh.vertices)} {len(mesh.faces)} 0\n")
                    file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in mesh.vertices.tolist())
                    file.writelines(f"3 {a} {b} {c}\n" for a, b, c in mesh.faces.tolist())
            done = subprocess.run([program, "--repeat", "3", operation] + paths, capture_output=True, text=True)
        ours = json.loads(done.stdout) if done.stdout else {"error": done.stderr}
        seconds, triangles, volume, status = run_manifold(operation, meshes)
        count = sum(len(mesh.faces) for mesh in meshes)
        if "error" in ours:
            print(f"{name:34} {operation:12} {count:8} {ours['error'][:60]}")
            continue
        ratios.append(seconds / ours["cpu"])
        off = abs(ours["volume"] - volume) / max(abs(volume), 1e-300)
        print(f"{name:34} {operation:12} {count:8} {ours['cpu']:9.4f} {seconds:10.4f} {ratios[-1]:6.2f} {off:9.1e}"
              f"  {ours['triangles']} / {triangles} {'' if status == 'Error.NoError' else status}")
        sys.stdout.flush()
    if ratios:
        print(f"geometric mean of the ratios: {math.exp(sum(map(math.log, ratios)) / len(ratios)):.2f}")


if __name__ == "__main__":
    main()
