// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <octavo/base/parallel.hpp>
#include <octavo/base/shared_progress.hpp>
#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>

// The boundary of a BSP-octree as it lies in its leaves: convex fragments, cut by walls and by planes of trees.
//
// Leaves are taken in batches, each by one task with a pool of its own. Batches are handed on in the order of the
// leaves, so what is made of them does not depend on threads; only some are under way at a time, so that they need
// little memory.

namespace octavo::bsp_octree {

/// Calls `take(pool, fragments, batch)` for each BSP leaf, at the same time as others; batches begin as `empty`. Each
/// task has its copy of `take`, which may keep memory from leaf to leaf; pool and fragments are valid until it returns.
/// Then calls `use(batches)`, for some after the other. Cancelled, batches are missing. Phase "faces".
template <class Batch, class Take, class Use>
void for_each_boundary(const BspOctree& octree, const Context& context, const Batch& empty, const Take& take,
                       const Use& use) {
    constexpr std::size_t batch_leaves = 64, most_batches = 128;
    struct Leaf {
        octree::Cell cell;
        NodeRef node;
    };
    const Store& store = octree.store();
    std::vector<Leaf> leaves;
    octree.for_each_leaf([&](const octree::Cell& cell, NodeRef leaf) {
        if (leaf.is_bsp()) leaves.push_back({cell, leaf});
    });
    const auto share = [&](std::size_t done) {
        return static_cast<double>(done) / static_cast<double>(leaves.size());
    };
    for (std::size_t first = 0; first < leaves.size(); first += batch_leaves * most_batches) {
        const std::size_t count = std::min(leaves.size() - first, batch_leaves * most_batches);
        std::vector<Batch> batches((count + batch_leaves - 1) / batch_leaves, empty);
        SharedProgress progress(context, "faces", batches.size(), share(first), share(first + count));
        parallel_chunks(context, count, batch_leaves, [&](std::size_t begin, std::size_t end) {
            Take own_take = take;
            bsp::FragmentPool pool(store.planes);
            bsp::BoundaryExtractor extractor;
            std::vector<bsp::Fragment> fragments;
            for (std::size_t i = begin; i < end; ++i) {
                const bsp::FragmentPool::Mark mark = pool.mark();
                const Leaf& leaf = leaves[first + i];
                fragments.clear();
                extractor.extract(pool, leaf.cell, store.tree(leaf.node), fragments);
                own_take(static_cast<const bsp::FragmentPool&>(pool),
                         std::span<const bsp::Fragment>(fragments), batches[begin / batch_leaves]);
                pool.release(mark);
            }
            progress.step();
        });
        if (context.cancelled()) return;
        use(std::span<const Batch>(batches));
    }
}

}  // namespace octavo::bsp_octree
