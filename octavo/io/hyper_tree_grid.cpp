// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/vtk_appended.hpp>

namespace octavo::io {
namespace {

using Levels = std::vector<std::vector<octree::Node>>;

/// The nodes of each level. Depth first, the nodes of one level come in the order that breadth first has too,
/// and VTK counts octants as we do: x fastest, then y, then z.
Levels levels_of(const octree::Octree& octree) {
    Levels levels;
    for (octree::DfCursor cursor(octree.code()); !cursor.done(); cursor.next()) {
        const auto level = static_cast<std::size_t>(cursor.level());
        if (level == levels.size()) levels.emplace_back();
        levels[level].push_back(cursor.node());
    }
    return levels;
}

/// Packs bits as VTK does, the first in the highest bit of a byte.
class BitArray {
  public:
    explicit BitArray(VtkAppendedData& data) : data_(data), offset_(data.begin_array()) {}

    void add(bool bit) {
        byte_ = static_cast<std::uint8_t>(byte_ | (bit ? 0x80 >> (count_ % 8) : 0));
        if (++count_ % 8 == 0) flush();
    }
    void end() {
        if (count_ % 8 != 0) flush();
        data_.end_array();
    }
    std::uint64_t offset() const { return offset_; }
    std::uint64_t count() const { return count_; }

  private:
    void flush() {
        data_.add(byte_);
        byte_ = 0;
    }

    VtkAppendedData& data_;
    std::uint64_t offset_;
    std::uint64_t count_ = 0;
    std::uint8_t byte_ = 0;
};

void append_array(Output& output, const char* type, const std::string& name, std::uint64_t count,
                  std::uint64_t offset) {
    output.append(std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfTuples=\"");
    output.append_number(count);
    output.append("\" format=\"appended\" offset=\"");
    output.append_number(offset);
    output.append("\"/>\n");
}

void write_grid(Output& output, const octree::Octree& octree, const LeafChoice& choice) {
    const Levels levels = levels_of(octree);
    VtkAppendedData data;
    std::uint64_t coordinates[3];
    const Vec3 low = octree.lattice().to_world({0, 0, 0});
    const Vec3 high =
        octree.lattice().to_world({exact::universe_side, exact::universe_side, exact::universe_side});
    for (int axis = 0; axis < 3; ++axis) {
        coordinates[axis] = data.begin_array();
        data.add(low[axis]), data.add(high[axis]);
        data.end_array();
    }
    // The last level holds leaves only and needs no bits, unless it is the only one.
    BitArray descriptor(data);
    for (std::size_t level = 0; level < levels.size(); ++level)
        if (level + 1 < levels.size() || level == 0)
            for (const octree::Node node : levels[level]) descriptor.add(!octree::is_leaf(node));
    descriptor.end();
    const std::uint64_t counts = data.begin_array();
    for (const auto& nodes : levels) data.add(static_cast<std::int64_t>(nodes.size()));
    data.end_array();
    BitArray mask(data);
    for (const auto& nodes : levels)
        for (const octree::Node node : nodes)
            mask.add(octree::is_leaf(node) && !choice.takes(octree::color_of(node)));
    mask.end();
    const std::uint64_t colors = data.begin_array();
    for (const auto& nodes : levels)
        for (const octree::Node node : nodes)
            data.add(static_cast<std::uint8_t>(octree::is_leaf(node) ? octree::color_of(node)
                                                                     : octree::Color::gray));
    data.end_array();

    output.append("<?xml version=\"1.0\"?>\n<VTKFile type=\"HyperTreeGrid\" ");
    output.append(VtkAppendedData::file_attributes());
    output.append(
        ">\n<HyperTreeGrid BranchFactor=\"2\" TransposedRootIndexing=\"0\" Dimensions=\"2 2 2\">\n<Grid>\n");
    for (int axis = 0; axis < 3; ++axis)
        append_array(output, "Float64", std::string(1, static_cast<char>('X' + axis)) + "Coordinates", 2,
                     coordinates[axis]);
    output.append("</Grid>\n<Trees>\n<Tree Index=\"0\" NumberOfLevels=\"");
    output.append_number(std::uint64_t{levels.size()});
    output.append("\" NumberOfVertices=\"");
    output.append_number(std::uint64_t{octree.code().size()});
    output.append("\">\n");
    append_array(output, "Bit", "Descriptor", descriptor.count(), descriptor.offset());
    append_array(output, "Int64", "NbVerticesByLevel", levels.size(), counts);
    append_array(output, "Bit", "Mask", mask.count(), mask.offset());
    output.append("<CellData>\n");
    append_array(output, "UInt8", "color", octree.code().size(), colors);
    output.append("</CellData>\n</Tree>\n</Trees>\n</HyperTreeGrid>\n");
    data.write(output);
    output.append("</VTKFile>\n");
}

}  // namespace

Result<WriteReport> write_hyper_tree_grid(const std::string& path, const octree::Octree& octree,
                                          const LeafChoice& choice, const Context& context) {
    Result<Output> output = Output::to_file(path);
    if (!output) return output.error();
    write_grid(*output, octree, choice);
    WriteReport report;
    report.format = "htg";
    report.bytes = output->size();
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::io
