// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>
#include <vector>

#include <octavo/io/gmsh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/material_names.hpp>

namespace octavo::io {
namespace {

constexpr int surface = 2, volume = 3;         // dimensions of entities
constexpr int quadrangle = 3, hexahedron = 5;  // Gmsh's element types

/// The cells of one material and their sides on the boundary.
struct Group {
    std::string name;
    std::vector<mesh::CellIndex> cells;
    std::vector<mesh::HexSide> sides;
};

std::vector<Group> groups_of(const mesh::HexMesh& mesh, std::span<const std::string> names) {
    const mesh::Materials materials = mesh::materials_of(mesh);
    const mesh::NameRules rules{.allows = [](char c) { return c != '"' && c != '\n'; },
                                .before_other_than_letters = {}};
    mesh::MaterialNames named = mesh::name_materials(materials, names, rules);
    std::vector<Group> groups(materials.solids.size());
    for (std::size_t i = 0; i < groups.size(); ++i) groups[i].name = std::move(named.materials[i]);
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        groups[materials.of(mesh, cell)].cells.push_back(cell);
    for (const mesh::HexSide& side : mesh::boundary_sides(mesh).sides)
        groups[materials.of(mesh, side.cell)].sides.push_back(side);
    return groups;
}

void append_size(Output& output, std::size_t value) { output.append_binary(std::uint64_t{value}); }
void append_int(Output& output, std::size_t value) { output.append_binary(static_cast<std::int32_t>(value)); }

void write_names(Output& output, const std::vector<Group>& groups) {
    output.append("$PhysicalNames\n" + std::to_string(2 * groups.size()) + "\n");
    for (const int dimension : {surface, volume})
        for (std::size_t i = 0; i < groups.size(); ++i)
            output.append(std::to_string(dimension) + " " + std::to_string(i + 1) + " \"" + groups[i].name +
                          "\"\n");
    output.append("$EndPhysicalNames\n");
}

void write_entities(Output& output, const std::vector<Group>& groups, const Box3& bounds) {
    output.append("$Entities\n");
    for (const std::size_t count : {std::size_t{0}, std::size_t{0}, groups.size(), groups.size()})
        append_size(output, count);
    for (const int dimension : {surface, volume})
        for (std::size_t i = 0; i < groups.size(); ++i) {
            append_int(output, i + 1);
            for (const Vec3& corner : {bounds.low, bounds.high})
                for (int axis = 0; axis < 3; ++axis) output.append_binary(corner[axis]);
            append_size(output, 1);
            append_int(output, i + 1);
            append_size(output, dimension == volume ? 1 : 0);  // bounding entities
            if (dimension == volume) append_int(output, i + 1);
        }
    output.append("\n$EndEntities\n");
}

void write_nodes(Output& output, const mesh::HexMesh& mesh) {
    output.append("$Nodes\n");
    const std::size_t count = mesh.node_count();
    for (const std::size_t value : {std::size_t{1}, count, std::size_t{1}, count}) append_size(output, value);
    append_int(output, volume), append_int(output, 1), append_int(output, 0);
    append_size(output, count);
    for (std::size_t node = 0; node < count; ++node) append_size(output, node + 1);
    for (mesh::NodeIndex node = 0; node < count; ++node) {
        const Vec3 p = mesh.position(node);
        for (int axis = 0; axis < 3; ++axis) output.append_binary(p[axis]);
    }
    output.append("\n$EndNodes\n");
}

void write_elements(Output& output, const mesh::HexMesh& mesh, const std::vector<Group>& groups) {
    // Bottom and top, each run round.
    constexpr std::array<std::size_t, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
    std::size_t blocks = 0, sides = 0;
    for (const Group& group : groups) {
        blocks += 1 + !group.sides.empty();
        sides += group.sides.size();
    }
    output.append("$Elements\n");
    const std::size_t count = mesh.cell_count() + sides;
    for (const std::size_t value : {blocks, count, std::size_t{1}, count}) append_size(output, value);
    std::size_t tag = mesh.cell_count();
    for (std::size_t i = 0; i < groups.size(); ++i) {
        append_int(output, volume), append_int(output, i + 1), append_int(output, hexahedron);
        append_size(output, groups[i].cells.size());
        for (const mesh::CellIndex cell : groups[i].cells) {
            append_size(output, cell + std::size_t{1});
            for (const std::size_t corner : order)
                append_size(output, mesh.corners[cell][corner] + std::size_t{1});
        }
        if (groups[i].sides.empty()) continue;
        append_int(output, surface), append_int(output, i + 1), append_int(output, quadrangle);
        append_size(output, groups[i].sides.size());
        for (const mesh::HexSide& side : groups[i].sides) {
            append_size(output, ++tag);
            for (const mesh::NodeIndex node : side.corners) append_size(output, node + std::size_t{1});
        }
    }
    output.append("\n$EndElements\n");
}

}  // namespace

Result<WriteReport> write_gmsh(const std::string& path, const mesh::HexMesh& mesh,
                               std::span<const std::string> names, const Context& context) {
    if (mesh.hanging_nodes() > 0)
        return Error{ErrorCode::unsupported,
                     "Gmsh files cannot tie hanging nodes, of which there are " +
                         std::to_string(mesh.hanging_nodes()) + "; ask for a conforming mesh",
                     {}};
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    Box3 bounds;
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) bounds.add(mesh.position(node));
    const std::vector<Group> groups = groups_of(mesh, names);
    output->append("$MeshFormat\n4.1 1 8\n");
    append_int(*output, 1);  // tells the order of bytes
    output->append("\n$EndMeshFormat\n");
    write_names(*output, groups);
    write_entities(*output, groups, bounds);
    write_nodes(*output, mesh);
    write_elements(*output, mesh, groups);
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "gmsh";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
