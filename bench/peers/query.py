#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Inside and distance: Octavo, Embree and CGAL (octavo_query_peers), then peers from PyPI on the same arrays.

usage: query.py PROGRAM MODEL|sphere:LEVEL [uniform|near] [POINTS=1000000] [RUNS=5]
PROGRAM is octavo_query_peers. Peers that are installed take part: fcpw, libigl, open3d, trimesh (with embreex); numpy
is needed. Prints CSV: CPU nanoseconds a point (all threads of the process, so more threads do not look faster), build
seconds, answers that differ from Octavo's, and the largest difference of distances.
"""
import os
import subprocess
import sys
import tempfile
import time

for variable in ("OMP_NUM_THREADS", "TBB_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ[variable] = "1"

import numpy  # noqa: E402  threads are counted when it is loaded


def timed(work, runs):
    """The median CPU time of some runs, and the last result."""
    seconds = []
    for _ in range(runs):
        start = time.process_time()
        result = work()
        seconds.append(time.process_time() - start)
    return sorted(seconds)[len(seconds) // 2], result


class Comparison:
    def __init__(self, folder, runs):
        def load(name, kind, columns=1):
            array = numpy.fromfile(f"{folder}/{name}", kind)
            return array.reshape(-1, columns) if columns > 1 else array
        self.vertices = load("vertices.f32", numpy.float32, 3)
        self.triangles = load("triangles.u32", numpy.uint32, 3).astype(numpy.int32)
        self.points = load("points.f32", numpy.float32, 3)
        self.inside = load("inside.i8", numpy.int8)
        self.distance = load("distance.f64", numpy.float64)
        self.runs = runs

    def report(self, name, build, seconds, inside=None, distance=None):
        count = len(inside if inside is not None else distance)
        different, largest = 0, 0
        if inside is not None:
            different = int(numpy.count_nonzero(inside != (self.inside[:count] < 0)))
        if distance is not None:
            largest = float(numpy.abs(numpy.abs(distance) - self.distance[:count]).max())
        print(f"{name},{build:.3f},,{1e9 * seconds / count:.1f},{different},{largest:.2g}", flush=True)

    def fcpw(self):
        import fcpw
        from fcpw import py
        def make():
            scene = fcpw.scene_3D()
            scene.set_object_count(1)
            scene.set_object_vertices(self.vertices, 0)
            scene.set_object_triangles(self.triangles, 0)
            scene.build(fcpw.aggregate_type.bvh_surface_area, True)
            return scene
        build, scene = timed(make, 1)
        radii = numpy.full(len(self.points), numpy.inf, numpy.float32)
        found = py.interaction_3D_list()
        seconds, _ = timed(lambda: scene.find_closest_points(self.points, radii, found), self.runs)
        distance = numpy.array([one.d for one in found])
        self.report("FCPW distance", build, seconds, distance=distance)
        # The form that takes arrays leaves its result unwritten in 1.2.0.
        some, inside = py.float_3D_list(), py.uint32_list()
        for point in self.points[:100000]:
            some.append(point)
        seconds, _ = timed(lambda: scene.contains(some, inside), self.runs)
        self.report("FCPW contains", build, seconds, inside=numpy.array(list(inside)) != 0)

    def libigl(self):
        import igl
        some = self.points[:20000].astype(numpy.float64)
        vertices = self.vertices.astype(numpy.float64)
        def ask():
            return igl.signed_distance(some, vertices, self.triangles,
                                       sign_type=igl.SIGNED_DISTANCE_TYPE_FAST_WINDING_NUMBER)
        seconds, answer = timed(ask, 1)
        self.report("libigl signed distance (with build)", 0, seconds, inside=answer[0] < 0, distance=answer[0])

    def open3d(self):
        import open3d
        def make():
            scene = open3d.t.geometry.RaycastingScene(nthreads=1)
            scene.add_triangles(open3d.core.Tensor(self.vertices), open3d.core.Tensor(self.triangles.astype(numpy.uint32)))
            return scene
        build, scene = timed(make, 1)
        points = open3d.core.Tensor(self.points)
        seconds, occupancy = timed(lambda: scene.compute_occupancy(points, nthreads=1), self.runs)
        self.report("Open3D occupancy", build, seconds, inside=occupancy.numpy() > 0.5)
        seconds, distance = timed(lambda: scene.compute_signed_distance(points, nthreads=1), self.runs)
        self.report("Open3D signed distance", build, seconds, inside=distance.numpy() < 0,
                    distance=distance.numpy().astype(numpy.float64))

    def trimesh(self):
        import trimesh
        mesh = trimesh.Trimesh(self.vertices, self.triangles, process=False)
        some = self.points[:100000].astype(numpy.float64)
        mesh.contains(some[:1])  # builds
        seconds, inside = timed(lambda: mesh.contains(some), 1)
        self.report("trimesh contains", 0, seconds, inside=inside)
        few = some[:2000]
        seconds, answer = timed(lambda: trimesh.proximity.closest_point(mesh, few), 1)
        self.report("trimesh closest point", 0, seconds, distance=answer[1])


def main():
    program, model, *rest = sys.argv[1:]
    rest += ["uniform", "1000000", "5"][len(rest):]
    with tempfile.TemporaryDirectory() as folder:
        print(subprocess.run([program, model, *rest, folder], check=True, capture_output=True, text=True).stdout, end="")
        comparison = Comparison(folder, int(rest[2]))
    for peer in ("fcpw", "libigl", "open3d", "trimesh"):
        try:
            getattr(comparison, peer)()
        except ImportError:
            print(f"# {peer} is not installed")
        except Exception as trouble:  # a peer that fails is a finding, not the end of the comparison
            print(f"# {peer}: {trouble!r}")


main()
