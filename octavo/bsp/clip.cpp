// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/clip.hpp>

namespace octavo::bsp {

bool Clipper::clip(FragmentPool& pool, const Fragment& fragment, const Tree& tree, FaceSide side,
                   std::vector<Fragment>& kept, Child from, Whole whole) {
    const std::size_t first_kept = kept.size();
    // Inside is behind a face, on the plane's back unless the face is reversed.
    const bool to_front = fragment.facing.reversed() == (side == FaceSide::inner);
    bool all = true, join = true;
    met_coplanar_ = false;
    tasks_.clear();
    tasks_.push_back({fragment, from});
    while (!tasks_.empty()) {
        const Task task = tasks_.back();
        tasks_.pop_back();
        if (task.child.is_leaf()) {
            if (tree.label(task.child) == Label::in)
                kept.push_back(task.fragment);
            else
                all = false;
            continue;
        }
        const Node& node = tree.nodes[task.child.index()];
        if (node.plane == fragment.facing.plane()) {
            met_coplanar_ = true;
            tasks_.push_back({task.fragment, to_front ? node.front : node.back});
            continue;
        }
        pool.begin_cut(Bound::plane(node.plane), pool.planes()[node.plane]);
        const FragmentPool::Place place = pool.place(task.fragment);
        if (whole == Whole::apart_at_edges && place != FragmentPool::Place::both)
            join = join && !pool.has_edge_in_cut();
        switch (place) {
            case FragmentPool::Place::front:
                tasks_.push_back({task.fragment, node.front});
                break;
            case FragmentPool::Place::back:
                tasks_.push_back({task.fragment, node.back});
                break;
            case FragmentPool::Place::both: {
                Fragment front, back;
                pool.split(task.fragment, front, back);
                tasks_.push_back({back, node.back});
                tasks_.push_back({front, node.front});
                break;
            }
            case FragmentPool::Place::within:
                OCTAVO_CHECK(false, "a face lies in a plane that is not its own");
        }
    }
    if (all && join) {
        kept.resize(first_kept);
        kept.push_back(fragment);
    }
    return all;
}

Intersection intersect(FragmentPool& pool, std::span<const Fragment> first, const Tree& first_tree,
                       std::span<const Fragment> second, const Tree& second_tree, Clipper& clipper,
                       std::vector<Fragment>& result) {
    Intersection found;
    // The solid is behind a face of the first where it is behind it in the second too.
    for (const Fragment& fragment : first) {
        const std::size_t before = result.size();
        if (!clipper.clip(pool, fragment, second_tree, FaceSide::inner, result)) found.all_of_first = false;
        if (result.size() != before) found.none_of_first = false;
    }
    // The same for the second; but where it lies in a face of the first, that one has been taken already, or looks
    // the other way and has nothing behind it. So both sides must be inside the first.
    std::vector<Fragment> inner;
    for (const Fragment& fragment : second) {
        const std::size_t before = result.size();
        inner.clear();
        bool all = clipper.clip(pool, fragment, first_tree, FaceSide::inner, inner);
        if (!clipper.met_coplanar()) {
            result.insert(result.end(), inner.begin(), inner.end());
        } else {
            for (const Fragment& piece : inner)
                if (!clipper.clip(pool, piece, first_tree, FaceSide::outer, result)) all = false;
        }
        if (!all) found.all_of_second = false;
        if (result.size() != before) found.none_of_second = false;
    }
    return found;
}

}  // namespace octavo::bsp
