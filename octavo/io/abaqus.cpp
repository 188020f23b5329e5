// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include <octavo/io/abaqus.hpp>
#include <octavo/io/output.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/material_names.hpp>

namespace octavo::io {
namespace {

/// Appends the shortest form that reads back the same, or, when that has more than 20 characters, the best of 20.
void append_short(Output& output, double value) {
    constexpr std::size_t longest = 20;
    std::array<char, longest_number> exact;
    const auto length = static_cast<std::size_t>(write_number(exact.data(), value) - exact.data());
    if (length <= longest) {
        output.append(std::string_view(exact.data(), length));
        return;
    }
    std::array<char, 40> text;
    for (int digits = 16;; --digits) {
        const int size = std::snprintf(text.data(), text.size(), "%.*e", digits, value);
        if (static_cast<std::size_t>(size) > longest) continue;
        output.append(std::string_view(text.data(), static_cast<std::size_t>(size)));
        return;
    }
}

constexpr std::string_view surface_of = "SURFACE_OF_";

/// Abaqus reads 80 characters of a name, and a surface is called as its element set, with a word before that.
mesh::NameRules name_rules() {
    constexpr std::size_t longest_name = 80;
    return {.joint = "_AND_",
            .allows = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; },
            .upper_case = true,
            .before_other_than_letters = "S",
            .longest = longest_name - surface_of.size()};
}

void append_count(Output& output, std::uint64_t value) { output.append_number(value); }

void write_nodes(Output& output, const mesh::HexMesh& mesh) {
    output.append("*NODE, NSET=ALL\n");
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
        const Vec3 p = mesh.position(node);
        append_count(output, node + std::uint64_t{1});
        for (int axis = 0; axis < 3; ++axis) {
            output.append(',');
            append_short(output, p[axis]);
        }
        output.append('\n');
    }
}

void write_elements(Output& output, const mesh::HexMesh& mesh, const mesh::Materials& materials,
                    const std::vector<std::string>& names) {
    constexpr std::array<std::size_t, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
    std::vector<std::vector<mesh::CellIndex>> cells(materials.solids.size());
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        cells[materials.of(mesh, cell)].push_back(cell);
    for (std::uint32_t material = 0; material < materials.solids.size(); ++material) {
        output.append("*ELEMENT, TYPE=C3D8, ELSET=" + names[material] + "\n");
        for (const mesh::CellIndex cell : cells[material]) {
            append_count(output, cell + std::uint64_t{1});
            for (const std::size_t corner : order) {
                output.append(',');
                append_count(output, mesh.corners[cell][corner] + std::uint64_t{1});
            }
            output.append('\n');
        }
    }
}

/// How far from the end of the mesh a node may be and still be there. A fitted node is drawn to the model's plane in
/// floating point, from a surface whose corners may lie off it by rounding.
double end_tolerance(const mesh::HexMesh& mesh) {
    constexpr double part_of_shortest_edge = 1e-3;
    double shortest = std::numeric_limits<double>::max();
    for (const std::array<mesh::NodeIndex, 8>& corners : mesh.corners)
        for (std::size_t corner = 0; corner < 8; ++corner)
            for (const std::size_t along : {std::size_t{1}, std::size_t{2}, std::size_t{4}})
                if (!(corner & along))
                    shortest = std::min(shortest, length(mesh.position(corners[corner | along]) -
                                                         mesh.position(corners[corner])));
    return mesh.corners.empty() ? 0 : part_of_shortest_edge * shortest;
}

/// The nodes at the ends of the mesh along each axis that do not hang: what supports and loads are put on most.
void write_end_sets(Output& output, const mesh::HexMesh& mesh) {
    std::vector<bool> hangs(mesh.node_count(), false);
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging) hangs[hanging.node] = true;
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) hangs[hanging.node] = true;
    Box3 bounds;
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) bounds.add(mesh.position(node));
    const double tolerance = end_tolerance(mesh);
    for (int axis = 0; axis < 3; ++axis)
        for (const bool high : {false, true}) {
            output.append("*NSET, NSET=" + std::string(1, "XYZ"[axis]) + (high ? "MAX\n" : "MIN\n"));
            const double end = high ? bounds.high[axis] : bounds.low[axis];
            for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node)
                if (!hangs[node] && std::fabs(mesh.position(node)[axis] - end) <= tolerance)
                    append_count(output, node + std::uint64_t{1}), output.append(",\n");
        }
}

/// The boundary of each material as an element surface, for pressures and contact.
void write_surfaces(Output& output, const mesh::HexMesh& mesh, const mesh::Materials& materials,
                    const std::vector<std::string>& names) {
    // Abaqus numbers the sides of C3D8: bottom, top, then those at the edges 1-2, 2-3, 3-4 and 4-1 of the bottom.
    constexpr std::array<std::uint64_t, 6> number_of_side{6, 4, 3, 5, 1, 2};
    std::vector<std::vector<mesh::HexSide>> sides(materials.solids.size());
    for (const mesh::HexSide& side : mesh::boundary_sides(mesh).sides)
        sides[materials.of(mesh, side.cell)].push_back(side);
    for (std::uint32_t material = 0; material < materials.solids.size(); ++material) {
        if (sides[material].empty()) continue;
        output.append("*SURFACE, TYPE=ELEMENT, NAME=" + std::string(surface_of) + names[material] + "\n");
        for (const mesh::HexSide& side : sides[material]) {
            append_count(output, side.cell + std::uint64_t{1});
            output.append(",S");
            append_count(output, number_of_side[side.side]);
            output.append('\n');
        }
    }
}

template <std::size_t count>
void write_equation(Output& output, mesh::NodeIndex node, const std::array<mesh::NodeIndex, count>& masters,
                    int degree, std::string_view weight) {
    output.append("*EQUATION\n");
    append_count(output, count + 1);
    output.append('\n');
    append_count(output, node + std::uint64_t{1});
    output.append(',');
    append_count(output, static_cast<std::uint64_t>(degree));
    output.append(",-1.");
    for (std::size_t i = 0; i < count; ++i) {
        // Four terms a line at most.
        output.append(i == 3 ? ",\n" : ",");
        append_count(output, masters[i] + std::uint64_t{1});
        output.append(',');
        append_count(output, static_cast<std::uint64_t>(degree));
        output.append(weight);
    }
    output.append('\n');
}

void write_constraints(Output& output, const mesh::HexMesh& mesh, AbaqusOptions::Field field) {
    if (mesh.hanging_nodes() == 0) return;
    output.append("*NSET, NSET=HANGING\n");
    const auto list = [&](mesh::NodeIndex node) {
        append_count(output, node + std::uint64_t{1});
        output.append(",\n");
    };
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging) list(hanging.node);
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) list(hanging.node);
    constexpr std::array displacement{1, 2, 3}, temperature{11, 0, 0};
    const bool moves = field == AbaqusOptions::Field::displacement;
    for (const int degree : moves ? displacement : temperature) {
        if (degree == 0) continue;
        for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging)
            write_equation(output, hanging.node, hanging.masters, degree, ",0.5");
        for (const mesh::FaceHangingNode& hanging : mesh.face_hanging)
            write_equation(output, hanging.node, hanging.masters, degree, ",0.25");
    }
}

}  // namespace

Result<WriteReport> write_abaqus(const std::string& path, const mesh::HexMesh& mesh,
                                 const AbaqusOptions& options, const Context& context) {
    if (!mesh.constraints_are_direct)
        return Error{ErrorCode::unsupported,
                     "constraints of a mesh balanced by faces alone are chained; balance it by edge",
                     {}};
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    output->append("** Octree mesh with tied hanging nodes\n");
    write_nodes(*output, mesh);
    const mesh::Materials materials = mesh::materials_of(mesh);
    const std::vector<std::string> names =
        mesh::name_materials(materials, options.names, name_rules()).materials;
    write_elements(*output, mesh, materials, names);
    write_end_sets(*output, mesh);
    write_surfaces(*output, mesh, materials, names);
    write_constraints(*output, mesh, options.field);
    output->append(options.tail);
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "abaqus";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
