// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>

#include <octavo/mesh/corner_grid.hpp>
#include <octavo/mesh/corner_ring.hpp>

namespace octavo::mesh {
namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

bool lexicographically_less(Point2 a, Point2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

struct Contour {
    std::uint32_t begin = 0, end = 0;
    std::uint32_t least = 0;  ///< its lexicographically smallest corner
};

/// Twice the signed area, rounded; decides only which way round a hole is linked.
double twice_area(std::span<const Point2> positions, Contour contour) {
    double sum = 0;
    const Point2 o = positions[contour.begin];
    for (std::uint32_t i = contour.begin + 1; i + 1 < contour.end; ++i) {
        const Point2 a = positions[i], b = positions[i + 1];
        sum += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    }
    return sum;
}

void link(std::vector<RingCorner>& nodes, Contour contour, bool backwards) {
    for (std::uint32_t i = contour.begin; i < contour.end; ++i) {
        const std::uint32_t after = i + 1 == contour.end ? contour.begin : i + 1;
        const std::uint32_t before = i == contour.begin ? contour.end - 1 : i - 1;
        nodes[i].next = backwards ? before : after;
        nodes[i].previous = backwards ? after : before;
    }
}

/// The edge that starts at a node, seen from the point `m` at whose height it passes.
struct CrossedEdge {
    std::uint32_t node = none;
    Point2 low, high;  ///< its ends by height
};

/// Does `a` cross the ray nearer to its origin (further right) than `b`? Both cross it and neither crosses
/// the other, so the end of one that lies within the heights of the other tells.
bool further_right(const CrossedEdge& a, const CrossedEdge& b) {
    if (a.low.y >= b.low.y && a.low.y <= b.high.y) {
        const int side = orient2d(b.low, b.high, a.low);
        if (side != 0) return side < 0;
    }
    if (a.high.y >= b.low.y && a.high.y <= b.high.y) {
        const int side = orient2d(b.low, b.high, a.high);
        if (side != 0) return side < 0;
    }
    const int low = orient2d(a.low, a.high, b.low), high = orient2d(a.low, a.high, b.high);
    return low > 0 || (low == 0 && high > 0);
}

/// Does the direction from the corner to `target` start inside the polygon (or along its boundary)?
bool sees_locally(const std::vector<RingCorner>& nodes, std::uint32_t node, Point2 target) {
    const Point2 a = nodes[nodes[node].previous].position, b = nodes[node].position;
    const Point2 c = nodes[nodes[node].next].position;
    const bool left_of_in = orient2d(a, b, target) >= 0, left_of_out = orient2d(b, c, target) >= 0;
    return orient2d(a, b, c) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

/// Splices the ring of `inner` into the ring of `outer` by a bridge between the two corners.
void bridge(std::vector<RingCorner>& nodes, std::uint32_t outer, std::uint32_t inner) {
    const auto outer_copy = static_cast<std::uint32_t>(nodes.size()), inner_copy = outer_copy + 1;
    nodes.push_back(nodes[outer]);
    nodes.push_back(nodes[inner]);
    // … outer → inner … (round the hole) … inner_copy → outer_copy …
    nodes[nodes[outer].next].previous = outer_copy;
    nodes[nodes[inner].previous].next = inner_copy;
    nodes[outer].next = inner;
    nodes[inner].previous = outer;
    nodes[inner_copy].next = outer_copy;
    nodes[outer_copy].previous = inner_copy;
}

/// The ring while holes are joined to it: its edges that run downwards by the rows of a table of heights, and its
/// corners in a grid. Both only find what is then tested.
class GrowingRing {
  public:
    GrowingRing(std::vector<RingCorner>& nodes, Contour outer)
        : nodes_(nodes), start_(outer.begin), joined_(nodes.size()), next_copy_(nodes.size(), none) {
        std::vector<CornerGrid::Entry> corners;
        for (std::uint32_t i = 0; i < nodes.size(); ++i) corners.push_back({nodes[i].position, i});
        grid_.build(corners);
        make_rows();
        join(outer);
    }

    void add(Contour hole) {
        const std::uint32_t outer = visible_corner(nodes_[hole.least].position);
        const auto copies = static_cast<std::uint32_t>(nodes_.size());
        bridge(nodes_, outer, hole.least);
        join(hole);
        next_copy_.resize(nodes_.size(), none);
        for (const auto& [copy, corner] : {std::pair{copies, outer}, std::pair{copies + 1, hole.least}}) {
            next_copy_[copy] = next_copy_[corner];
            next_copy_[corner] = copy;
        }
        for (const std::uint32_t node : {outer, hole.least, copies, copies + 1}) file_edge(node);
    }

  private:
    struct Filed {
        std::uint32_t node, next;
    };

    Point2 after(std::uint32_t node) const { return nodes_[nodes_[node].next].position; }
    std::size_t row(double y) const {
        return std::min(static_cast<std::size_t>(std::max((y - lowest_) * rows_per_y_, 0.0)),
                        rows_.size() - 1);
    }

    /// As many rows as let an edge lie in eight of them on average.
    void make_rows() {
        double highest = -INFINITY, heights = 0;
        lowest_ = INFINITY;
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            const double y = nodes_[node].position.y;
            lowest_ = std::min(lowest_, y), highest = std::max(highest, y);
            heights += std::fabs(after(node).y - y);
        }
        const auto count = static_cast<double>(nodes_.size());
        const double height = highest - lowest_;
        const double rows = heights > 0 ? std::clamp(7 * count * (height / heights), 1.0, count) : 1.0;
        rows_.assign(static_cast<std::size_t>(rows), none);
        rows_per_y_ = height > 0 ? std::floor(rows) / height : 0;
    }

    void join(Contour contour) {
        for (std::uint32_t node = contour.begin; node < contour.end; ++node) {
            joined_[node] = true;
            file_edge(node);
        }
    }

    /// Files the edge that starts at the node. What is filed of an edge that was there before leads to this one too,
    /// which does no harm.
    void file_edge(std::uint32_t node) {
        const double from = nodes_[node].position.y, to = after(node).y;
        if (!(from > to)) return;
        for (std::size_t r = row(to), last = row(from); r <= last; ++r) {
            filed_.push_back({node, rows_[r]});
            rows_[r] = static_cast<std::uint32_t>(filed_.size() - 1);
        }
    }

    /// The edge that the ray from `m` to the left meets first, among those that run downwards there (the inside is to
    /// their right); none when there is no such edge.
    CrossedEdge first_edge_left_of(Point2 m) const {
        CrossedEdge best;
        for (std::uint32_t at = rows_[row(m.y)]; at != none; at = filed_[at].next) {
            const std::uint32_t node = filed_[at].node;
            const Point2 from = nodes_[node].position, to = after(node);
            if (from.y >= m.y && to.y <= m.y && from.y != to.y && orient2d(to, from, m) <= 0) {
                const CrossedEdge edge{node, to, from};
                if (best.node == none || further_right(edge, best)) best = edge;
            }
        }
        return best;
    }

    std::uint32_t visible_corner(Point2 m) const;

    std::vector<RingCorner>& nodes_;
    std::uint32_t start_;
    std::vector<bool> joined_;              ///< per corner of the input
    std::vector<std::uint32_t> next_copy_;  ///< per node: another one of the same corner
    CornerGrid grid_;                       ///< of the corners of the input
    double lowest_ = 0, rows_per_y_ = 0;
    std::vector<std::uint32_t> rows_;  ///< per row, the latest in filed_
    std::vector<Filed> filed_;
};

/// A corner of the ring that sees `m`, the leftmost point of a hole inside it.
std::uint32_t GrowingRing::visible_corner(Point2 m) const {
    const CrossedEdge edge = first_edge_left_of(m);
    if (edge.node == none) return start_;  // the hole is not inside: any bridge is as wrong as another
    const std::uint32_t lower = nodes_[edge.node].next;
    std::uint32_t best = nodes_[edge.node].position.x < nodes_[lower].position.x ? edge.node : lower;
    // The bridge to the left end of that edge is clear unless corners stand in the triangle (m, hit, end);
    // then the one at the least angle to the ray is seen. Which side of the ray the end is on says how to
    // turn.
    const Point2 end = nodes_[best].position;
    const int turn = end.y < m.y ? 1 : -1;
    const auto look_at = [&](std::uint32_t node) {
        const Point2 p = nodes_[node].position;
        const bool beside_ray = turn > 0 ? p.y <= m.y && p.y >= end.y : p.y >= m.y && p.y <= end.y;
        if (!beside_ray || p.x > m.x || (p == m && nodes_[best].position == m) ||
            orient2d(edge.low, edge.high, p) > 0 || !sees_locally(nodes_, node, m))
            return;
        const Point2 b = nodes_[best].position;
        const int side = turn * orient2d(m, b, p);
        const bool nearer = side == 0 && std::fabs(p.x - m.x) + std::fabs(p.y - m.y) <
                                             std::fabs(b.x - m.x) + std::fabs(b.y - m.y);
        const bool best_is_blind = p == b && !sees_locally(nodes_, best, m);
        if (side < 0 || nearer || best_is_blind) best = node;
    };
    // The edge's end is the leftmost point of that triangle, so this one is no smaller.
    grid_.any_near(m, {end.x, m.y}, end, [&](std::uint32_t corner) {
        for (std::uint32_t node = corner; joined_[corner] && node != none; node = next_copy_[node])
            look_at(node);
        return false;
    });
    return best;
}

}  // namespace

void build_ring(std::span<const Point2> positions, std::span<const std::uint32_t> contour_begin,
                CornerRing& ring) {
    std::vector<RingCorner>& nodes = ring.nodes;
    nodes.resize(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) nodes[i] = {positions[i], i, i, i};
    Contour outer;
    std::vector<Contour> holes;
    for (std::size_t c = 0; c + 1 < contour_begin.size(); ++c) {
        Contour contour{contour_begin[c], contour_begin[c + 1], contour_begin[c]};
        if (contour.begin == contour.end) continue;
        for (std::uint32_t i = contour.begin; i < contour.end; ++i)
            if (lexicographically_less(positions[i], positions[contour.least])) contour.least = i;
        link(nodes, contour, c > 0 && twice_area(positions, contour) > 0);
        if (c > 0)
            holes.push_back(contour);
        else
            outer = contour;
    }
    ring.start = contour_begin[0];
    // From left to right: the bridge to the left of a hole's leftmost corner can meet no hole that comes
    // later.
    std::sort(holes.begin(), holes.end(), [&](const Contour& a, const Contour& b) {
        const Point2 p = positions[a.least], q = positions[b.least];
        return p == q ? a.begin < b.begin : lexicographically_less(p, q);
    });
    if (holes.empty()) return;
    GrowingRing growing(nodes, outer);
    for (const Contour& hole : holes) growing.add(hole);
}

}  // namespace octavo::mesh
