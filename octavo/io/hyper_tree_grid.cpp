// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/vtk_arrays.hpp>

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
template <class Put>
class BitPacker {
  public:
    explicit BitPacker(const Put& put) : put_(put) {}
    ~BitPacker() {
        if (count_ % 8 != 0) put_(byte_);
    }
    BitPacker(const BitPacker&) = delete;
    BitPacker& operator=(const BitPacker&) = delete;

    void add(bool bit) {
        byte_ = static_cast<std::uint8_t>(byte_ | (bit ? 0x80 >> (count_ % 8) : 0));
        if (++count_ % 8 != 0) return;
        put_(byte_);
        byte_ = 0;
    }

  private:
    const Put& put_;
    std::uint64_t count_ = 0;
    std::uint8_t byte_ = 0;
};

std::string tuples(std::uint64_t count) { return " NumberOfTuples=\"" + std::to_string(count) + "\""; }

std::string coordinates_of(VtkArrays& arrays, const exact::Lattice& lattice) {
    const Vec3 low = lattice.to_world({0, 0, 0});
    const Vec3 high = lattice.to_world({exact::universe_side, exact::universe_side, exact::universe_side});
    std::string xml;
    for (int axis = 0; axis < 3; ++axis)
        arrays.add<double>(xml, "Float64", std::string(1, static_cast<char>('X' + axis)) + "Coordinates",
                           tuples(2), [&](const auto& put) { put(low[axis]), put(high[axis]); });
    return xml;
}

std::string tree_of(VtkArrays& arrays, const Levels& levels) {
    // The last level holds leaves only and needs no bits, unless it is the only one.
    const std::size_t described = std::max<std::size_t>(levels.size() - 1, 1);
    std::uint64_t bits = 0;
    for (std::size_t level = 0; level < described; ++level) bits += levels[level].size();
    std::string xml;
    arrays.add<std::uint8_t>(xml, "Bit", "Descriptor", tuples(bits), [&](const auto& put) {
        BitPacker packer(put);
        for (std::size_t level = 0; level < described; ++level)
            for (const octree::Node node : levels[level]) packer.add(!octree::is_leaf(node));
    });
    arrays.add<std::int64_t>(xml, "Int64", "NbVerticesByLevel", tuples(levels.size()), [&](const auto& put) {
        for (const auto& level : levels) put(static_cast<std::int64_t>(level.size()));
    });
    return xml;
}

std::string mask_of(VtkArrays& arrays, const Levels& levels, std::uint64_t nodes, const LeafChoice& choice) {
    std::string xml;
    arrays.add<std::uint8_t>(xml, "Bit", "Mask", tuples(nodes), [&](const auto& put) {
        BitPacker packer(put);
        for (const auto& level : levels)
            for (const octree::Node node : level)
                packer.add(octree::is_leaf(node) && !choice.takes(octree::color_of(node)));
    });
    return xml;
}

std::string colors_of(VtkArrays& arrays, const Levels& levels, std::uint64_t nodes) {
    std::string xml;
    arrays.add<std::uint8_t>(xml, "UInt8", "color", tuples(nodes), [&](const auto& put) {
        for (const auto& level : levels)
            for (const octree::Node node : level)
                put(static_cast<std::uint8_t>(octree::is_leaf(node) ? octree::color_of(node)
                                                                    : octree::Color::gray));
    });
    return xml;
}

void write_grid(Output& output, const octree::Octree& octree, const LeafChoice& choice) {
    const Levels levels = levels_of(octree);
    const std::uint64_t nodes = octree.code().size();
    VtkArrays arrays;
    output.append("<?xml version=\"1.0\"?>\n<VTKFile type=\"HyperTreeGrid\" ");
    output.append(VtkAppendedData::file_attributes());
    output.append(
        ">\n<HyperTreeGrid BranchFactor=\"2\" TransposedRootIndexing=\"0\" Dimensions=\"2 2 2\">\n<Grid>\n");
    output.append(coordinates_of(arrays, octree.lattice()));
    output.append("</Grid>\n<Trees>\n<Tree Index=\"0\" NumberOfLevels=\"");
    output.append_number(std::uint64_t{levels.size()});
    output.append("\" NumberOfVertices=\"");
    output.append_number(nodes);
    output.append("\">\n");
    output.append(tree_of(arrays, levels));
    output.append(mask_of(arrays, levels, nodes, choice));
    output.append("<CellData>\n" + colors_of(arrays, levels, nodes) +
                  "</CellData>\n</Tree>\n</Trees>\n</HyperTreeGrid>\n");
    arrays.data().write(output);
    output.append("</VTKFile>\n");
}

}  // namespace

Result<WriteReport> write_hyper_tree_grid(const std::string& path, const octree::Octree& octree,
                                          const LeafChoice& choice, const Context& context) {
    Result<Output> output = Output::to_file(path, context);
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
