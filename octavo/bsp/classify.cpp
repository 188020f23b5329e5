// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/classify.hpp>

namespace octavo::bsp {

Label label_of_uniform_cell(const Tree& tree, const octree::Cell& cell, const PlaneTable& planes) {
    // Twice the centre: low + high walls, each a half-integer.
    using exact::budget::normal, exact::budget::offset;
    static_assert(exact::budget::sum(4, exact::budget::greater(normal + 28, offset + 1)) < 127);
    std::int64_t twice[3];
    for (int axis = 0; axis < 3; ++axis) twice[axis] = 2 * std::int64_t{cell.low[axis]} + cell.side() - 1;
    Child at = Tree::root;
    while (!at.is_leaf()) {
        const Node& node = tree.nodes[at.index()];
        const exact::Plane& plane = planes[node.plane];
        exact::int128 value = 2 * plane.d();
        for (int axis = 0; axis < 3; ++axis) value += exact::wide(plane.normal(axis)) * twice[axis];
        if (value == 0) value = plane.a() != 0 ? plane.a() : plane.b() != 0 ? plane.b() : plane.c();
        at = value < 0 ? node.back : node.front;
    }
    return tree.label(at);
}

}  // namespace octavo::bsp
