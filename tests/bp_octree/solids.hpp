// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <octavo/mesh/snap.hpp>

// Small solids for the tests of BP-octrees.

namespace octavo::tests {

inline mesh::LatticeMesh on_lattice(const mesh::Mesh& mesh) {
    auto snapped = mesh::snap(mesh);
    EXPECT_TRUE(snapped.has_value());
    return std::move(snapped).value().mesh;
}

/// A sphere of 8 · 4^depth triangles whose radius waves, concave in many places but star-shaped.
inline mesh::Mesh bumpy_sphere(int depth, double amplitude = 0.3) {
    mesh::Mesh mesh;
    mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < depth; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [entry, is_new] = middles.try_emplace(
                {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.vertices.size()));
            if (is_new) {
                const Vec3 m = mesh.vertices[a] + mesh.vertices[b];
                mesh.vertices.push_back((1 / length(m)) * m);
            }
            return entry->second;
        };
        std::vector<mesh::Triangle> finer;
        for (const mesh::Triangle& t : mesh.triangles) {
            const std::uint32_t a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
            finer.insert(finer.end(), {{t[0], a, c}, {t[1], b, a}, {t[2], c, b}, {a, b, c}});
        }
        mesh.triangles = finer;
    }
    for (Vec3& v : mesh.vertices) {
        const double wave = std::sin(5 * v.x + 1) * std::sin(4 * v.y) + std::cos(7 * v.z) * std::sin(6 * v.x);
        v = (1 + amplitude * wave) * v;
    }
    return mesh;
}

/// Appends an axis-aligned box, facing outwards.
inline void add_box(mesh::Mesh& mesh, Vec3 low, Vec3 high) {
    const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i < 8; ++i)
        mesh.vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    constexpr std::uint32_t quads[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (const auto& q : quads) {
        mesh.triangles.push_back({base + q[0], base + q[1], base + q[2]});
        mesh.triangles.push_back({base + q[0], base + q[2], base + q[3]});
    }
}

inline mesh::Mesh box(Vec3 low, Vec3 high) {
    mesh::Mesh mesh;
    add_box(mesh, low, high);
    return mesh;
}

}  // namespace octavo::tests
