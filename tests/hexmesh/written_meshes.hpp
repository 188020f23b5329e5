// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/mesh/shapes.hpp>

// Meshes that tests of several writers write, and what they need to look at the files.

namespace octavo::hexmesh {

inline bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " > /dev/null 2>&1").c_str()) == 0;
}

inline std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

/// Two spheres of different sizes of cell, and a box that is finer still: levels, hanging nodes and half-covered sides.
inline Built graded_mesh() {
    mesh::Mesh second = mesh::icosphere(1, 8);
    for (Vec3& vertex : second.vertices) vertex.x += 1.3;
    const std::vector<mesh::Mesh> solids{mesh::icosphere(1, 8), second};
    Options options{.precision = 0.25};
    options.solids = {{.solid = 1, .surface = 0.125}};
    options.boxes = {{{{-1, -1, -1}, {-0.4, 0.1, 0.1}}, 0.0625}};
    Result<Built> built = build(solids, options);
    EXPECT_TRUE(built);
    return std::move(*built);
}

/// A ball with cells of two sizes on its surface, drawn to it over a layer.
inline Built fitted_ball() {
    const mesh::Mesh solid = mesh::icosphere(1, 8);
    Options options{.precision = 0.25, .layers = 1, .keep = Keep::manifold};
    options.boxes = {{{{-2, -2, -2}, {2, 2, 0.1}}, 0.125}};
    Result<Built> built = build(std::span(&solid, 1), options);
    EXPECT_TRUE(built);
    const std::size_t hanging = built->mesh.edge_hanging.size();
    const Result<FitReport> fitted = fit(built->mesh, std::span(&solid, 1));
    EXPECT_TRUE(fitted && fitted->has_buffer_layer);
    EXPECT_GT(built->mesh.edge_hanging.size(), hanging + 10) << "large cells of the layer meet smaller ones";
    return std::move(*built);
}

}  // namespace octavo::hexmesh
