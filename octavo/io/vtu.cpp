// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <utility>
#include <vector>

#include <octavo/io/output.hpp>
#include <octavo/io/vertex_welder.hpp>
#include <octavo/io/vtk_arrays.hpp>
#include <octavo/io/vtu.hpp>
#include <octavo/octree/cell.hpp>

namespace octavo::io {
namespace {

constexpr std::uint8_t vtk_hexahedron = 12;

struct Grid {
    std::vector<Vec3> corners;  ///< in lattice units
    std::vector<std::array<mesh::VertexIndex, 8>> cells;
    std::vector<std::uint8_t> colors, levels;
};

Grid grid_of(const octree::Octree& octree, const LeafChoice& choice) {
    // The octants in the order in which VTK goes round a hexahedron.
    constexpr std::array<int, 8> around{0, 1, 3, 2, 4, 5, 7, 6};
    Grid grid;
    // Lattice coordinates have 26 bits and are exact as doubles, so welding them is exact.
    VertexWelder<double> welder(1024);
    octree.for_each_leaf([&](octree::CellKey key, octree::Color color) {
        if (!choice.takes(color)) return;
        const octree::Cell cell = octree::Cell::of(key);
        std::array<mesh::VertexIndex, 8>& corners = grid.cells.emplace_back();
        for (std::size_t i = 0; i < 8; ++i) {
            const auto coordinate = [&](std::int32_t low, int bit) {
                return static_cast<double>(low + (around[i] & bit ? cell.side() : 0));
            };
            corners[i] = welder.add(welder.prepare(coordinate(cell.low.x, 1), coordinate(cell.low.y, 2),
                                                   coordinate(cell.low.z, 4)));
        }
        grid.colors.push_back(static_cast<std::uint8_t>(color));
        grid.levels.push_back(static_cast<std::uint8_t>(key.level()));
    });
    grid.corners = welder.vertices();
    return grid;
}

std::string points_of(VtkArrays& arrays, const Grid& grid, const exact::Lattice& lattice) {
    std::string xml;
    arrays.add<double>(xml, "Float64", "Points", " NumberOfComponents=\"3\"", [&](const auto& put) {
        for (const Vec3& corner : grid.corners) {
            const Vec3 world =
                lattice.to_world({static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y),
                                  static_cast<std::int32_t>(corner.z)});
            for (int axis = 0; axis < 3; ++axis) put(world[axis]);
        }
    });
    return xml;
}

std::string cells_of(VtkArrays& arrays, const Grid& grid) {
    std::string xml;
    arrays.add<std::int64_t>(xml, "Int64", "connectivity", "", [&](const auto& put) {
        for (const auto& cell : grid.cells)
            for (const mesh::VertexIndex corner : cell) put(std::int64_t{corner});
    });
    arrays.add<std::int64_t>(xml, "Int64", "offsets", "", [&](const auto& put) {
        for (std::size_t i = 1; i <= grid.cells.size(); ++i) put(static_cast<std::int64_t>(8 * i));
    });
    arrays.add<std::uint8_t>(xml, "UInt8", "types", "", [&](const auto& put) {
        for (std::size_t i = 0; i < grid.cells.size(); ++i) put(vtk_hexahedron);
    });
    return xml;
}

std::string cell_data_of(VtkArrays& arrays, const Grid& grid) {
    std::string xml;
    for (const auto& [name, values] : {std::pair("color", &grid.colors), std::pair("level", &grid.levels)})
        arrays.add<std::uint8_t>(xml, "UInt8", name, "", [values = values](const auto& put) {
            for (const std::uint8_t value : *values) put(value);
        });
    return xml;
}

void write_grid(Output& output, const Grid& grid, const exact::Lattice& lattice) {
    VtkArrays arrays;
    const std::string points = points_of(arrays, grid, lattice), cells = cells_of(arrays, grid),
                      cell_data = cell_data_of(arrays, grid);
    output.append("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" ");
    output.append(VtkAppendedData::file_attributes());
    output.append(">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"");
    output.append_number(std::uint64_t{grid.corners.size()});
    output.append("\" NumberOfCells=\"");
    output.append_number(std::uint64_t{grid.cells.size()});
    output.append("\">\n<CellData Scalars=\"color\">\n" + cell_data + "</CellData>\n<Points>\n" + points +
                  "</Points>\n<Cells>\n" + cells + "</Cells>\n</Piece>\n</UnstructuredGrid>\n");
    arrays.data().write(output);
    output.append("</VTKFile>\n");
}

}  // namespace

Result<WriteReport> write_vtu(const std::string& path, const octree::Octree& octree, const LeafChoice& choice,
                              const Context& context) {
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    const Grid grid = grid_of(octree, choice);
    if (context.cancelled()) return Context::cancelled_error();
    write_grid(*output, grid, octree.lattice());
    WriteReport report;
    report.format = "vtu";
    report.bytes = output->size();
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
