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

constexpr std::size_t grain = 1 << 12;

std::vector<Bundle> find_bundles(const Soup& soup, std::span<const BoxTree::Keyed> long_ones, double reach) {
    std::vector<std::uint32_t> facets;
    facets.reserve(long_ones.size());
    for (const BoxTree::Keyed& each : long_ones) facets.push_back(each.facet);
    return bundles_among(soup, facets, reach);
}

}  // namespace

FacetTree::FacetTree(const Soup& soup, const Context& context, double reach, std::span<const char> spread)
    : reach_(reach) {
    const double limit =
        long_ratio * exact::universe_side / std::sqrt(static_cast<double>(soup.facets.size()) + 1);
    UninitialisedVector<std::uint32_t> keys(soup.facets.size());
    UninitialisedVector<char> is_long(soup.facets.size());
    const std::vector<std::size_t> offset =
        chunk_offsets(context, is_long.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t facet = begin; facet < end; ++facet) {
                const FacetBox box(soup.facets[facet], soup.points);
                is_long[facet] = std::max({box.high.x - box.low.x, box.high.y - box.low.y,
                                           box.high.z - box.low.z}) > limit;
                keys[facet] = BoxTree::key_of(box);
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
    const BoxTree::Room room{soup.points, {margin, margin, margin}};
    const std::vector<Bundle> bundles = find_bundles(soup, long_ones, reach);
    if (!bundles.empty()) {
        std::vector<char> is_left(soup.facets.size(), 1);
        for (const Bundle& bundle : bundles) add_bundle(soup, bundle, is_left, context, spread);
        const auto bundled =
            std::stable_partition(long_ones.begin(), long_ones.end(),
                                  [&](const BoxTree::Keyed& each) { return is_left[each.facet] != 0; });
        bundled_ =
            BoxTree(soup, UninitialisedVector<BoxTree::Keyed>(bundled, long_ones.end()), room, context);
        bundled_.forget_blocks();
        long_ones.erase(bundled, long_ones.end());
    }
    ordinary_ = BoxTree(soup, std::move(ordinary), room, context, spread);
    long_ = BoxTree(soup, std::move(long_ones), room, context, spread);
}

void FacetTree::add_bundle(const Soup& soup, const Bundle& bundle, std::vector<char>& is_left,
                           const Context& context, std::span<const char> spread) {
    const TurnedFrame& frame = bundle.frame;
    UninitialisedVector<exact::Point> places(soup.points.size());
    parallel_chunks(context, places.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) places[i] = frame.place(soup.points[i]);
    });
    UninitialisedVector<BoxTree::Keyed> own(bundle.facets.size());
    for (std::size_t i = 0; i < own.size(); ++i) {
        const std::uint32_t facet = bundle.facets[i];
        own[i] = {BoxTree::key_of({soup.facets[facet], places}), facet};
        is_left[facet] = 0;
    }
    const auto for_each_other = [&](std::size_t begin, std::size_t end, const auto& visit) {
        for (std::size_t facet = begin; facet < end; ++facet) {
            if (!is_left[facet]) continue;
            const FacetBox box(soup.facets[facet], places);
            if (!TurnedFrame::is_outside(box.low, box.high))
                visit(BoxTree::Keyed{BoxTree::key_of(box), static_cast<std::uint32_t>(facet)});
        }
    };
    const std::vector<std::size_t> offset =
        chunk_offsets(context, is_left.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for_each_other(begin, end, [&](const BoxTree::Keyed&) { ++count; });
            return count;
        });
    UninitialisedVector<BoxTree::Keyed> others(offset.back());
    parallel_chunks(context, is_left.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t next = offset[begin / grain];
        for_each_other(begin, end, [&](const BoxTree::Keyed& each) { others[next++] = each; });
    });
    const BoxTree::Room room{places, frame.margin};
    bundles_.push_back({frame, BoxTree(soup, std::move(own), room, context, spread),
                        BoxTree(soup, std::move(others), room, context, spread)});
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
    const auto add_long = [&](std::size_t size, std::uint32_t bundle) {
        const auto facets = static_cast<std::uint32_t>(size);
        const std::uint32_t step =
            std::max<std::uint32_t>(64, static_cast<std::uint32_t>(facets / count + 1));
        for (std::uint32_t begin = 0; begin < facets; begin += step)
            tasks.push_back({long_facets, begin, std::min(begin + step, facets), bundle});
    };
    add_long(long_.size(), no_index);
    for (std::uint32_t i = 0; i < bundles_.size(); ++i) add_long(bundles_[i].own.size(), i);
    return tasks;
}

}  // namespace octavo::boolean
