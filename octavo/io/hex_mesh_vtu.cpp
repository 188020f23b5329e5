// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <vector>

#include <octavo/io/hex_mesh_vtu.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/vtk_arrays.hpp>
#include <octavo/mesh/filled_parts.hpp>

namespace octavo::io {
namespace {

constexpr std::uint8_t vtk_hexahedron = 12;

std::int32_t first_solid(const mesh::SolidSet& set) {
    std::int32_t first = -1;
    for (const auto* solids : {&set.inside, &set.boundary})
        if (!solids->empty() && (first < 0 || static_cast<std::int32_t>(solids->front()) < first))
            first = static_cast<std::int32_t>(solids->front());
    return first;
}

std::string cell_data(VtkArrays& arrays, const mesh::HexMesh& mesh, std::span<const CellData> more) {
    std::string xml;
    const auto per_cell = [&](const auto& value_of) {
        return [&mesh, &value_of](const auto& put) {
            for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell) put(value_of(cell));
        };
    };
    arrays.add<std::uint16_t>(xml, "UInt16", "set", "",
                              per_cell([&](mesh::CellIndex cell) { return mesh.set_of_cell[cell]; }));
    arrays.add<std::int32_t>(xml, "Int32", "solid", "",
                             per_cell([&](mesh::CellIndex cell) { return first_solid(mesh.set_of(cell)); }));
    if (!mesh.fractions.empty()) {
        const std::vector<double> parts = mesh::filled_parts(mesh.sets, mesh.set_of_cell, mesh.fractions);
        arrays.add<float>(xml, "Float32", "fraction", "",
                          per_cell([&](mesh::CellIndex cell) { return static_cast<float>(parts[cell]); }));
    }
    if (mesh.is_octree())
        arrays.add<std::uint8_t>(xml, "UInt8", "level", "", per_cell([&](mesh::CellIndex cell) {
                                     return static_cast<std::uint8_t>(mesh.cells[cell].level());
                                 }));
    for (const CellData& data : more)
        arrays.add<double>(xml, "Float64", data.name, "",
                           per_cell([&](mesh::CellIndex cell) { return data.values[cell]; }));
    return xml;
}

std::string point_data(VtkArrays& arrays, const mesh::HexMesh& mesh) {
    std::vector<std::uint8_t> masters(mesh.node_count(), 0);
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging) masters[hanging.node] = 2;
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) masters[hanging.node] = 4;
    std::string xml;
    arrays.add<std::uint8_t>(xml, "UInt8", "masters", "", [&](const auto& put) {
        for (const std::uint8_t count : masters) put(count);
    });
    return xml;
}

std::string points(VtkArrays& arrays, const mesh::HexMesh& mesh) {
    std::string xml;
    arrays.add<double>(xml, "Float64", "Points", " NumberOfComponents=\"3\"", [&](const auto& put) {
        for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node) {
            const Vec3 p = mesh.position(node);
            put(p.x), put(p.y), put(p.z);
        }
    });
    return xml;
}

std::string cells(VtkArrays& arrays, const mesh::HexMesh& mesh) {
    // VTK goes round the bottom, then round the top.
    constexpr std::array<std::size_t, 8> around{0, 1, 3, 2, 4, 5, 7, 6};
    std::string xml;
    arrays.add<std::int64_t>(xml, "Int64", "connectivity", "", [&](const auto& put) {
        for (const auto& corners : mesh.corners)
            for (const std::size_t corner : around) put(std::int64_t{corners[corner]});
    });
    arrays.add<std::int64_t>(xml, "Int64", "offsets", "", [&](const auto& put) {
        for (std::size_t i = 1; i <= mesh.cell_count(); ++i) put(static_cast<std::int64_t>(8 * i));
    });
    arrays.add<std::uint8_t>(xml, "UInt8", "types", "", [&](const auto& put) {
        for (std::size_t i = 0; i < mesh.cell_count(); ++i) put(vtk_hexahedron);
    });
    return xml;
}

}  // namespace

Result<WriteReport> write_vtu(const std::string& path, const mesh::HexMesh& mesh,
                              std::span<const CellData> more, const Context& context) {
    for (const CellData& data : more)
        OCTAVO_CHECK(data.values.size() == mesh.cell_count(), "cell data has a value for each cell");
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    VtkArrays arrays;
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" ";
    xml += VtkAppendedData::file_attributes();
    xml += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" + std::to_string(mesh.node_count()) +
           "\" NumberOfCells=\"" + std::to_string(mesh.cell_count()) + "\">\n";
    xml += "<PointData>\n" + point_data(arrays, mesh) + "</PointData>\n";
    xml += "<CellData Scalars=\"solid\">\n" + cell_data(arrays, mesh, more) + "</CellData>\n";
    xml += "<Points>\n" + points(arrays, mesh) + "</Points>\n";
    xml += "<Cells>\n" + cells(arrays, mesh) + "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
    output->append(xml);
    arrays.data().write(*output);
    output->append("</VTKFile>\n");
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "vtu";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
