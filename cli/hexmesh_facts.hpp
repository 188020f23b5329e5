// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/hexmesh/quality.hpp>

#include "session.hpp"

// What `hexmesh` tells about a mesh.

namespace octavo::cli {

/// cells, nodes, hanging_nodes, interior, boundary, volume, levels …
Json json_of(const hexmesh::Built& built, std::span<const std::string> names);

/// The same for people.
std::string text_of(const hexmesh::Built& built, std::span<const std::string> names);

/// Adds `quality`: least, mean and a histogram of the scaled Jacobian, the shortest edge and the largest edge ratio.
void add_quality(Session& session, const hexmesh::Quality& quality);

/// Adds `fit`: how near the boundary came to the surface; counts are those of the fitted mesh from here on.
void add_fit(Session& session, const hexmesh::FitReport& report, const mesh::HexMesh& fitted);

/// What the user should know before trusting the mesh.
void warn_about(Session& session, const hexmesh::Built& built, std::span<const std::string> names,
                std::span<const std::string> paths);

}  // namespace octavo::cli
