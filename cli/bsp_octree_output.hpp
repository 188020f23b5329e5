// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/io/write.hpp>

#include "output.hpp"
#include "session.hpp"

// Where a BSP-octree goes: a .bso file, which loses nothing, or a mesh of it, whose vertices are rounded to doubles.

namespace octavo::cli {

/// The formats of meshes, and bso.
const OutputFormats& bsp_octree_outputs();

struct WrittenBspOctree {
    io::WriteReport report;
    std::optional<bsp_octree::ToMesh> made;  ///< the mesh that was written
};

/// Writes the solid as settle_output() said; `path` "-" takes stdout over.
Result<WrittenBspOctree> write_bsp_octree(Session& session, const Context& context, const std::string& path,
                                          const bsp_octree::BspOctree& solid, const std::string& format);

}  // namespace octavo::cli
