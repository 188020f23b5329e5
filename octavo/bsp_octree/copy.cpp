// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp_octree/copy.hpp>

namespace octavo::bsp_octree {

NodeRef Copier::operator()(NodeRef node) {
    if (node.is_uniform()) return node;
    if (node.is_gray()) {
        Octants octants = from_.grays[node.index()];
        for (NodeRef& octant : octants) octant = (*this)(octant);
        return to_.add_gray(octants).complement_if(node.complemented());
    }
    const std::size_t begin = to_.nodes.size();
    for (bsp::Node copied : from_.tree(node).nodes) {
        copied.plane = plane(copied.plane);
        to_.nodes.push_back(copied);
    }
    return to_.add_leaf(begin).complement_if(node.complemented());
}

bsp::PlaneId Copier::plane(bsp::PlaneId id) {
    bsp::PlaneId& copied = planes_[id];
    if (copied == unknown) {
        // The points run counter-clockwise seen from the front, so no table turns the plane.
        const bsp::PlaneTable::Points& points = from_.planes.points(id);
        copied = to_.planes.add(points[0], points[1], points[2]).plane();
    }
    return copied;
}

}  // namespace octavo::bsp_octree
