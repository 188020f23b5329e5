// SPDX-License-Identifier: Apache-2.0
#include "bsp_octree_facts.hpp"

#include <fmt/format.h>

#include "model.hpp"

namespace octavo::cli {

void tell(Session& session, const bsp_octree::BspOctree& octree, std::uint64_t bytes) {
    const bsp_octree::Stats stats = octree.stats();
    const std::uint64_t leaves = stats.white + stats.black + stats.bsp_leaves;
    session.result = {{"format", "bso"},
                      {"leaves", leaves},
                      {"white", stats.white},
                      {"black", stats.black},
                      {"bsp_leaves", stats.bsp_leaves},
                      {"bsp_nodes", stats.bsp_nodes},
                      {"planes", stats.planes},
                      {"bytes", bytes},
                      {"depth", stats.deepest},
                      {"largest_tree", stats.largest_tree},
                      {"memory", stats.bytes}};
    session.text = fmt::format(
        "BSP-octree: {} leaves ({} white, {} black, {} BSP) to level {}\n"
        "  {} BSP nodes, {} in the largest tree, {} planes\n"
        "  {} bytes in a file, {} in memory\n",
        grouped(leaves), grouped(stats.white), grouped(stats.black), grouped(stats.bsp_leaves), stats.deepest,
        grouped(stats.bsp_nodes), grouped(stats.largest_tree), grouped(stats.planes), grouped(bytes),
        grouped(stats.bytes));
}

}  // namespace octavo::cli
