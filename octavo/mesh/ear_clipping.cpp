// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/mesh/ear_clipping.hpp>

namespace octavo::mesh {
namespace {

// An outline that needs more forced cuts than this crosses itself all over; searching on for ears would take
// quadratic time to tell nothing new.
constexpr std::uint32_t most_forced_cuts = 64;

constexpr std::uint32_t no_node = ~std::uint32_t{0}, no_watch = ~std::uint32_t{0};

// A grid of fewer corners is not worth building anew when half of them have gone.
constexpr std::uint32_t least_rebuilt = 24;

}  // namespace

EarClippingResult EarClipping::clip(CornerRing& ring, const Context& context) {
    start(ring);
    while (remaining_ > 3) {
        if (remaining_ % 1024 == 0 && context.cancelled()) return result_;
        if (!spikes_.empty()) {
            const Node node = spikes_.back();
            spikes_.pop_back();
            if (gone_[node] || turn_at(node) != 0) continue;
            ++result_.flat_triangles;
            cut(node);
        } else if (queue_head_ < queue_.size()) {
            const Node node = queue_[queue_head_++];
            if (!gone_[node] && is_ear(node)) cut(node);
        } else if (result_.forced_triangles > most_forced_cuts) {
            ++result_.forced_triangles;
            cut(any_);
        } else {
            cut_without_ear();
        }
    }
    if (remaining_ == 3) {
        const int turn = turn_at(any_);
        result_.flat_triangles += turn == 0;
        result_.forced_triangles += turn < 0;
        triangles_.push_back(
            {(*nodes_)[previous(any_)].corner, (*nodes_)[any_].corner, (*nodes_)[next(any_)].corner});
    }
    return result_;
}

void EarClipping::start(CornerRing& ring) {
    nodes_ = &ring.nodes;
    any_ = ring.start;
    remaining_ = static_cast<std::uint32_t>(ring.nodes.size());
    result_ = {};
    triangles_.clear();
    queue_.clear();
    queue_head_ = 0;
    spikes_.clear(), doubles_.clear(), flats_.clear();
    looked_for_flats_ = false;
    convex_.assign(remaining_, 0);
    gone_.assign(remaining_, 0);
    watches_.clear();
    watch_of_.assign(remaining_, no_watch);
    watchers_.assign(remaining_, {no_watch, no_watch});
    not_convex_ = 0;
    for (Node node = 0; node < remaining_; ++node) {
        convex_[node] = turn_at(node) > 0;
        not_convex_ += !convex_[node];
    }
    build_grid();
    queue_convex();
}

template <class Visit>
void EarClipping::for_each_node(const Visit& visit) const {
    Node node = any_;
    do {
        visit(node);
        node = next(node);
    } while (node != any_);
}

void EarClipping::queue_convex() {
    for_each_node([&](Node node) {
        if (convex_[node]) queue_.push_back(node);
    });
}

void EarClipping::build_grid() {
    gridded_ = not_convex_;
    to_grid_.clear();
    for_each_node([&](Node node) {
        if (!convex_[node]) to_grid_.push_back({position(node), node});
    });
    grid_.build(to_grid_);
}

void EarClipping::update(Node node) {
    // Cutting ears makes angles smaller. A convex corner that becomes collinear has closed to a spike without
    // inside; left standing it would make its base look convex.
    const int turn = turn_at(node);
    if (convex_[node]) {
        if (turn == 0) spikes_.push_back(node);
        // An outline that crosses itself can open a corner again; it is lost to the grid, which costs quality
        // where there is none.
        convex_[node] = turn > 0;
    } else if (turn > 0) {
        convex_[node] = 1;
        --not_convex_;
        release(node, Block::inside);
    } else if (turn == 0 && looked_for_flats_) {
        (is_double(node) ? doubles_ : flats_).push_back(node);
    }
    release(node, Block::touching);
}

bool EarClipping::is_ear(Node node) {
    if (!convex_[node]) return false;
    const Node before = previous(node), after = next(node);
    const auto block_by = [&](Node other) {
        if (gone_[other] || convex_[other] || other == before || other == after) return Block::none;
        return block(other, node);
    };
    // What stood in the way the last time is likely to do so still.
    if (watch_of_[node] != no_watch) {
        const Watch& watch = watches_[watch_of_[node]];
        if (block_by(watch.blocker) == watch.block) return false;
        watch_of_[node] = no_watch;
    }
    return !grid_.any_near(position(before), position(node), position(after), [&](Node other) {
        const Block found = block_by(other);
        if (found != Block::none) watch(node, other, found);
        return found != Block::none;
    });
}

void EarClipping::watch(Node ear, Node blocker, Block block) {
    std::uint32_t& first = watchers_[blocker][static_cast<std::size_t>(block)];
    watch_of_[ear] = static_cast<std::uint32_t>(watches_.size());
    watches_.push_back({ear, blocker, block, first});
    first = watch_of_[ear];
}

void EarClipping::release(Node blocker, Block block) {
    std::uint32_t& first = watchers_[blocker][static_cast<std::size_t>(block)];
    for (std::uint32_t at = first; at != no_watch; at = watches_[at].next) {
        const Node ear = watches_[at].ear;
        if (watch_of_[ear] != at) continue;  // it waits for another corner now
        watch_of_[ear] = no_watch;
        if (!gone_[ear]) queue_.push_back(ear);
    }
    first = no_watch;
}

/// Does the ring enter the triangle of `ear` at the corner `other`? Corners that only touch it from outside
/// do not count, or outlines that touch themselves would have no ears.
EarClipping::Block EarClipping::block(Node other, Node ear) const {
    const Point2 a = position(previous(ear)), b = position(ear), c = position(next(ear)), p = position(other);
    // At the ends of the cut the ring cannot enter without having a corner inside or crossing itself.
    if (p == a || p == c) return Block::none;
    const Point2 neighbours[] = {position(previous(other)), position(next(other))};
    if (p == b) {
        for (const Point2 q : neighbours)
            if (orient2d(a, b, q) > 0 && orient2d(b, c, q) > 0) return Block::touching;
        return Block::none;
    }
    const int ab = orient2d(a, b, p), bc = orient2d(b, c, p), ca = orient2d(c, a, p);
    if (ab < 0 || bc < 0 || ca < 0) return Block::none;
    if (ab > 0 && bc > 0) return Block::inside;  // inside, or on the cut itself
    // On a side of the triangle: does it come from within?
    for (const Point2 q : neighbours)
        if ((ab == 0 && orient2d(a, b, q) > 0) || (bc == 0 && orient2d(b, c, q) > 0)) return Block::touching;
    return Block::none;
}

void EarClipping::cut(Node node) {
    const Node before = previous(node), after = next(node);
    triangles_.push_back({(*nodes_)[before].corner, (*nodes_)[node].corner, (*nodes_)[after].corner});
    (*nodes_)[before].next = after;
    (*nodes_)[after].previous = before;
    gone_[node] = 1;
    not_convex_ -= !convex_[node] && not_convex_ > 0;
    any_ = after;
    --remaining_;
    release(node, Block::inside), release(node, Block::touching);
    update(before);
    update(after);
    if (gridded_ >= least_rebuilt && not_convex_ * 2 < gridded_) build_grid();
    if (convex_[before]) queue_.push_back(before);
    if (convex_[after]) queue_.push_back(after);
}

/// A corner that lies on a neighbour, or the tip of a spike.
bool EarClipping::is_double(Node node) const {
    const Point2 a = position(previous(node)), b = position(node), c = position(next(node));
    return a == b || b == c || a == c;
}

void EarClipping::cut_without_ear() {
    // Best first: a double adds nothing; a flat corner adds a triangle without area; anything else is wrong, a convex
    // corner least. Those that become flat later are noted as they do.
    if (!looked_for_flats_) {
        looked_for_flats_ = true;
        for_each_node([&](Node node) {
            if (turn_at(node) == 0) (is_double(node) ? doubles_ : flats_).push_back(node);
        });
    }
    for (std::vector<Node>* list : {&doubles_, &flats_})
        while (!list->empty()) {
            const Node node = list->back();
            list->pop_back();
            if (gone_[node] || turn_at(node) != 0) continue;
            ++result_.flat_triangles;
            return cut(node);
        }
    ++result_.forced_triangles;
    Node convex = no_node;
    for_each_node([&](Node node) {
        if (convex == no_node && convex_[node]) convex = node;
    });
    cut(convex != no_node ? convex : any_);
}

}  // namespace octavo::mesh
