// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <octavo/io/output.hpp>
#include <octavo/io/p8est.hpp>
#include <octavo/octree/balance.hpp>
#include <octavo/octree/complete.hpp>

namespace octavo::io {
namespace {

using octree::CellKey;

constexpr std::uint64_t format_number = 0x3000009;
constexpr std::uint64_t index_size = 4;      ///< of trees, vertices and coordinates
constexpr std::uint64_t quadrant_size = 24;  ///< in p4est's memory; a check of its build
constexpr std::uint64_t data_size = 4;
constexpr std::uint64_t alignment = 32;

void append_padded(Output& output, std::string_view text, std::size_t size) {
    output.append(text);
    for (std::size_t i = text.size(); i < size; ++i) output.append('\0');
}

void append_all(Output& output, const std::vector<std::uint64_t>& values) {
    for (const std::uint64_t value : values) output.append_binary(value);
}

/// One tree without neighbours: its eight vertices, and each face glued to itself.
void append_cube(Output& output, const exact::Lattice& lattice) {
    append_padded(output, "p8est", 8);
    append_padded(output, "2.2", 24);
    constexpr std::uint64_t vertices = 8, trees = 1;
    // Edges and corners that trees share, and the uses of them; bytes of attributes; a reserved word.
    append_all(output, {format_number, index_size, vertices, trees, 0, 0, 0, 0, 0, 0});
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 vertex =
            lattice.to_world({corner & 1 ? exact::universe_side : 0, corner & 2 ? exact::universe_side : 0,
                              corner & 4 ? exact::universe_side : 0});
        for (int axis = 0; axis < 3; ++axis) output.append_binary(vertex[axis]);
    }
    for (std::int32_t corner = 0; corner < 8; ++corner) output.append_binary(corner);
    for (int face = 0; face < 6; ++face) output.append_binary(std::int32_t{0});
    for (std::int8_t face = 0; face < 6; ++face) output.append_binary(face);
    output.append_binary(std::int32_t{0});  // where the lists of edges and corners, which are empty, end
    output.append_binary(std::int32_t{0});
    while (output.size() % alignment != 0) output.append('\0');
}

void append_leaf(Output& output, CellKey leaf, int root_level, std::int32_t data) {
    const exact::Point low = leaf.low();
    for (int axis = 0; axis < 3; ++axis)
        output.append_binary((low[axis] / leaf.side()) << (root_level - leaf.level()));
    output.append_binary(std::int32_t{leaf.level()});
    output.append_binary(data);
}

}  // namespace

Result<WriteReport> write_p8est(const std::string& path, const mesh::HexMesh& mesh,
                                const P8estOptions& options, const Context& context) {
    OCTAVO_CHECK(mesh.is_octree() && mesh.positions.empty(), "only a mesh of octants is a tree of p4est");
    OCTAVO_CHECK(options.root_level == 19 || options.root_level == 30, "p4est's roots are 2^19 or 2^30 long");
    int deepest = 0;
    for (const CellKey cell : mesh.cells) deepest = std::max(deepest, cell.level());
    if (deepest >= options.root_level)
        return Error{ErrorCode::limit,
                     "the octree has cells of level " + std::to_string(deepest) +
                         ", but this p4est's last level is " + std::to_string(options.root_level - 1),
                     {}};
    // The cells are leaves of a balanced tree, so balancing what fills the gaps leaves them as they are.
    const std::vector<CellKey> leaves =
        octree::balance(octree::complete(mesh.cells),
                        mesh.constraints_are_direct ? octree::Contact::edge : octree::Contact::face);
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    append_cube(*output, mesh.lattice);
    constexpr std::uint64_t has_data = 1, processes = 1;
    append_all(*output, {format_number, index_size, quadrant_size, data_size, has_data, processes});
    append_all(*output, {leaves.size(), leaves.size()});  // up to each process, up to each tree
    std::size_t next = 0;
    for (const CellKey leaf : leaves) {
        const bool is_cell = next < mesh.cells.size() && mesh.cells[next] == leaf;
        append_leaf(*output, leaf, options.root_level,
                    is_cell ? std::int32_t{mesh.set_of_cell[next]} : std::int32_t{-1});
        next += is_cell;
    }
    OCTAVO_CHECK(next == mesh.cells.size(), "balancing the gaps split a cell of the mesh");
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "p8est";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
