# SPDX-License-Identifier: Apache-2.0
"""OFF files of triangles as numpy arrays: points (n, 3) and corners (m, 3)."""
import numpy


def write_off(path, mesh):
    points, triangles = mesh
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        file.writelines(f"{x!r} {y!r} {z!r}\n" for x, y, z in numpy.asarray(points, float).tolist())
        file.writelines(f"3 {a} {b} {c}\n" for a, b, c in numpy.asarray(triangles).tolist())


def read_off(path):
    with open(path) as file:
        numbers = file.read().split()
    points, triangles = int(numbers[1]), int(numbers[2])
    end = 4 + 3 * points
    return (numpy.array(numbers[4:end], float).reshape(-1, 3),
            numpy.array(numbers[end:end + 4 * triangles], numpy.int64).reshape(-1, 4)[:, 1:])
