// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/facet_tree.hpp>

namespace octavo::boolean {
namespace {

/// A facet is long when its box is longer than this many times the side of a facet if the scene's were a square
/// mesh of equal ones. Less makes ordinary meshes pay for the separate descents, more leaves slivers among the others.
constexpr double long_ratio = 8;

}  // namespace

FacetTree::FacetTree(const Soup& soup, const Context& context, double reach, std::span<const char> spread)
    : reach_(reach) {
    const double limit =
        long_ratio * exact::universe_side / std::sqrt(static_cast<double>(soup.facets.size()) + 1);
    constexpr std::size_t grain = 1 << 14;
    UninitialisedVector<std::uint32_t> keys(soup.facets.size());
    UninitialisedVector<char> is_long(soup.facets.size());
    const std::vector<std::size_t> offset =
        chunk_offsets(context, is_long.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t facet = begin; facet < end; ++facet) {
                const mesh::Triangle& corners = soup.facets[facet];
                const exact::Point a = soup.points[corners[0]], b = soup.points[corners[1]],
                                   c = soup.points[corners[2]];
                const exact::Point low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                                       std::min({a.z, b.z, c.z})},
                    high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
                is_long[facet] = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) > limit;
                keys[facet] = BoxTree::key_of(low, high);
                count += is_long[facet] != 0;
            }
            return count;
        });
    UninitialisedVector<BoxTree::Keyed> ordinary(is_long.size() - offset.back()), long_ones(offset.back());
    parallel_chunks(context, is_long.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t next_long = offset[begin / grain], next = begin - next_long;
        for (std::size_t facet = begin; facet < end; ++facet)
            (is_long[facet] ? long_ones[next_long++] : ordinary[next++]) = {
                keys[facet], static_cast<std::uint32_t>(facet)};
    });
    keys = {};
    // Of either box. Corners are integers: boxes that do not meet are a unit apart.
    const auto margin = reach < 1 ? 0 : static_cast<std::int32_t>(std::ceil(reach / 2));
    ordinary_ = BoxTree(soup, std::move(ordinary), margin, context, spread);
    long_ = BoxTree(soup, std::move(long_ones), margin, context, spread);
}

std::vector<FacetTree::Task> FacetTree::pair_tasks(std::size_t count) const {
    std::vector<Task> tasks;
    if (!ordinary_.empty()) tasks.push_back({ordinary_.top(), 0, 0});
    while (!tasks.empty() && tasks.size() < count && tasks.front().level > 0) {
        std::vector<Task> finer;
        for (const Task& task : tasks) {
            const BoxNode &node = ordinary_.node(task.level, task.first),
                          &other = ordinary_.node(task.level, task.second);
            for (std::uint32_t lane = 0; lane < width; ++lane) {
                unsigned hits = meeting(other, node, static_cast<int>(lane));
                if (task.first == task.second) hits &= ~0u << lane;
                for (; hits; hits &= hits - 1)
                    finer.push_back(
                        {task.level - 1, task.first * width + lane,
                         task.second * width + static_cast<std::uint32_t>(std::countr_zero(hits))});
            }
        }
        tasks.swap(finer);
    }
    const auto facets = static_cast<std::uint32_t>(long_.size());
    const std::uint32_t step = std::max<std::uint32_t>(64, static_cast<std::uint32_t>(facets / count + 1));
    for (std::uint32_t begin = 0; begin < facets; begin += step)
        tasks.push_back({long_facets, begin, std::min(begin + step, facets)});
    return tasks;
}

}  // namespace octavo::boolean
