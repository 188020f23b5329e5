// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/boundary.hpp>

namespace octavo::bsp {

void BoundaryExtractor::extract(FragmentPool& pool, const octree::Cell& cell, const Tree& tree,
                                std::vector<Fragment>& faces) {
    polygons_.for_each(pool, cell, tree.nodes, [&](std::size_t index, const Fragment& polygon) {
        if (polygon.count > 0) add_faces(pool, tree, tree.nodes[index], polygon, faces);
    });
}

void BoundaryExtractor::add_faces(FragmentPool& pool, const Tree& tree, const Node& node,
                                  const Fragment& section, std::vector<Fragment>& faces) {
    const auto visit = [&](Label front) {
        // Faces with this label in front of the plane and the other one behind it.
        const Tree seen{tree.nodes, tree.complemented != (front == Label::out)};
        const Tree other{tree.nodes, !seen.complemented};
        front_in_.clear();
        Fragment asked = section;
        asked.facing = Facing::of(node.plane, front == Label::in);
        clipper_.clip(pool, asked, seen, FaceSide::inner, front_in_, node.front, Whole::apart_at_edges);
        for (const Fragment& piece : front_in_)
            clipper_.clip(pool, piece, other, FaceSide::inner, faces, node.back, Whole::apart_at_edges);
    };
    visit(Label::out);
    visit(Label::in);
}

}  // namespace octavo::bsp
