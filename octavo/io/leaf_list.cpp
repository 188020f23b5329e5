// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/io/leaf_list.hpp>
#include <octavo/io/output.hpp>

namespace octavo::io {

Result<WriteReport> write_leaf_list(const std::string& path, const mesh::HexMesh& mesh,
                                    const Context& context) {
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    const Vec3 origin = mesh.lattice.to_world({0, 0, 0});
    output->append("# octavo leaf list 1\n# origin");
    for (int axis = 0; axis < 3; ++axis) {
        output->append(' ');
        output->append_number(origin[axis]);
    }
    output->append("\n# side ");
    output->append_number(std::ldexp(mesh.lattice.unit(), exact::coordinate_bits));
    for (std::size_t set = 0; set < mesh.sets.size(); ++set) {
        output->append("\n# set " + std::to_string(set) + " inside");
        for (const mesh::SolidIndex solid : mesh.sets[set].inside)
            output->append(" " + std::to_string(solid));
        output->append(" boundary");
        for (const mesh::SolidIndex solid : mesh.sets[set].boundary)
            output->append(" " + std::to_string(solid));
    }
    output->append("\nx,y,z,level,set\n");
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell) {
        const octree::CellKey key = mesh.cells[cell];
        const exact::Point low = key.low();
        for (int axis = 0; axis < 3; ++axis) {
            output->append_number(static_cast<std::uint64_t>(low[axis] / key.side()));
            output->append(',');
        }
        output->append_number(static_cast<std::uint64_t>(key.level()));
        output->append(',');
        output->append_number(std::uint64_t{mesh.set_of_cell[cell]});
        output->append('\n');
    }
    if (context.cancelled()) return Context::cancelled_error();
    WriteReport report;
    report.format = "leaf list";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
