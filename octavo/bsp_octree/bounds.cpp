// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp_octree/bounds.hpp>

namespace octavo::bsp_octree {
namespace {

/// What lies in a cell lies in the box.
bool holds(const Box3& box, const octree::Cell& cell) {
    const exact::Point high = cell.high();
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.low[axis] <= cell.low[axis] - 0.5 && high[axis] - 0.5 <= box.high[axis])) return false;
    return true;
}

/// The same in lattice units.
Box3 bounds_of_faces(const BspOctree& solid) {
    const Store& store = solid.store();
    bsp::FragmentPool pool(store.planes);
    bsp::BoundaryExtractor extractor;
    std::vector<bsp::Fragment> faces;
    Box3 bounds;
    solid.for_each_leaf([&](const octree::Cell& cell, NodeRef leaf) {
        if (!leaf.is_bsp() || holds(bounds, cell)) return;
        const bsp::FragmentPool::Mark mark = pool.mark();
        faces.clear();
        extractor.extract(pool, cell, store.tree(leaf), faces);
        for (const bsp::Fragment& face : faces)
            for (const bsp::Corner& corner : pool.corners(face))
                bounds.add(pool.approximation(corner.vertex));
        pool.release(mark);
    });
    return bounds;
}

}  // namespace

Box3 bounds_of(const BspOctree& solid) {
    const exact::Lattice& lattice = solid.lattice();
    constexpr std::int32_t last = exact::universe_side - 1;
    if (solid.classify(lattice.to_world({0, 0, 0})) == bsp::Position::in)
        return {lattice.to_world({0, 0, 0}), lattice.to_world({last, last, last})};
    Box3 bounds = bounds_of_faces(solid);
    if (bounds.empty()) return bounds;
    // Coordinates are approximate, by far less than a unit.
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]);
        bounds.low[axis] = (origin + std::floor(bounds.low[axis] - 0.5)) * lattice.unit();
        bounds.high[axis] = (origin + std::ceil(bounds.high[axis] + 0.5)) * lattice.unit();
    }
    return bounds;
}

}  // namespace octavo::bsp_octree
