// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp/winding_labels.hpp>

namespace octavo::bsp {
namespace {

constexpr std::uint32_t leaf_of(std::size_t node, bool is_front) {
    return static_cast<std::uint32_t>(2 * node + (is_front ? 1 : 0));
}

/// Parts a triangle's plane along one of its sides: through the side and parallel to an axis that is not in the plane.
exact::Plane upright_plane(exact::Point p, exact::Point q, int axis) {
    exact::Point r = p;
    const int step = p[axis] + 1 < exact::universe_side ? 1 : -1;
    (axis == 0 ? r.x : axis == 1 ? r.y : r.z) += step;
    return exact::Plane::through(p, q, r);
}

/// Makes a spot of a triangle's plane smaller until the triangle covers all of it or nothing; whether it does.
bool covers(FragmentPool& pool, const Fragment& face, Fragment& spot) {
    const int axis = pool.planes()[face.facing.plane()].dominant_axis();
    for (std::uint32_t k = 0; k < 3; ++k) {
        const Bound side = Bound::side(3 * face.source + k),
                    next = Bound::side(3 * face.source + (k + 1) % 3);
        const auto [p, q] = pool.ends_of(side);
        const exact::Plane plane = upright_plane(p, q, axis);
        const bool inner_is_front = exact::side_of(plane, pool.ends_of(next)[1]) == exact::Sign::positive;
        pool.begin_cut(side, plane);
        const FragmentPool::Place place = pool.place(spot);
        if (place == FragmentPool::Place::both) {
            Fragment front, back;
            pool.split(spot, front, back);
            spot = inner_is_front ? front : back;
        } else if ((place == FragmentPool::Place::front) != inner_is_front) {
            return false;
        }
    }
    return true;
}

bool overlap(const Box3& a, const Box3& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis])) return false;
    return true;
}

/// The winding number behind a spot less that in front of it; makes the spot smaller. The faces are all in its plane.
std::int32_t winding_across(FragmentPool& pool, std::span<const WindingLabels::Face> faces, Fragment& spot) {
    Box3 box;
    for (const Corner& corner : pool.corners(spot)) box.add(pool.approximation(corner.vertex));
    std::int32_t change = 0;
    for (const WindingLabels::Face& face : faces)
        if (overlap(face.box, box) && covers(pool, face.fragment, spot))
            change += face.fragment.facing.reversed() ? -1 : 1;
    return change;
}

}  // namespace

bool WindingLabels::label(FragmentPool& pool, const octree::Cell& cell, std::span<const Fragment> fragments,
                          std::span<Node> nodes, std::int32_t at_low_corner) {
    nodes_ = nodes;
    first_step_.assign(2 * nodes.size(), none);
    steps_.clear();
    sort_by_plane(pool, fragments);
    const FragmentPool::Mark mark = pool.mark();
    polygons_.for_each(pool, cell, nodes, [&](std::size_t node, Fragment spot) {
        OCTAVO_CHECK(spot.count > 0, "the plane of a node passes by its region");
        const std::int32_t change = winding_across(pool, faces_in(nodes[node].plane), spot);
        const Leaf front = leaf_beside(pool, spot, node, true), back = leaf_beside(pool, spot, node, false);
        join(front, back, change);
    });
    const bool cancels = cancel(pool);
    pool.release(mark);
    spread(leaf_at(cell.low, pool.planes()), at_low_corner);
    return put_labels(nodes) && !cancels;
}

void WindingLabels::sort_by_plane(const FragmentPool& pool, std::span<const Fragment> fragments) {
    faces_.clear();
    for (const Fragment& fragment : fragments) {
        Box3 box;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const exact::Point p = pool.ends_of(Bound::side(3 * fragment.source + k))[0];
            box.add(Vec3{p.x - 1.0, p.y - 1.0, p.z - 1.0});
            box.add(Vec3{p.x + 1.0, p.y + 1.0, p.z + 1.0});
        }
        faces_.push_back({fragment, box});
    }
    std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
        return a.fragment.facing != b.fragment.facing ? a.fragment.facing < b.fragment.facing
                                                      : a.fragment.source < b.fragment.source;
    });
}

std::span<const WindingLabels::Face> WindingLabels::faces_in(PlaneId plane) const {
    const auto begin = std::partition_point(
        faces_.begin(), faces_.end(), [&](const Face& face) { return face.fragment.facing.plane() < plane; });
    const auto end = std::partition_point(
        begin, faces_.end(), [&](const Face& face) { return face.fragment.facing.plane() == plane; });
    return {begin, end};
}

/// Whether some faces look at each other in one plane, so that there is no boundary there.
bool WindingLabels::cancel(FragmentPool& pool) const {
    for (std::size_t i = 0; i < faces_.size(); ++i)
        for (std::size_t k = i; k-- > 0;) {
            const Face &face = faces_[i], &other = faces_[k];
            if (face.fragment.facing.plane() != other.fragment.facing.plane()) break;
            Fragment common = face.fragment;
            if (face.fragment.facing != other.fragment.facing && overlap(face.box, other.box) &&
                covers(pool, other.fragment, common))
                return true;
        }
    return false;
}

/// The leaf with a lattice point inside the cell, moved off all planes.
WindingLabels::Leaf WindingLabels::leaf_at(const exact::Point& corner, const PlaneTable& planes) const {
    Leaf leaf = 0;
    for (Child at = Tree::root; !at.is_leaf();) {
        const Node& node = nodes_[at.index()];
        const exact::Plane& plane = planes[node.plane];
        exact::int128 value = plane.value_at(corner);
        if (value == 0) value = plane.a() != 0 ? plane.a() : plane.b() != 0 ? plane.b() : plane.c();
        leaf = leaf_of(at.index(), value > 0);
        at = value > 0 ? node.front : node.back;
    }
    return leaf;
}

/// The leaf on one side of a spot of a node's plane, which becomes smaller.
WindingLabels::Leaf WindingLabels::leaf_beside(FragmentPool& pool, Fragment& spot, std::size_t index,
                                               bool is_front) const {
    while (true) {
        const Child at = is_front ? nodes_[index].front : nodes_[index].back;
        if (at.is_leaf()) return leaf_of(index, is_front);
        index = at.index();
        pool.begin_cut(Bound::plane(nodes_[index].plane));
        const FragmentPool::Place place = pool.place(spot);
        OCTAVO_CHECK(place != FragmentPool::Place::within, "a plane comes twice on a path of a BSP tree");
        is_front = place != FragmentPool::Place::back;
        if (place != FragmentPool::Place::both) continue;
        Fragment front, back;
        pool.split(spot, front, back);
        spot = front;
    }
}

void WindingLabels::join(Leaf front, Leaf back, std::int32_t change) {
    const auto add = [&](Leaf from, Leaf to, std::int32_t by) {
        steps_.push_back({to, by, first_step_[from]});
        first_step_[from] = static_cast<std::uint32_t>(steps_.size() - 1);
    };
    add(front, back, change), add(back, front, -change);
}

void WindingLabels::spread(Leaf from, std::int32_t winding) {
    windings_.assign(first_step_.size(), 0);
    is_known_.assign(first_step_.size(), 0);
    windings_[from] = winding, is_known_[from] = 1;
    open_.assign(1, from);
    while (!open_.empty()) {
        const Leaf leaf = open_.back();
        open_.pop_back();
        for (std::uint32_t i = first_step_[leaf]; i != none; i = steps_[i].next) {
            const Step& step = steps_[i];
            if (is_known_[step.to]) continue;
            windings_[step.to] = windings_[leaf] + step.change, is_known_[step.to] = 1;
            open_.push_back(step.to);
        }
    }
}

bool WindingLabels::put_labels(std::span<Node> nodes) const {
    bool separates = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (const bool is_front : {false, true}) {
            Child& child = is_front ? nodes[i].front : nodes[i].back;
            if (!child.is_leaf()) continue;
            const Leaf leaf = leaf_of(i, is_front);
            OCTAVO_CHECK(is_known_[leaf], "the nodes of a tree join its regions");
            const std::int32_t winding = windings_[leaf];
            const Child labelled = Child::leaf(winding > 0 ? Label::in : Label::out);
            separates = separates && (winding == 0 || winding == 1) && child == labelled;
            child = labelled;
        }
    return separates;
}

}  // namespace octavo::bsp
