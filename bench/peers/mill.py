#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Milling: Octavo beside Manifold, the same tool taken away at the same poses, one subtraction after the other.

usage: mill.py --octavo PROGRAM [--frequency N] [--radius R] [--steps N] [--manifold-steps N] [--csv FILE]

PROGRAM is octavo_mill_scene (preset bench), which makes the workpiece, the tool and the path. Manifold is measured where
the PyPI package manifold3d is installed: it subtracts the moved tool from what the step before left, as whole meshes, and
its result is forced at each step. It does the first N steps only (default 40), since its steps cost the same from the first
to the last. Times are user CPU milliseconds of one thread; compare volumes only when both did all steps. The commit is that
of the sources; build them before.
"""
import argparse
import csv
import io
import os
import resource
import statistics
import subprocess
import sys
import tempfile

import numpy

from boolean import commit
from off_file import read_off


def user_seconds():
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime


def quantile(values, part):
    return sorted(values)[min(len(values) - 1, int(part * len(values)))]


def octavo(program, folder, frequency, radius, steps):
    text = subprocess.run([program, str(frequency), str(radius), str(steps), folder, "check"], check=True,
                          capture_output=True, text=True).stdout
    return next(csv.DictReader(io.StringIO(text)))


def manifold(folder, steps):
    import manifold3d

    def solid(name):
        points, triangles = read_off(os.path.join(folder, name))
        return manifold3d.Manifold(manifold3d.Mesh64(points, numpy.ascontiguousarray(triangles, numpy.uint64)))

    poses = numpy.loadtxt(os.path.join(folder, "poses.csv"), delimiter=",", ndmin=2)
    start = user_seconds()
    work, tool = solid("work.off"), solid("tool.off")
    row = {"engine": "manifold", "work_triangles": work.num_tri(), "tool_triangles": tool.num_tri()}
    row["prepare_s"] = f"{user_seconds() - start:.3f}"
    times = []
    for pose in poses[:steps]:
        start = user_seconds()
        work = work - tool.translate(pose)
        row["triangles"] = work.num_tri()  # forces it
        times.append(1e3 * (user_seconds() - start))
    row.update(steps=len(times), median_ms=f"{statistics.median(times):.3f}", p90_ms=f"{quantile(times, .9):.3f}",
               slowest_ms=f"{max(times):.3f}", volume=f"{work.volume():.12g}",
               peak_mb=f"{resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024:.0f}")
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--octavo", required=True)
    parser.add_argument("--frequency", type=int, default=132)
    parser.add_argument("--radius", type=float, default=0.02)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--manifold-steps", type=int, default=40)
    parser.add_argument("--csv")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        rows = [octavo(arguments.octavo, folder, arguments.frequency, arguments.radius, arguments.steps)]
        try:
            rows.append(manifold(folder, min(arguments.steps, arguments.manifold_steps)))
            rows[-1].update(radius=arguments.radius)
        except ImportError:
            print("manifold3d is not installed: left out", file=sys.stderr)
    for row in rows:
        row["commit"] = commit()
    file = open(arguments.csv, "a") if arguments.csv else sys.stdout
    writer = csv.DictWriter(file, rows[0].keys())
    if not arguments.csv or file.tell() == 0:
        writer.writeheader()
    writer.writerows(rows)


if __name__ == "__main__":
    main()
