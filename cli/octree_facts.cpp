// SPDX-License-Identifier: Apache-2.0
#include "octree_facts.hpp"

#include <cmath>

#include <fmt/format.h>

#include "number_text.hpp"

namespace octavo::cli {
namespace {

double cell_size(const octree::Octree& tree) {
    return std::ldexp(1.0, tree.lattice().exponent() + exact::coordinate_bits - tree.depth());
}

}  // namespace

Json json_of(const octree::Octree& tree, const TreeFile& file) {
    const octree::OctreeStats stats = tree.stats();
    Json levels = Json::array();
    for (int level = 0; level <= stats.deepest; ++level) {
        const octree::OctreeStats::Level& one = stats.levels[level];
        levels.push_back({{"level", level},
                          {"white", one.white},
                          {"black", one.black},
                          {"gray", one.gray},
                          {"split", one.split}});
    }
    return {{"format", file.format},
            {"depth", tree.depth()},
            {"leaves", stats.leaves()},
            {"white", stats.white},
            {"black", stats.black},
            {"gray", stats.gray},
            {"nodes", stats.nodes()},
            {"volume_lower", octree::world_volume(tree.lattice(), stats.black_volume)},
            {"volume_upper", octree::world_volume(tree.lattice(), stats.black_volume + stats.gray_volume)},
            {"cell_size", cell_size(tree)},
            {"bytes", file.bytes},
            {"levels", levels}};
}

std::string text_of(const octree::Octree& tree, const TreeFile& file) {
    const octree::OctreeStats stats = tree.stats();
    std::string text =
        fmt::format("{:>5} {:>13} {:>13} {:>13} {:>13}\n", "level", "white", "black", "gray", "split");
    for (int level = 0; level <= stats.deepest; ++level) {
        const octree::OctreeStats::Level& one = stats.levels[level];
        text += fmt::format("{:>5} {:>13} {:>13} {:>13} {:>13}\n", level, grouped(one.white),
                            grouped(one.black), grouped(one.gray), grouped(one.split));
    }
    const double lower = octree::world_volume(tree.lattice(), stats.black_volume);
    const double upper = octree::world_volume(tree.lattice(), stats.black_volume + stats.gray_volume);
    text += fmt::format("leaves     {} ({} white, {} black, {} gray), smallest cell {}\n",
                        grouped(stats.leaves()), grouped(stats.white), grouped(stats.black),
                        grouped(stats.gray), number_text(cell_size(tree)));
    text += fmt::format("volume     between {} and {}\n", number_text(lower, upper), number_text(upper));
    text += fmt::format("size       {} bytes of {}", grouped(file.bytes), file.format);
    if (file.format == "oct")
        text += fmt::format(", {:.2f} bits a node",
                            8.0 * static_cast<double>(file.bytes) / static_cast<double>(stats.nodes()));
    return text + "\n";
}

}  // namespace octavo::cli
