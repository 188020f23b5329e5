// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/bp_octree/bpo_file.hpp>
#include <octavo/io/openscad_csg.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/octree/octree.hpp>

#include "number_text.hpp"
#include "option_checks.hpp"
#include "output.hpp"
#include "session.hpp"

// What nearly every verb does first and last: read the model that the command line names and write what came of it.
// Both are timed, and their warnings are passed on. Inputs are remembered for `--json`.

namespace octavo::cli {

/// What a file is, as far as verbs care.
enum class ModelKind { mesh, csg, octree, bp_octree, bsp_octree };

/// By the format where one is given, else by the path's extension; octrees of each kind on standard input ("-") by
/// their first bytes, for which this waits.
ModelKind kind_of(const std::string& path, const std::string& format);

/// Adds --from, the format of the model `what` instead of the one that its extension names; `formats` are those that it
/// may be, any that verbs read when there are none. It is also taken by its old name, --format.
void add_from_option(Verb* verb, std::string& format, const std::string& what,
                     const std::vector<std::string>& formats = {});

/// Reads a mesh. A CSG tree or an octree of either kind is refused, with the verb that makes a mesh of it.
Result<io::ReadMesh> read_mesh(Session& session, const Context& context, const std::string& path,
                               const std::string& format = "");

struct SurfaceOptions {
    bool keep_sources = false;  ///< of a CSG tree: the leaf that each facet came from
};

/// Reads the surface of whatever bounds a solid: a mesh as it is; a CSG tree evaluated exactly, with round things as
/// the polyhedra that OpenSCAD makes of them; an octree as the boundary of its black cells; a BP-octree as its exact
/// triangles; a BSP-octree as its faces.
Result<io::ReadMesh> read_surface(Session& session, const Context& context, const std::string& path,
                                  const std::string& format = "", const SurfaceOptions& options = {});

/// The same for operands of exact operations: an octree whose cells only come near a solid is refused, with the verb
/// that makes a mesh of it.
Result<io::ReadMesh> read_operand(Session& session, const Context& context, const std::string& path,
                                  const std::string& format = "");

Result<io::CsgFile> read_csg(Session& session, const Context& context, const std::string& path,
                             const io::CsgReadOptions& options);

/// Reads an octree; a mesh or a CSG tree is refused, with the verb that makes an octree of it.
Result<octree::Octree> read_octree(Session& session, const Context& context, const std::string& path,
                                   const std::string& format = "");

/// Reads a BP-octree; warns when only its beginning is there.
Result<bp_octree::ReadBpo> read_bp_octree(Session& session, const Context& context, const std::string& path,
                                          const bp_octree::ReadBpoOptions& options = {});

/// Warns of what a mesh that was read loses when it is written in `format`: kinds of data, polygons, the unit.
void warn_of_losses(Session& session, const io::ReadMesh& read, const std::string& format);

/// Writes a mesh; `path` "-" takes stdout over.
Result<io::WriteReport> write_mesh(Session& session, const Context& context, const std::string& path,
                                   const mesh::Mesh& mesh, const io::WriteOptions& options = {});

/// Writes an octree as "oct", "vtu" or "htg"; `path` "-" takes stdout over.
Result<io::WriteReport> write_octree(Session& session, const Context& context, const std::string& path,
                                     const octree::Octree& tree, const std::string& format);

/// Snaps a mesh to its own lattice. Warns when a closed surface is inside out, or when none has area.
Result<mesh::Snapped> snap(Session& session, const mesh::Mesh& mesh);

/// For `--open winding`: warns of the facets that are added where the surface is open, and when what they close is
/// inside out.
void warn_of_closing(Session& session, const mesh::LatticeMesh& mesh);

/// A surface whose vertices are points of a lattice. Answers are exact for it.
struct OnLattice {
    mesh::LatticeMesh mesh;
    double largest_displacement =
        0;  ///< how far rounding to the lattice moved a vertex, in units of the model
};

/// Reads a surface and snaps it, or takes the triangles of a BP-octree, which are on a lattice already.
Result<OnLattice> read_on_lattice(Session& session, const Context& context, const std::string& path,
                                  const std::string& format = "");

/// The line of a text result that tells of it; empty when nothing moved. It is no warning: every model in floats moves
/// by some 1e-8 of its size.
std::string rounding_text(double largest_displacement);

/// The same error, with the file that it is about.
Error in_file(Error error, const std::string& path);

/// The same where the library knows its inputs by number: that becomes the file, and the input's name where it has one
/// beside that of its file.
Error in_its_file(Error error, const std::vector<std::string>& paths,
                  const std::vector<std::string>& names = {});

/// Three numbers for `--json`.
inline Json json_of(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace octavo::cli
