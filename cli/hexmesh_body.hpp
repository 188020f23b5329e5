// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/mesh/mesh.hpp>

#include "session.hpp"

// What a solver will take the mesh for: the volume of its cells and the pieces they fall into, beside the solids' own.

namespace octavo::cli {

struct BodyOptions {
    bool for_solver = false;  ///< the output is a format of solvers, which know whole cells only
    bool is_fitted = false;
};

/// Adds `mesh_volume` and `pieces`, and warns where the mesh is another body than the solids: in more pieces, or for a
/// solver with a volume that is off by more than a twentieth. `quality` is that of a mesh whose cells are no cubes.
void add_body(Session& session, const hexmesh::Built& built, std::span<const mesh::Mesh> solids,
              const std::optional<hexmesh::Quality>& quality, const BodyOptions& options);

}  // namespace octavo::cli
