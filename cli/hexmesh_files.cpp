// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <octavo/hexmesh/to_octree.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/io/gmsh.hpp>
#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/leaf_list.hpp>
#include <octavo/io/mfem.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/openfoam.hpp>

namespace octavo::cli {
namespace {

struct Named {
    const char* name;
    const char* extension;  ///< "" for a folder
    HexmeshFormat format;
};

constexpr std::array<Named, 8> formats{{{"abaqus", ".inp", HexmeshFormat::abaqus},
                                        {"openfoam", "", HexmeshFormat::openfoam},
                                        {"mfem", ".mesh", HexmeshFormat::mfem},
                                        {"gmsh", ".msh", HexmeshFormat::gmsh},
                                        {"leaves", ".csv", HexmeshFormat::leaf_list},
                                        {"vtu", ".vtu", HexmeshFormat::vtu},
                                        {"htg", ".htg", HexmeshFormat::hyper_tree_grid},
                                        {"octree", ".oct", HexmeshFormat::octree}}};

bool needs_octants(HexmeshFormat format) {
    return format == HexmeshFormat::openfoam || format == HexmeshFormat::leaf_list ||
           format == HexmeshFormat::hyper_tree_grid || format == HexmeshFormat::octree;
}

}  // namespace

Result<HexmeshFormat> hexmesh_format(const std::string& path, const std::string& to) {
    std::string extension = std::filesystem::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::string known;
    for (const Named& named : formats) {
        known += (known.empty() ? "" : ", ") + std::string(named.name);
        if (to.empty() ? extension == named.extension && path != "-" : to == named.name) return named.format;
    }
    if (path.empty()) return HexmeshFormat::vtu;  // nothing is written
    return Error{ErrorCode::unsupported,
                 to.empty() ? "no format of hexahedral meshes follows from the name " + path +
                                  "; --to says one of " + known
                            : "there is no format " + to + " of hexahedral meshes; there are " + known,
                 {}};
}

Result<io::WriteReport> write_hexmesh(HexmeshFormat format, const std::string& path,
                                      const mesh::HexMesh& mesh, std::span<const std::string> names,
                                      const Context& context, std::span<const io::CellData> more) {
    if (needs_octants(format) && !mesh.is_octree())
        return Error{ErrorCode::unsupported, "this format is for octrees, and a conforming mesh is none", {}};
    switch (format) {
        case HexmeshFormat::abaqus:
            return io::write_abaqus(path, mesh, {.names = names}, context);
        case HexmeshFormat::openfoam:
            return io::write_openfoam(path, hexmesh::to_polyhedra(mesh, names), context);
        case HexmeshFormat::mfem:
            return io::write_mfem(path, mesh, context);
        case HexmeshFormat::gmsh:
            return io::write_gmsh(path, mesh, names, context);
        case HexmeshFormat::leaf_list:
            return io::write_leaf_list(path, mesh, context);
        case HexmeshFormat::vtu:
            return io::write_vtu(path, mesh, more, context);
        case HexmeshFormat::hyper_tree_grid:
            return io::write_hyper_tree_grid(path, hexmesh::to_octree(mesh), {}, context);
        case HexmeshFormat::octree:
            return io::write_octree(path, hexmesh::to_octree(mesh), context);
    }
    return Error{ErrorCode::internal, "a format without a writer", {}};
}

}  // namespace octavo::cli
