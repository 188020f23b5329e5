// SPDX-License-Identifier: Apache-2.0
#include "bp_octree_facts.hpp"

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/bp_octree/bpo_format.hpp>

#include "number_text.hpp"

namespace octavo::cli {
namespace {

/// The bytes that one more level takes; the first includes head and index.
std::uint64_t bytes_of_level(const BpOctreeFacts& facts, std::size_t level) {
    return facts.bytes_to_level[level] - (level > 0 ? facts.bytes_to_level[level - 1] : 0);
}

/// A volume as a percentage of the solid's; nothing for a surface that bounds none.
bool has_percentage(const BpOctreeFacts& facts) { return facts.is_solid && facts.solid_volume > 0; }
double percentage(const BpOctreeFacts& facts, double volume) { return 100 * volume / facts.solid_volume; }

std::uint64_t leaves_of(const BpOctreeFacts& facts) {
    std::uint64_t leaves = 0;
    for (const bp_octree::LevelFigures& level : facts.levels) leaves += level.gray;
    return leaves;
}

}  // namespace

BpOctreeFacts facts_of(const bp_octree::BpOctree& tree, std::span<const std::uint8_t> bytes) {
    return {.levels = tree.levels,
            .bytes_to_level = *bp_octree::bytes_to_level(bytes),
            .bytes = bytes.size(),
            .is_solid = tree.is_solid,
            .solid_volume = tree.solid_volume,
            .depth = tree.frame.depth(),
            .nodes = tree.nodes.size(),
            .planes = tree.planes.size(),
            .triangles = tree.mesh.triangles.size(),
            .vertices = tree.mesh.points.size(),
            .references = tree.leaf_triangles.size()};
}

BpOctreeFacts facts_of(const bp_octree::BpoReader& reader) {
    const bp_octree::BpoHead& head = reader.head();
    return {.levels = reader.levels(),
            .bytes_to_level = reader.bytes_to_level(),
            .bytes = head.file_size,
            .is_solid = head.is_solid,
            .solid_volume = head.solid_volume,
            .depth = head.frame.depth(),
            .nodes = head.nodes,
            .planes = head.planes,
            .triangles = head.triangles,
            .vertices = head.points,
            .references = {}};
}

Json json_of(const BpOctreeFacts& facts) {
    Json levels = Json::array();
    for (std::size_t i = 0; i < facts.levels.size(); ++i) {
        const bp_octree::LevelFigures& figures = facts.levels[i];
        Json level = {{"level", i},
                      {"planes", figures.planes},
                      {"volume", figures.volume},
                      {"bytes", bytes_of_level(facts, i)},
                      {"split", figures.split},
                      {"gray", figures.gray},
                      {"white", figures.white},
                      {"black", figures.black}};
        if (has_percentage(facts)) level["volume_percent"] = percentage(facts, figures.volume);
        levels.push_back(std::move(level));
    }
    Json result = {{"format", "bpo"},
                   {"levels", levels},
                   {"leaves", leaves_of(facts)},
                   {"planes", facts.planes},
                   {"bytes", facts.bytes},
                   {"volume", facts.solid_volume},
                   {"closed", facts.is_solid},
                   {"depth", facts.depth},
                   {"nodes", facts.nodes},
                   {"triangles", facts.triangles},
                   {"vertices", facts.vertices}};
    if (facts.references) result["triangle_references"] = *facts.references;
    return result;
}

std::string text_of(const BpOctreeFacts& facts) {
    std::string text =
        fmt::format("{:>5} {:>11} {:>11} {:>11} {:>11} {:>11} {:>14} {:>9} {:>12}\n", "level", "split",
                    "leaves", "white", "black", "planes", "volume", "% solid", "bytes");
    for (std::size_t i = 0; i < facts.levels.size(); ++i) {
        const bp_octree::LevelFigures& figures = facts.levels[i];
        text += fmt::format(
            "{:>5} {:>11} {:>11} {:>11} {:>11} {:>11} {:>14} {:>9} {:>12}\n", i, grouped(figures.split),
            grouped(figures.gray), grouped(figures.white), grouped(figures.black), grouped(figures.planes),
            number_text(figures.volume),
            has_percentage(facts) ? fmt::format("{:.2f}", percentage(facts, figures.volume)) : "-",
            grouped(bytes_of_level(facts, i)));
    }
    text += fmt::format("solid      {}\n", facts.is_solid
                                               ? "volume " + number_text(facts.solid_volume)
                                               : "none: the surface is open, and enveloped as a surface");
    text += fmt::format("tree       {}, {}, {}\n", counted(leaves_of(facts), "leaf", "leaves"),
                        counted(facts.planes, "plane", "planes"),
                        counted(facts.triangles, "triangle", "triangles"));
    text += fmt::format("size       {} bytes", grouped(facts.bytes));
    if (facts.triangles)
        text += fmt::format(", {:.2f} a triangle",
                            static_cast<double>(facts.bytes) / static_cast<double>(facts.triangles));
    return text + "\n";
}

}  // namespace octavo::cli
