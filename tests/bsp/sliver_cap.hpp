// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>

#include <octavo/mesh/mesh.hpp>

namespace octavo::tests {

/// A prism whose upper face is a fan of `count` slivers from one end of an arc: each is many thousand times as long as
/// it is wide, and a few units up or down tilt all of them differently. Coordinates are multiples of `unit`, up to 2^26
/// of them.
inline mesh::Mesh sliver_cap(std::uint32_t count, double unit) {
    std::mt19937 random(count);
    const std::int32_t step = (1 << 25) / static_cast<std::int32_t>(count), height = 1 << 20;
    const std::uint32_t corners = count + 2;
    mesh::Mesh mesh;
    for (std::uint32_t i = 0; i < corners; ++i) {
        const auto at = static_cast<std::int32_t>(i);
        mesh.vertices.push_back(unit * Vec3{1000.0 + double(at) * step,
                                            1000.0 + double(at) * (double(corners) - 1 - at),
                                            1000.0 + height + double(random() % 16)});
    }
    for (std::uint32_t i = 0; i < corners; ++i)
        mesh.vertices.push_back({mesh.vertices[i].x, mesh.vertices[i].y, 1000 * unit});
    for (std::uint32_t i = 1; i + 1 < corners; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({corners, corners + i, corners + i + 1});
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t next = (i + 1) % corners;
        mesh.triangles.push_back({i, next, corners + next});
        mesh.triangles.push_back({i, corners + next, corners + i});
    }
    return mesh;
}

}  // namespace octavo::tests
