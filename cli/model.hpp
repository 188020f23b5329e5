// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "session.hpp"
#include <octavo/bp_octree/bpo_file.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/snap.hpp>

// What nearly every verb does first and last: read the model that the command line names and write what came of it.
// Both are timed, and their warnings are passed on.

namespace octavo::cli {

/// What a file's extension says it is, as far as verbs care.
enum class ModelKind { mesh, csg, octree, bp_octree };

ModelKind kind_of(const std::string& path, const std::string& format);

/// Reads a mesh; remembers `path` among the inputs.
Result<io::ReadMesh> read_mesh(Session& session, const Context& context, const std::string& path,
                               const std::string& format = "");

/// Reads a mesh and snaps it, or takes the triangles of a BP-octree (.bpo), which are on a lattice already. Warns when
/// snapping moved vertices, since answers are exact for the snapped solid.
Result<mesh::LatticeMesh> read_on_lattice(Session& session, const Context& context, const std::string& path,
                                          const std::string& format = "");

/// Reads a BP-octree; remembers `path` among the inputs, and warns when only its beginning is there.
Result<bp_octree::ReadBpo> read_bp_octree(Session& session, const Context& context, const std::string& path,
                                          const bp_octree::ReadBpoOptions& options = {});

/// Writes a mesh; `path` "-" takes stdout over.
Result<io::WriteReport> write_mesh(Session& session, const Context& context, const std::string& path,
                                   const mesh::Mesh& mesh, const io::WriteOptions& options = {});

/// Snaps a mesh to its own lattice. Warns when the surface is inside out.
Result<mesh::Snapped> snap(Session& session, const mesh::Mesh& mesh);

/// The same error, with the file that it is about.
Error in_file(Error error, const std::string& path);

/// True when both names lead to the same existing file; then writing would destroy the input.
bool same_file(const std::string& a, const std::string& b);

/// The error for `same_file`.
Error would_overwrite(const std::string& path);

/// Three numbers for `--json`.
inline Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

/// 1234567 as "1 234 567", for people.
std::string grouped(std::uint64_t number);

}  // namespace octavo::cli
