// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <octavo/base/context.hpp>
#include <octavo/io/hex_mesh_vtu.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// The files that hexahedral meshes are written to, by extension or by name.

namespace octavo::cli {

enum class HexmeshFormat { abaqus, openfoam, mfem, gmsh, leaf_list, vtu, hyper_tree_grid, octree };

inline constexpr const char* hexmesh_outputs =
    "The mesh to write: .inp (Abaqus, CalculiX), .mesh (MFEM), .msh (Gmsh, when nothing hangs), .csv (leaf "
    "list), .vtu "
    "or .htg (ParaView), .oct, or a folder (OpenFOAM case)";

/// `to` is a name of a format, or empty. Errors: unsupported.
Result<HexmeshFormat> hexmesh_format(const std::string& path, const std::string& to);

/// `names` are those of the solids; `more` goes to formats that have room for it.
Result<io::WriteReport> write_hexmesh(HexmeshFormat format, const std::string& path,
                                      const mesh::HexMesh& mesh, std::span<const std::string> names,
                                      const Context& context, std::span<const io::CellData> more = {});

}  // namespace octavo::cli
