// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_files.hpp"

#include <array>

#include <octavo/hexmesh/to_octree.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/gmsh.hpp>
#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/leaf_list.hpp>
#include <octavo/io/mfem.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/openfoam.hpp>
#include <octavo/io/p8est.hpp>

#include "output.hpp"

namespace octavo::cli {
namespace {

struct Named {
    const char* name;
    const char* extension;  ///< or, for what has none of its own, the name again
    HexmeshFormat format;
};

constexpr std::array<Named, 10> formats{{{"abaqus", "inp", HexmeshFormat::abaqus},
                                         {"openfoam", "openfoam", HexmeshFormat::openfoam},
                                         {"mfem", "mesh", HexmeshFormat::mfem},
                                         {"gmsh", "msh", HexmeshFormat::gmsh},
                                         {"leaves", "csv", HexmeshFormat::leaf_list},
                                         {"p8est", "p8est", HexmeshFormat::p8est},
                                         {"p8est-30", "p8est-30", HexmeshFormat::p8est_30},
                                         {"vtu", "vtu", HexmeshFormat::vtu},
                                         {"htg", "htg", HexmeshFormat::hyper_tree_grid},
                                         {"octree", "oct", HexmeshFormat::octree}}};

const OutputFormats& hexmesh_outputs() {
    static const OutputFormats outputs = [] {
        OutputFormats all{"meshes of hexahedra", {}, ""};
        for (const Named& named : formats) all.names.emplace_back(named.extension);
        return all;
    }();
    return outputs;
}

}  // namespace

std::vector<std::string> hexmesh_format_names() {
    std::vector<std::string> names;
    for (const Named& named : formats) names.emplace_back(named.name);
    return names;
}

Result<HexmeshFormat> settle_hexmesh_output(Session& session, const std::vector<std::string>& inputs,
                                            const std::string& output, const std::string& to) {
    std::string wanted;
    for (const Named& named : formats)
        if (to == named.name) wanted = named.extension;
    if (wanted.empty() && output != "-" && io::extension_of(output).empty()) wanted = "openfoam";
    const Result<std::string> settled = settle_output(session, inputs, output, wanted, hexmesh_outputs());
    if (!settled) return settled.error();
    for (const Named& named : formats)
        if (*settled == named.extension) return named.format;
    return HexmeshFormat::vtu;  // nothing is written
}

bool is_for_solvers(HexmeshFormat format) {
    return format == HexmeshFormat::abaqus || format == HexmeshFormat::openfoam ||
           format == HexmeshFormat::mfem || format == HexmeshFormat::gmsh;
}

bool needs_octants(HexmeshFormat format) {
    return format == HexmeshFormat::leaf_list || format == HexmeshFormat::p8est ||
           format == HexmeshFormat::p8est_30 || format == HexmeshFormat::hyper_tree_grid ||
           format == HexmeshFormat::octree;
}

Result<io::WriteReport> write_hexmesh(HexmeshFormat format, const std::string& path,
                                      const mesh::HexMesh& mesh, std::span<const std::string> names,
                                      const Context& context, std::span<const io::CellData> more) {
    if (needs_octants(format) && !(mesh.is_octree() && mesh.positions.empty()))
        return Error{ErrorCode::unsupported,
                     "this format is for octrees, and a conforming or fitted mesh is none",
                     {}};
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
        case HexmeshFormat::p8est:
            return io::write_p8est(path, mesh, {.root_level = 19}, context);
        case HexmeshFormat::p8est_30:
            return io::write_p8est(path, mesh, {.root_level = 30}, context);
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
