// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// Gmsh's format 4.1 (binary), for meshes in which nothing hangs: it has no words for constraints.
//
// A volume entity and a physical group of dimension 3 for each set of solids that has cells ("a" or "a+b", "outside"),
// and of dimension 2 for its part of the boundary (the same name). Tags of entities and groups are the number of the
// set plus one, tags of nodes and elements those of the mesh plus one; boundary quadrangles follow the hexahedra.

namespace octavo::io {

/// Writes to the file `path`, or to standard output when it is "-". `names` are those of the solids.
/// Errors: unsupported when a node hangs; io; cancelled.
Result<WriteReport> write_gmsh(const std::string& path, const mesh::HexMesh& mesh,
                               std::span<const std::string> names = {}, const Context& context = {});

}  // namespace octavo::io
