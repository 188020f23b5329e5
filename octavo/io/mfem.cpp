// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <octavo/io/mfem.hpp>
#include <octavo/io/output.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/materials.hpp>

namespace octavo::io {
namespace {

constexpr std::uint64_t cube = 5, square = 3;  // MFEM's Geometry::Type

void append_row(Output& output, std::initializer_list<std::uint64_t> head, const auto& nodes) {
    bool first = true;
    const auto append = [&](std::uint64_t value) {
        if (!first) output.append(' ');
        first = false;
        output.append_number(value);
    };
    for (const std::uint64_t value : head) append(value);
    for (const mesh::NodeIndex node : nodes) append(node);
    output.append('\n');
}

void append_header(Output& output, const char* name, std::size_t count) {
    output.append(std::string("\n") + name + "\n" + std::to_string(count) + "\n");
}

/// Nodes in the middle of edges, by their ends.
class EdgeMiddles {
  public:
    explicit EdgeMiddles(const mesh::HexMesh& mesh) {
        for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging)
            entries_.push_back({ends_of(hanging.masters[0], hanging.masters[1]), hanging.node});
        std::sort(entries_.begin(), entries_.end());
    }
    mesh::NodeIndex operator()(mesh::NodeIndex a, mesh::NodeIndex b) const {
        const auto at =
            std::lower_bound(entries_.begin(), entries_.end(), std::pair(ends_of(a, b), mesh::NodeIndex{0}));
        OCTAVO_CHECK(at != entries_.end() && at->first == ends_of(a, b),
                     "a side split as a whole has split edges");
        return at->second;
    }

  private:
    using Ends = std::pair<mesh::NodeIndex, mesh::NodeIndex>;
    static Ends ends_of(mesh::NodeIndex a, mesh::NodeIndex b) { return {std::min(a, b), std::max(a, b)}; }
    std::vector<std::pair<Ends, mesh::NodeIndex>> entries_;
};

void write_parents(Output& output, const mesh::HexMesh& mesh) {
    append_header(output, "vertex_parents", mesh.hanging_nodes());
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging)
        append_row(output, {hanging.node}, hanging.masters);
    const EdgeMiddles middle(mesh);
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) {
        const auto& m = hanging.masters;
        append_row(output, {hanging.node}, std::array{middle(m[0], m[1]), middle(m[2], m[3])});
    }
}

void write_elements(Output& output, const mesh::HexMesh& mesh, const std::vector<mesh::HexSide>& boundary) {
    constexpr std::array<std::size_t, 8> order{0, 1, 3, 2, 4, 5, 7, 6};
    const mesh::Materials materials = mesh::materials_of(mesh);
    const auto attribute = [&](mesh::CellIndex cell) { return materials.of(mesh, cell) + std::uint64_t{1}; };
    append_header(output, "elements", mesh.cell_count());
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell) {
        std::array<mesh::NodeIndex, 8> nodes;
        for (std::size_t i = 0; i < 8; ++i) nodes[i] = mesh.corners[cell][order[i]];
        append_row(output, {attribute(cell), cube}, nodes);
    }
    append_header(output, "boundary", boundary.size());
    for (const mesh::HexSide& side : boundary)
        append_row(output, {attribute(side.cell), square}, side.corners);
}

void write_vertices(Output& output, const mesh::HexMesh& mesh) {
    append_header(output, "vertices", mesh.node_count());
    output.append("3\n");
    for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
        const Vec3 p = mesh.position(node);
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0) output.append(' ');
            output.append_number(p[axis]);
        }
        output.append('\n');
    }
}

}  // namespace

Result<WriteReport> write_mfem(const std::string& path, const mesh::HexMesh& mesh, const Context& context) {
    if (!mesh.constraints_are_direct)
        return Error{ErrorCode::unsupported,
                     "MFEM files need a mesh balanced by edge or corner, not by face alone",
                     {}};
    const mesh::BoundarySides boundary = mesh::boundary_sides(mesh);
    if (boundary.partly_covered > 0)
        return Error{ErrorCode::unsupported,
                     "smaller cells cover only a part of " + std::to_string(boundary.partly_covered) +
                         " cell sides on the boundary, which MFEM cannot express; give all surfaces one size "
                         "or keep the "
                         "cells outside",
                     {}};
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    const bool hangs = mesh.hanging_nodes() > 0;
    output->append(hangs ? "MFEM mesh v1.1\n" : "MFEM mesh v1.0\n");
    output->append("\ndimension\n3\n");
    write_elements(*output, mesh, boundary.sides);
    if (hangs) write_parents(*output, mesh);
    write_vertices(*output, mesh);
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "mfem";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
