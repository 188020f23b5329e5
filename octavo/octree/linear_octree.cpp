// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <octavo/base/parallel.hpp>
#include <octavo/octree/linear_octree.hpp>

namespace octavo::octree {
namespace {

// A table entry for every eight leaves or so leaves a handful of steps to the binary search; 2^18 entries
// (level 6) are 1 MiB, beyond which the table itself would fall out of the cache.
int top_level_for(std::size_t leaves) {
    int level = 0;
    while (level < 6 && (std::size_t{1} << (3 * (level + 1))) * 8 <= leaves) ++level;
    return level;
}

}  // namespace

Result<LinearOctree> LinearOctree::from(const Octree& octree) {
    const std::uint64_t leaves = octree.code().size() - octree.code().size() / 8;
    if (leaves >= std::numeric_limits<LeafIndex>::max())
        return Error{ErrorCode::limit, "the octree has more leaves than a linear octree can number", {}};
    LinearOctree linear;
    linear.lattice_ = octree.lattice();
    linear.depth_ = octree.depth();
    linear.keys_.reserve(leaves);
    linear.colors_.reserve(leaves);
    octree.for_each_leaf([&](CellKey key, Color color) {
        linear.keys_.push_back(key);
        linear.colors_.push_back(color);
    });

    linear.top_level_ = top_level_for(linear.keys_.size());
    const std::uint64_t entries = 1ULL << (3 * linear.top_level_);
    linear.top_.reserve(entries + 1);
    LeafIndex leaf = 0;
    for (std::uint64_t entry = 0; entry < entries; ++entry) {
        const std::uint64_t code = entry << (3 * (max_level - linear.top_level_));
        const CellKey first = CellKey::from_code(code, max_level);
        while (linear.keys_[leaf].last_descendant() < first) ++leaf;
        linear.top_.push_back(leaf);
    }
    linear.top_.push_back(linear.size() - 1);
    return linear;
}

Octree LinearOctree::to_octree() const {
    DfCode code;
    CellKey open = CellKey::root();
    for (LeafIndex leaf = 0; leaf < size(); ++leaf) {
        // The splits between the first ancestor that starts here and the leaf itself.
        for (; open != keys_[leaf]; open = open.child(0)) code.append(Node::split);
        code.append(leaf_of(colors_[leaf]));
        const std::uint64_t next = keys_[leaf].last_descendant().code() + 1;
        if (next >> (3 * max_level) == 0) {
            const int level = max_level - std::countr_zero(next) / 3;
            open = CellKey::from_code(next, level);
        }
    }
    return {lattice_, depth_, std::move(code)};
}

LeafIndex LinearOctree::leaf_at(CellKey key) const {
    // The last leaf whose first descendant is not after `key`.
    const std::uint64_t entry = key.code() >> (3 * (max_level - top_level_));
    const auto begin = keys_.begin() + top_[entry], end = keys_.begin() + top_[entry + 1] + 1;
    const auto found =
        std::partition_point(begin, end, [&](CellKey leaf) { return leaf.last_descendant() < key; });
    return static_cast<LeafIndex>(found - keys_.begin());
}

std::vector<LeafIndex> LinearOctree::locate(std::span<const exact::Point> points,
                                            const Context& context) const {
    std::vector<LeafIndex> leaves(points.size());
    parallel_chunks(context, points.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) leaves[i] = locate(points[i]);
    });
    return leaves;
}

LeafRange LinearOctree::leaves_of(CellKey cell) const {
    const LeafIndex first = leaf_at(cell.first_descendant());
    if (keys_[first].contains(cell)) return {first, first + 1};
    return {first, leaf_at(cell.last_descendant()) + 1};
}

LeafRange LinearOctree::neighbours(LeafIndex leaf, int dx, int dy, int dz) const {
    const std::optional<CellKey> next = keys_[leaf].neighbour(dx, dy, dz);
    return next ? leaves_of(*next) : LeafRange{};
}

}  // namespace octavo::octree
