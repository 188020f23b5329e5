// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/io/hex_mesh_vtu.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

#include "session.hpp"

// The files that hexahedral meshes are written to, by extension or by name.

namespace octavo::cli {

enum class HexmeshFormat {
    abaqus,
    openfoam,
    mfem,
    gmsh,
    leaf_list,
    p8est,
    p8est_30,
    vtu,
    hyper_tree_grid,
    octree
};

inline constexpr const char* hexmesh_outputs_help =
    "The mesh to write: .inp (Abaqus, CalculiX), .mesh (MFEM), .msh (Gmsh, when nothing hangs), .csv (leaf "
    "list), .p8est (p4est), .vtu or .htg (ParaView), .oct, or a folder (OpenFOAM case)";

/// What `--to` takes.
std::vector<std::string> hexmesh_format_names();

/// The format for `output`: the one named `to`, or else by its extension, or an OpenFOAM case when it has none.
/// Errors: those of settle_output.
Result<HexmeshFormat> settle_hexmesh_output(Session& session, const std::vector<std::string>& inputs,
                                            const std::string& output, const std::string& to);

/// Whether the format is read by solvers, which know whole cells and no fractions.
bool is_for_solvers(HexmeshFormat format);

/// Whether the format knows the cells of an octree only.
bool needs_octants(HexmeshFormat format);

/// `names` are those of the solids; `more` goes to formats that have room for it.
Result<io::WriteReport> write_hexmesh(HexmeshFormat format, const std::string& path,
                                      const mesh::HexMesh& mesh, std::span<const std::string> names,
                                      const Context& context, std::span<const io::CellData> more = {});

}  // namespace octavo::cli
