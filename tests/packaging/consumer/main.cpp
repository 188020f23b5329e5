// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include <octavo/mesh/snap.hpp>

// A user's first program: a tetrahedron on the lattice.
int main() {
    octavo::mesh::Mesh tetrahedron;
    tetrahedron.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const octavo::Result<octavo::mesh::Snapped> snapped = octavo::mesh::snap(tetrahedron);
    std::printf("snapped %zu vertices, moved %zu\n", snapped->mesh.points.size(),
                snapped->report.moved_vertices);
    return snapped->report.moved_vertices == 0 ? 0 : 1;
}
