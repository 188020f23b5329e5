// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#include <octavo/mesh/mesh.hpp>

// A generated solid of any size for benchmarks: star-shaped, closed, concave everywhere.

namespace octavo::bench {

/// A sphere by latitude and longitude whose radius waves in six octaves; 20 · 4^level triangles.
inline mesh::Mesh wavy_sphere(int level) {
    mesh::Mesh mesh;
    const int steps = 1 << level;
    const int rows = steps * 5 / 2, columns = steps * 4;
    mesh.vertices.push_back({0, 0, -1});
    for (int row = 1; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const double latitude = 3.141592653589793 * (static_cast<double>(row) / rows - 0.5);
            const double longitude = 2 * 3.141592653589793 * column / columns;
            mesh.vertices.push_back({std::cos(latitude) * std::cos(longitude),
                                     std::cos(latitude) * std::sin(longitude), std::sin(latitude)});
        }
    mesh.vertices.push_back({0, 0, 1});
    const auto vertex = [&](int row, int column) {
        return static_cast<std::uint32_t>(1 + (row - 1) * columns + column % columns);
    };
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    for (int column = 0; column < columns; ++column) {
        mesh.triangles.push_back({0, vertex(1, column + 1), vertex(1, column)});
        for (int row = 1; row + 1 < rows; ++row) {
            mesh.triangles.push_back(
                {vertex(row, column), vertex(row, column + 1), vertex(row + 1, column + 1)});
            mesh.triangles.push_back(
                {vertex(row, column), vertex(row + 1, column + 1), vertex(row + 1, column)});
        }
        mesh.triangles.push_back({last, vertex(rows - 1, column), vertex(rows - 1, column + 1)});
    }
    for (Vec3& v : mesh.vertices) {
        double wave = 0, frequency = 2.3, height = 0.175;
        for (int octave = 0; octave < 6; ++octave, frequency *= 2, height /= 2)
            wave += height * std::sin(frequency * v.x + 1.3 * octave) *
                    std::sin(frequency * v.y + 0.7 * octave) * std::cos(frequency * v.z + 2.1 * octave) * 2;
        v = (1 + wave) * v;
    }
    return mesh;
}

}  // namespace octavo::bench
