// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "session.hpp"
#include <octavo/hexmesh/build.hpp>

// What `hexmesh` tells about a mesh.

namespace octavo::cli {

/// cells, nodes, hanging_nodes, interior, boundary, volume, levels …
Json json_of(const hexmesh::Built& built, std::span<const std::string> names);

/// The same for people.
std::string text_of(const hexmesh::Built& built, std::span<const std::string> names);

/// What the user should know before trusting the mesh.
void warn_about(Session& session, const hexmesh::Report& report, std::span<const std::string> names);

}  // namespace octavo::cli
