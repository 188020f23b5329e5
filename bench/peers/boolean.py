#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Octavo beside Manifold, trueform and CGAL on the same files: arrays in memory → closed indexed mesh in memory.

usage: boolean.py --octavo PROGRAM [--cgal PROGRAM] --models FOLDER [--csv FILE] [--repeat N] [--limit S]
       [--two-threads] [CASE...]

PROGRAM are octavo_boolean_scene and octavo_boolean_cgal (preset bench). Needs numpy; Manifold and trueform are measured
where the PyPI packages manifold3d and trueform are installed. Every engine runs in a process of its own, pinned to one
CPU: user CPU seconds (least of the repetitions) and peak memory beyond what loading took. With --two-threads Octavo runs
once more, for the ratio of wall times of one and two threads, which only a quiet machine can tell. Results are
compared: volume, closed, every directed edge once. exact_share is the part of Octavo's decisions that the floating-point
filters left to exact arithmetic; commit is the state of the working tree (build it before). CASE is a part of a case's
name.
"""
import argparse
import csv
import json
import math
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy

from off_file import read_off, write_off

ENGINES = ("octavo", "manifold", "trueform", "cgal")
COLUMNS = ("case", "operation", "input", "engine", "cpu_s", "times_octavo", "peak_mb", "triangles", "volume", "defect",
           "exact_share", "speed_up_2_threads", "commit")


def commit():
    """The commit that is measured; with a plus when files differ from it."""
    here = os.path.dirname(os.path.abspath(__file__))
    try:
        return subprocess.run(["git", "-C", here, "describe", "--always", "--dirty=+", "--exclude=*"], capture_output=True,
                              text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError):
        return ""


def user_seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


class PeakMemory:
    """Peak memory from here on, beyond what is there already."""

    def __init__(self):
        with open("/proc/self/clear_refs", "w") as file:
            file.write("5")
        self.before = self.of("VmRSS")

    @staticmethod
    def of(name):
        with open("/proc/self/status") as file:
            return next(int(line.split()[1]) for line in file if line.startswith(name)) / 1024

    def megabytes(self):
        return self.of("VmHWM") - self.before


# ---------------------------------------------------------------------------------------------------------------- meshes

def read_model(path):
    """PLY (binary, triangles) and OBJ as the models have them."""
    if path.endswith(".obj"):
        points, triangles = [], []
        with open(path) as file:
            for line in file:
                words = line.split()
                if words[:1] == ["v"]:
                    points.append([float(w) for w in words[1:4]])
                elif words[:1] == ["f"]:
                    corners = [int(w.split("/")[0]) - 1 for w in words[1:]]
                    triangles += [(corners[0], b, c) for b, c in zip(corners[1:], corners[2:])]
        return numpy.array(points), numpy.array(triangles)
    import trimesh
    mesh = trimesh.load(path, process=False, force="mesh")
    return numpy.array(mesh.vertices), numpy.array(mesh.faces)


def volume(mesh):
    corners = mesh[0][mesh[1]] - (mesh[0].mean(axis=0) if len(mesh[0]) else 0)
    return float(numpy.einsum("ij,ij->i", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2])).sum() / 6)


def defect(mesh):
    """Open edges and directed edges that occur twice."""
    triangles = numpy.asarray(mesh[1], numpy.int64)
    if len(triangles) == 0:
        return ""
    edges = numpy.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    keys, counts = numpy.unique(edges[:, 0] << 32 | edges[:, 1], return_counts=True)
    partners = numpy.isin(edges[:, 1] << 32 | edges[:, 0], keys)
    parts = []
    if not partners.all():
        parts.append(f"open({int((~partners).sum())})")
    if (counts > 1).any():
        parts.append(f"doubled({int((counts > 1).sum())})")
    return " ".join(parts)


def turned(points, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return points @ numpy.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])


def sphere(segments, centre=(0, 0, 0), radius=1.0, degrees=0.0):
    """An octahedral sphere of 8 segments² triangles, turned about z."""
    grid, triangles = {}, []
    for sx in (1, -1):
        for sy in (1, -1):
            for sz in (1, -1):
                def at(a, b):
                    return grid.setdefault((sx * (segments - a - b), sy * a, sz * b), len(grid))
                for i in range(segments):
                    for j in range(segments - i):
                        corners = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                        if i + j + 1 < segments:
                            corners.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                        triangles += corners if sx * sy * sz > 0 else [(a, c, b) for a, b, c in corners]
    points = numpy.array(list(grid), float)
    points /= numpy.linalg.norm(points, axis=1)[:, None]
    return radius * turned(points, degrees) + numpy.array(centre), numpy.array(triangles)


def box(low, high):
    points = numpy.array([[(high if i >> k & 1 else low)[k] for k in range(3)] for i in range(8)], float)
    quads = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    return points, numpy.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def moved_copy(mesh):
    """The copy that the classic models lose: turned 30° about z, shifted by 20 % of the longest side."""
    points = turned(mesh[0], 30)
    points[:, 0] += 0.2 * numpy.ptp(mesh[0], axis=0).max()
    return points, mesh[1]


# ----------------------------------------------------------------------------------------------------------------- cases

def menger(level):
    """A cube of 3^level and the square prisms that make it a Menger sponge."""
    side = 3 ** level
    yield box((0, 0, 0), (side, side, side))
    for depth in range(level):
        step, hole = 3 ** (level - depth), 3 ** (level - depth - 1)
        for i in range(side // step):
            for j in range(side // step):
                # Holes inside of larger holes are left out.
                if any((i // 3 ** k) % 3 == 1 and (j // 3 ** k) % 3 == 1 for k in range(depth)):
                    continue
                low, high = (i * step + hole, j * step + hole), (i * step + 2 * hole, j * step + 2 * hole)
                for axis in range(3):
                    first, second = [0.0] * 3, [0.0] * 3
                    first[axis], second[axis] = -1.0, side + 1.0
                    for k in range(2):
                        first[(axis + 1 + k) % 3], second[(axis + 1 + k) % 3] = low[k], high[k]
                    yield box(first, second)


def beams():
    """20 and 20 bars that cross each other."""
    for k in range(20):
        yield box((k + .25, -1, .1 * k / 20), (k + .75, 21, 1 + .1 * k / 20))
    for k in range(20):
        yield box((-1, k + .25, .5 + .1 * k / 20), (21, k + .75, 1.5 + .1 * k / 20))


def ember_pairs(models):
    """The six cases whose meshes are here, and their neighbours: B of one with A of the next."""
    with open(os.path.join(models, "boolean-pairs/ember/ember-cases.json")) as file:
        listed = json.load(file)
    uses = []
    for case in listed:
        for side in "ab":
            columns = [[case["transform_" + side][f"col{c}"][k] for k in "xyzw"] for c in range(4)]
            uses.append((case["id_" + side], numpy.array(columns).T))

    def load(use):
        points, triangles = read_model(os.path.join(models, f"boolean-pairs/ember/{use[0]}.ply"))
        return points @ use[1][:3, :3].T + use[1][:3, 3], triangles

    for k in range(len(uses) - 1):
        yield f"ember-{'case' if k % 2 == 0 else 'pair'}-{k // 2 + 1}", uses[k], uses[k + 1], load


def cases(models):
    def load(name):
        return read_model(os.path.join(models, name))

    second = dict(centre=(1, .0131, .0077), degrees=17)
    for name, segments in (("spheres-20k", 50), ("spheres-200k", 158), ("spheres-1M", 354)):
        yield name, "union", lambda n=segments: [sphere(n), sphere(n, **second)]
    for name in ("bunny-closed-100k.ply", "armadillo-100k.ply", "fertility-60k.ply", "igea-269k.ply"):
        yield name[:-4] + "-minus-copy", "difference", lambda n=name: [load("classic/" + n),
                                                                        moved_copy(load("classic/" + n))]
    yield "bunny-twice", "union", lambda: [load("classic/bunny-closed-100k.ply")] * 2
    yield "bunny-minus-itself", "difference", lambda: [load("classic/bunny-closed-100k.ply")] * 2
    for name, first, other, place in ember_pairs(models):
        yield name, "difference", lambda a=first, b=other, p=place: [p(a), p(b)]
    for pair in ("twin7081", "twin7863", "havocglass", "hull", "offset34", "self-intersect", "cray"):
        for operation in ("union", "difference"):
            yield pair, operation, lambda p=pair: [load(f"boolean-pairs/manifold-{p}-{side}.obj") for side in "ab"]
    for exponent in (6, 9):
        yield f"bunny-turned-1e-{exponent}", "union", lambda e=exponent: [
            load("classic/bunny-closed-100k.ply"),
            (turned(load("classic/bunny-closed-100k.ply")[0], math.degrees(10 ** -e)),
             load("classic/bunny-closed-100k.ply")[1])]
    generator = numpy.random.default_rng(1)
    spheres = [(generator.uniform(0, 1, 3), generator.uniform(.028, .056)) for _ in range(1000)]
    unit = sphere(16)
    yield "spheres-1000", "union", lambda: [(r * unit[0] + c, unit[1]) for c, r in spheres]
    for level in (2, 3, 4):
        yield f"menger-{level}", "difference", lambda n=level: list(menger(n))
    yield "beams-20-20", "union", lambda: list(beams())


# --------------------------------------------------------------------------------------------------------------- engines

def run_manifold(operation, meshes):
    import manifold3d
    arrays = [(numpy.ascontiguousarray(p, numpy.float64), numpy.ascontiguousarray(t, numpy.uint64)) for p, t in meshes]
    kind = {"union": manifold3d.OpType.Add, "difference": manifold3d.OpType.Subtract,
            "intersection": manifold3d.OpType.Intersect}[operation]

    def once():
        solids = [manifold3d.Manifold(manifold3d.Mesh64(p, t)) for p, t in arrays]
        result = manifold3d.Manifold.batch_boolean(solids, kind)
        mesh = result.to_mesh64()
        if result.status() != manifold3d.Error.NoError:
            raise RuntimeError(str(result.status()))
        return mesh
    return once, lambda mesh: (numpy.array(mesh.vert_properties)[:, :3], numpy.array(mesh.tri_verts))


def run_trueform(operation, meshes):
    import trueform
    if len(meshes) != 2:
        raise RuntimeError("pairs only")
    arrays = [(numpy.ascontiguousarray(t, numpy.int32), numpy.ascontiguousarray(p, numpy.float64)) for p, t in meshes]
    operate = {"union": trueform.boolean_union, "difference": trueform.boolean_difference,
               "intersection": trueform.boolean_intersection}[operation]
    return lambda: operate(*[trueform.Mesh(t, p) for t, p in arrays])[0], lambda mesh: (mesh[1], mesh[0])


def engine_main(engine, operation, repeat, result, paths):
    """In a process of its own: one engine on files."""
    try:
        once, arrays = {"manifold": run_manifold, "trueform": run_trueform}[engine](operation, [read_off(p) for p in paths])
        memory, seconds = PeakMemory(), []
        for run in range(repeat):
            start = user_seconds()
            mesh = once()
            seconds.append(user_seconds() - start)
            if run == 0:
                peak = memory.megabytes()
        mesh = arrays(mesh)
        numpy.savez(result, points=mesh[0], triangles=mesh[1])
        print(json.dumps({"cpu": min(seconds), "peak_mb": peak}))
    except Exception as error:  # whatever a peer refuses with is its answer
        print(json.dumps({"error": f"{type(error).__name__}: {error}"[:80]}))


def measure(engine, arguments, operation, paths, folder):
    """The engine's answer and its mesh, or None for an engine that is not there."""
    result = os.path.join(folder, "result.off" if engine in ("octavo", "cgal") else "result.npz")
    if os.path.exists(result):
        os.remove(result)
    if engine == "octavo":
        command = [arguments.octavo, "--repeat", str(arguments.repeat), "--output", result, operation, *paths]
    elif engine == "cgal":
        if not arguments.cgal:
            return None
        if len(paths) != 2:
            return {"error": "pairs only"}, None
        command = [arguments.cgal, operation, *paths, result]
    else:
        command = [sys.executable, os.path.abspath(__file__), "--engine", engine, "--repeat", str(arguments.repeat), "--operation",
                   operation, "--result", result, *paths]
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=arguments.limit, env=environment)
    except subprocess.TimeoutExpired:
        return {"error": f"longer than {arguments.limit:g} s"}, None
    answer = json.loads(done.stdout.splitlines()[-1]) if done.stdout else {"error": f"died ({done.returncode})"}
    if "ModuleNotFoundError" in answer.get("error", ""):
        return None
    if not os.path.exists(result):
        return answer, None
    if result.endswith(".npz"):
        arrays = numpy.load(result)
        return answer, (arrays["points"], arrays["triangles"])
    return answer, read_off(result)


def speed_up(arguments, operation, paths):
    """Wall time of one thread by that of two, least of five runs each; meaningful on a quiet machine only."""
    os.sched_setaffinity(0, arguments.cpus)
    walls = []
    for threads in ("1", "2"):
        done = subprocess.run([arguments.octavo, "--repeat", "5", "--threads", threads, operation, *paths],
                              capture_output=True, text=True)
        walls.append(json.loads(done.stdout).get("wall", math.nan))
    os.sched_setaffinity(0, {min(arguments.cpus)})
    return walls[0] / walls[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--octavo")
    parser.add_argument("--cgal")
    parser.add_argument("--models")
    parser.add_argument("--csv")
    parser.add_argument("--repeat", type=int, default=3)
    parser.add_argument("--limit", type=float, default=180, help="wall seconds after which an engine is given up")
    parser.add_argument("--two-threads", action="store_true", help="measure the speed-up of two threads too")
    parser.add_argument("--engine", help=argparse.SUPPRESS)
    parser.add_argument("--operation", help=argparse.SUPPRESS)
    parser.add_argument("--result", help=argparse.SUPPRESS)
    parser.add_argument("names", nargs="*")
    arguments = parser.parse_args()
    if arguments.engine:
        return engine_main(arguments.engine, arguments.operation, arguments.repeat, arguments.result, arguments.names)
    arguments.cpus = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(arguments.cpus)})

    rows, ratios, state = [], {engine: [] for engine in ENGINES}, commit()
    ember = {engine: [] for engine in ENGINES}
    for name, operation, make in cases(arguments.models):
        if arguments.names and not any(part in name for part in arguments.names):
            continue
        meshes = make()
        count = sum(len(triangles) for _, triangles in meshes)
        with tempfile.TemporaryDirectory() as folder:
            paths = []
            for number, mesh in enumerate(meshes):
                paths.append(os.path.join(folder, f"{number:05}.off"))
                write_off(paths[-1], mesh)
            ours = None
            for engine in ENGINES:
                measured = measure(engine, arguments, operation, paths, folder)
                if measured is None:
                    continue
                answer, mesh = measured
                row = {"case": name, "operation": operation, "input": count, "engine": engine, "commit": state}
                if "error" in answer:
                    row["defect"] = answer["error"]
                else:
                    ours = answer["cpu"] if engine == "octavo" else ours
                    row.update(cpu_s=f"{answer['cpu']:.4f}", peak_mb=f"{answer['peak_mb']:.1f}")
                    if ours and answer["cpu"] > 0:  # user time is counted in ticks, which the smallest cases stay below
                        row["times_octavo"] = f"{answer['cpu'] / ours:.2f}"
                        ratios[engine].append(answer["cpu"] / ours)
                    if name.startswith("ember"):
                        ember[engine].append(answer["cpu"])
                    if mesh is not None:
                        row.update(triangles=len(mesh[1]), volume=f"{volume(mesh):.10g}", defect=defect(mesh))
                if engine == "octavo" and "error" not in answer:
                    row["exact_share"] = f"{answer['exact'] / max(1, answer['decisions']):.5f}"
                    if arguments.two_threads:
                        row["speed_up_2_threads"] = f"{speed_up(arguments, operation, paths):.2f}"
                rows.append(row)
                print("  ".join(f"{row.get(column, '')!s:>10}" for column in COLUMNS), flush=True)
    for engine in ENGINES:
        if ratios[engine]:
            mean = math.exp(sum(map(math.log, ratios[engine])) / len(ratios[engine]))
            print(f"{engine}: geometric mean of CPU time by Octavo's {mean:.2f} over {len(ratios[engine])} cases")
        if ember[engine]:
            mean = math.exp(sum(map(math.log, ember[engine])) / len(ember[engine]))
            print(f"{engine}: geometric mean of the {len(ember[engine])} EMBER pairs {mean:.4f} s")
    if arguments.csv:
        with open(arguments.csv, "w", newline="") as file:
            file.write(f"# {time.strftime('%Y-%m-%d')}, user CPU seconds of one thread, load average {os.getloadavg()[0]:.1f}\n")
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
