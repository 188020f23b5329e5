// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/boundary.hpp>

namespace octavo::bsp {

void BoundaryExtractor::extract(FragmentPool& pool, const octree::Cell& cell, const Tree& tree,
                                std::vector<Fragment>& faces) {
    path_.clear();
    steps_.clear();
    steps_.push_back({0, 0, false});
    while (!steps_.empty()) {
        const Step step = steps_.back();
        steps_.pop_back();
        const Node& node = tree.nodes[static_cast<std::size_t>(step.node)];
        path_.resize(step.depth);
        if (step.depth > 0) path_.back().is_front = step.is_front;
        const Fragment section = polygon(pool, cell, node.plane);
        if (section.count > 0) add_faces(pool, tree, node, section, faces);

        path_.push_back({node.plane, false});
        const auto below = static_cast<std::uint32_t>(path_.size());
        if (!node.back.is_leaf()) steps_.push_back({node.back.value, below, false});
        if (!node.front.is_leaf()) steps_.push_back({node.front.value, below, true});
    }
}

Fragment BoundaryExtractor::polygon(FragmentPool& pool, const octree::Cell& cell, PlaneId plane) {
    Fragment section = pool.section(plane, cell);
    for (const Side& side : path_) {
        if (section.count == 0) break;
        pool.begin_cut(Bound::plane(side.plane), pool.planes()[side.plane]);
        Fragment front, back;
        switch (pool.place(section)) {
            case FragmentPool::Place::both:
                pool.split(section, front, back);
                section = side.is_front ? front : back;
                break;
            case FragmentPool::Place::front:
                if (!side.is_front) section.count = 0;
                break;
            case FragmentPool::Place::back:
                if (side.is_front) section.count = 0;
                break;
            case FragmentPool::Place::within:
                OCTAVO_CHECK(false, "a plane comes twice on a path of a BSP tree");
        }
    }
    return section;
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
        clipper_.clip(pool, asked, seen, FaceSide::inner, front_in_, node.front);
        for (const Fragment& piece : front_in_)
            clipper_.clip(pool, piece, other, FaceSide::inner, faces, node.back);
    };
    visit(Label::out);
    visit(Label::in);
}

}  // namespace octavo::bsp
