// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/mesh/ear_clipping.hpp>

namespace octavo::mesh {
namespace {

// An outline that needs more forced cuts than this crosses itself all over; searching on for ears would take
// quadratic time to tell nothing new.
constexpr std::uint32_t most_forced_cuts = 64;

constexpr std::uint32_t no_node = ~std::uint32_t{0};

// Below this many corners that are not convex, looking at all of them is faster than a grid.
constexpr std::uint32_t least_gridded = 24;

}  // namespace

EarClippingResult EarClipping::clip(CornerRing& ring) {
    start(ring);
    while (remaining_ > 3) {
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
        } else if (!requeue_all()) {
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
    spikes_.clear();
    convex_.assign(remaining_, 0);
    gone_.assign(remaining_, 0);
    not_convex_ = 0;
    for (Node node = 0; node < remaining_; ++node) {
        convex_[node] = turn_at(node) > 0;
        not_convex_ += !convex_[node];
    }
    build_grid();
    requeue_all();
}

std::uint32_t EarClipping::column(double x) const {
    const double c = (x - grid_low_.x) * columns_per_x_;  // no number in a grid without width
    return c > 0 ? std::min(static_cast<std::uint32_t>(std::min(c, 1e9)), columns_ - 1) : 0;
}

std::uint32_t EarClipping::row(double y) const {
    const double r = (y - grid_low_.y) * rows_per_y_;
    return r > 0 ? std::min(static_cast<std::uint32_t>(std::min(r, 1e9)), rows_ - 1) : 0;
}

void EarClipping::build_grid() {
    gridded_ = not_convex_;
    Point2 low{INFINITY, INFINITY}, high{-INFINITY, -INFINITY};
    const auto for_each = [&](const auto& visit) {
        Node node = any_;
        do {
            if (!convex_[node]) visit(node);
            node = next(node);
        } while (node != any_);
    };
    for_each([&](Node node) {
        const Point2 p = position(node);
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    });
    // Rounding in column() is monotone, so a box's columns always include those of the points in it.
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(not_convex_)));
    columns_ = rows_ = not_convex_ < least_gridded ? 1 : side;
    grid_low_ = low;
    columns_per_x_ = high.x > low.x ? columns_ / (high.x - low.x) : 0;
    rows_per_y_ = high.y > low.y ? rows_ / (high.y - low.y) : 0;
    const auto cell = [&](Node node) { return row(position(node).y) * columns_ + column(position(node).x); };
    cell_begin_.assign(std::size_t{columns_} * rows_ + 2, 0);
    for_each([&](Node node) { ++cell_begin_[cell(node) + 2]; });
    for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
    cell_nodes_.resize(not_convex_);
    for_each([&](Node node) { cell_nodes_[cell_begin_[cell(node) + 1]++] = node; });
    cell_begin_.pop_back();
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
    }
}

bool EarClipping::is_ear(Node node) const {
    if (!convex_[node]) return false;
    const Node before = previous(node), after = next(node);
    const Point2 a = position(before), b = position(node), c = position(after);
    const Point2 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
    const Point2 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
    const std::uint32_t last_row = row(high.y), first_column = column(low.x), last_column = column(high.x);
    for (std::uint32_t r = row(low.y); r <= last_row; ++r) {
        const std::uint32_t begin = cell_begin_[r * columns_ + first_column];
        const std::uint32_t end = cell_begin_[r * columns_ + last_column + 1];
        for (std::uint32_t i = begin; i < end; ++i) {
            const Node other = cell_nodes_[i];
            const Point2 p = position(other);
            if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
            if (gone_[other] || convex_[other] || other == before || other == after) continue;
            if (blocks(other, node)) return false;
        }
    }
    return true;
}

/// Does the ring enter the triangle of `ear` at the corner `other`? Corners that only touch it from outside
/// do not count, or outlines that touch themselves would have no ears.
bool EarClipping::blocks(Node other, Node ear) const {
    const Point2 a = position(previous(ear)), b = position(ear), c = position(next(ear)), p = position(other);
    // At the ends of the cut the ring cannot enter without having a corner inside or crossing itself.
    if (p == a || p == c) return false;
    const Point2 neighbours[] = {position(previous(other)), position(next(other))};
    if (p == b) {
        for (const Point2 q : neighbours)
            if (orient2d(a, b, q) > 0 && orient2d(b, c, q) > 0) return true;
        return false;
    }
    const int ab = orient2d(a, b, p), bc = orient2d(b, c, p), ca = orient2d(c, a, p);
    if (ab < 0 || bc < 0 || ca < 0) return false;
    if (ab > 0 && bc > 0) return true;  // inside, or on the cut itself
    // On a side of the triangle: does it come from within?
    for (const Point2 q : neighbours)
        if ((ab == 0 && orient2d(a, b, q) > 0) || (bc == 0 && orient2d(b, c, q) > 0)) return true;
    return false;
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
    update(before);
    update(after);
    if (gridded_ >= least_gridded && not_convex_ * 2 < gridded_) build_grid();
    if (convex_[before]) queue_.push_back(before);
    if (convex_[after]) queue_.push_back(after);
}

bool EarClipping::requeue_all() {
    queue_.clear();
    queue_head_ = 0;
    Node node = any_;
    do {
        if (is_ear(node)) queue_.push_back(node);
        node = next(node);
    } while (node != any_);
    return !queue_.empty();
}

void EarClipping::cut_without_ear() {
    // Best first: a corner that lies on a neighbour, or the tip of a spike, adds nothing; a flat corner adds
    // a triangle without area; anything else is wrong, a convex corner least.
    Node flat = no_node, convex = no_node, node = any_;
    do {
        const Point2 a = position(previous(node)), b = position(node), c = position(next(node));
        if (a == b || b == c || a == c) {
            ++result_.flat_triangles;
            return cut(node);
        }
        const int turn = turn_at(node);
        if (turn == 0 && flat == no_node) flat = node;
        if (turn > 0 && convex == no_node) convex = node;
        node = next(node);
    } while (node != any_);
    if (flat != no_node) {
        ++result_.flat_triangles;
        return cut(flat);
    }
    ++result_.forced_triangles;
    cut(convex != no_node ? convex : any_);
}

}  // namespace octavo::mesh
