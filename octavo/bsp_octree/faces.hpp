// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/bsp_octree/subdivide.hpp>

// The boundary of a BSP-octree as it lies in its leaves: convex fragments, cut by walls and by planes of trees.

namespace octavo::bsp_octree {

/// Calls `visit(pool, fragments)` for each BSP leaf, or fewer once the context is cancelled; both are valid until it
/// returns. Tells the context how far the phase "faces" is.
template <class Visit>
void for_each_boundary(const BspOctree& octree, const Context& context, const Visit& visit) {
    const Store& store = octree.store();
    bsp::FragmentPool pool(store.planes);
    bsp::BoundaryExtractor extractor;
    Fragments fragments;
    CellProgress progress(context, "faces");
    octree.for_each_leaf([&](const octree::Cell& cell, NodeRef leaf) {
        if (context.cancelled()) return;
        progress.finish(cell);
        if (!leaf.is_bsp()) return;
        const bsp::FragmentPool::Mark mark = pool.mark();
        fragments.clear();
        extractor.extract(pool, cell, store.tree(leaf), fragments);
        visit(static_cast<const bsp::FragmentPool&>(pool), static_cast<const Fragments&>(fragments));
        pool.release(mark);
    });
}

}  // namespace octavo::bsp_octree
