// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/topology.hpp>

// What several mesh tests share: a list of every generated solid, and the counts of edges by their sides.

namespace octavo::tests {

struct NamedMesh {
    std::string name;
    mesh::Mesh mesh;
    std::int64_t genus = 0;
};

inline std::vector<NamedMesh> generated_solids() {
    using namespace mesh;
    const Outline square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const std::vector<Outline> holes{{{1, 1}, {2, 1}, {2, 2}}, circle(0.5, 7, {3, 3})};
    return {{"box", box({-1, 0, 2}, {3, 1, 5})},
            {"cube", cube(2)},
            {"tetrahedron", tetrahedron()},
            {"octasphere", octasphere(2, 7)},
            {"icosphere", icosphere(1.5, 6)},
            {"uv sphere", uv_sphere(1, 12, 8)},
            {"thin uv sphere", uv_sphere(1, 3, 2)},
            {"cylinder", cylinder(1, 3, 31)},
            {"cone", cone(2, 0, 3, 20)},
            {"hanging cone", cone(0, 2, 3, 20)},
            {"frustum", cone(2, 1, 3, 20)},
            {"torus", torus(3, 1, 24, 12), 1},
            {"extrusion with holes", extrude(square, holes, 1.5), 2},
            {"gear", gear(), 7},
            {"gear without holes", gear({.teeth = 11, .bore_radius = 3, .lightening_holes = 0}), 1},
            {"bearing housing", bearing_housing(), 7},
            {"trefoil", knot_tube(2, 3, 0.3, 150, 12), 1},
            {"rough sphere", displaced_sphere(12)},
            {"sponge", menger_sponge(1), 5},
            {"fine sponge", menger_sponge(2), 81}};
}

struct EdgeCounts {
    std::size_t open = 0, non_manifold = 0, misoriented = 0;
    friend bool operator==(const EdgeCounts&, const EdgeCounts&) = default;
};

/// Counted independently of validate().
inline EdgeCounts count_edges(const mesh::Mesh& m) {
    const mesh::EdgeTable edges = mesh::build_edges(m.triangles, m.vertices.size());
    EdgeCounts counts;
    for (mesh::EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        int balance = 0;
        for (const mesh::SideIndex side : sides) balance += mesh::runs_upward(m.triangles, side) ? 1 : -1;
        counts.open += sides.size() == 1;
        counts.non_manifold += sides.size() > 2;
        counts.misoriented += sides.size() > 1 && balance != 0;
    }
    return counts;
}

}  // namespace octavo::tests
