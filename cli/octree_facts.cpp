// SPDX-License-Identifier: Apache-2.0
#include "octree_facts.hpp"

#include <cmath>

#include <fmt/format.h>

#include "model.hpp"

namespace octavo::cli {
namespace {

double cell_size(const octree::Octree& tree) {
    return std::ldexp(1.0, tree.lattice().exponent() + exact::coordinate_bits - tree.depth());
}

}  // namespace

Json json_of(const octree::Octree& tree, std::size_t file_bytes) {
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
    return {{"depth", tree.depth()},
            {"leaves", stats.leaves()},
            {"white", stats.white},
            {"black", stats.black},
            {"gray", stats.gray},
            {"nodes", stats.nodes()},
            {"volume_lower", octree::world_volume(tree.lattice(), stats.black_volume)},
            {"volume_upper", octree::world_volume(tree.lattice(), stats.black_volume + stats.gray_volume)},
            {"cell_size", cell_size(tree)},
            {"bytes", file_bytes},
            {"levels", levels}};
}

std::string text_of(const octree::Octree& tree, std::size_t file_bytes) {
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
    text += fmt::format("leaves     {} ({} white, {} black, {} gray), smallest cell {:.6g}\n",
                        grouped(stats.leaves()), grouped(stats.white), grouped(stats.black),
                        grouped(stats.gray), cell_size(tree));
    text += fmt::format("volume     between {:.10g} and {:.10g}\n", lower, upper);
    text += fmt::format("size       {} bytes, {:.2f} bits a node\n", grouped(file_bytes),
                        8.0 * static_cast<double>(file_bytes) / static_cast<double>(stats.nodes()));
    return text;
}

}  // namespace octavo::cli
