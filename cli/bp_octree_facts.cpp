// SPDX-License-Identifier: Apache-2.0
#include "bp_octree_facts.hpp"

#include <fmt/format.h>

#include <octavo/base/counted.hpp>

#include "number_text.hpp"

namespace octavo::cli {
namespace {

/// The bytes that one more level takes; the first includes head and index.
std::uint64_t bytes_of_level(std::span<const std::uint64_t> bytes_to_level, std::size_t level) {
    return bytes_to_level[level] - (level > 0 ? bytes_to_level[level - 1] : 0);
}

/// A volume as a percentage of the solid's; nothing for a surface that bounds none.
bool has_percentage(const bp_octree::BpOctree& tree) { return tree.is_solid && tree.solid_volume > 0; }
double percentage(const bp_octree::BpOctree& tree, double volume) { return 100 * volume / tree.solid_volume; }

}  // namespace

Json json_of(const bp_octree::BpOctree& tree, std::span<const std::uint64_t> bytes_to_level,
             std::uint64_t file_bytes) {
    Json levels = Json::array();
    std::uint64_t leaves = 0;
    for (std::size_t i = 0; i < tree.levels.size(); ++i) {
        const bp_octree::LevelFigures& figures = tree.levels[i];
        leaves += figures.gray;
        Json level = {{"level", i},
                      {"planes", figures.planes},
                      {"volume", figures.volume},
                      {"bytes", bytes_of_level(bytes_to_level, i)},
                      {"split", figures.split},
                      {"gray", figures.gray},
                      {"white", figures.white},
                      {"black", figures.black}};
        if (has_percentage(tree)) level["volume_percent"] = percentage(tree, figures.volume);
        levels.push_back(std::move(level));
    }
    return {{"format", "bpo"},
            {"levels", levels},
            {"leaves", leaves},
            {"planes", tree.planes.size()},
            {"bytes", file_bytes},
            {"volume", tree.solid_volume},
            {"closed", tree.is_solid},
            {"depth", tree.frame.depth()},
            {"nodes", tree.nodes.size()},
            {"triangles", tree.mesh.triangles.size()},
            {"vertices", tree.mesh.points.size()},
            {"triangle_references", tree.leaf_triangles.size()}};
}

std::string text_of(const bp_octree::BpOctree& tree, std::span<const std::uint64_t> bytes_to_level,
                    std::uint64_t file_bytes) {
    std::string text =
        fmt::format("{:>5} {:>11} {:>11} {:>11} {:>11} {:>11} {:>14} {:>9} {:>12}\n", "level", "split",
                    "leaves", "white", "black", "planes", "volume", "% solid", "bytes");
    std::uint64_t leaves = 0;
    for (std::size_t i = 0; i < tree.levels.size(); ++i) {
        const bp_octree::LevelFigures& figures = tree.levels[i];
        leaves += figures.gray;
        text +=
            fmt::format("{:>5} {:>11} {:>11} {:>11} {:>11} {:>11} {:>14} {:>9} {:>12}\n", i,
                        grouped(figures.split), grouped(figures.gray), grouped(figures.white),
                        grouped(figures.black), grouped(figures.planes), number_text(figures.volume),
                        has_percentage(tree) ? fmt::format("{:.2f}", percentage(tree, figures.volume)) : "-",
                        grouped(bytes_of_level(bytes_to_level, i)));
    }
    const std::size_t triangles = tree.mesh.triangles.size();
    text += fmt::format("solid      {}\n", tree.is_solid
                                               ? "volume " + number_text(tree.solid_volume)
                                               : "none: the surface is open, and enveloped as a surface");
    text += fmt::format("tree       {}, {}, {}\n", counted(leaves, "leaf", "leaves"),
                        counted(tree.planes.size(), "plane", "planes"),
                        counted(triangles, "triangle", "triangles"));
    text += fmt::format("size       {} bytes", grouped(file_bytes));
    if (triangles)
        text += fmt::format(", {:.2f} a triangle",
                            static_cast<double>(file_bytes) / static_cast<double>(triangles));
    return text + "\n";
}

}  // namespace octavo::cli
