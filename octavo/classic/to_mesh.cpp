// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include <octavo/classic/boundary_squares.hpp>
#include <octavo/classic/to_mesh.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::classic {
namespace {

using Spot = std::array<std::int32_t, 3>;
using Index = std::uint32_t;

/// All corners of the squares, in the order of lines along each axis.
class Corners {
  public:
    explicit Corners(const std::vector<BoundarySquare>& squares) {
        for (const BoundarySquare& square : squares)
            for (int corner = 0; corner < 4; ++corner) spots_.push_back(corner_of(square, corner));
        std::sort(spots_.begin(), spots_.end());
        spots_.erase(std::unique(spots_.begin(), spots_.end()), spots_.end());
        spots_.shrink_to_fit();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lines_[axis].resize(spots_.size());
            std::iota(lines_[axis].begin(), lines_[axis].end(), 0U);
            std::sort(lines_[axis].begin(), lines_[axis].end(),
                      [&](Index a, Index b) { return along(axis, spots_[a]) < along(axis, spots_[b]); });
        }
    }

    /// Corner 0–3 of a square, counter-clockwise seen from greater coordinates.
    static Spot corner_of(const BoundarySquare& square, int corner) {
        Spot spot = square.low;
        if (corner == 1 || corner == 2) spot[(square.axis + 1U) % 3] += square.side;
        if (corner == 2 || corner == 3) spot[(square.axis + 2U) % 3] += square.side;
        return spot;
    }

    const std::vector<Spot>& spots() const { return spots_; }

    /// The corners on the segment from `from` to `to`, the end left out.
    void append_between(const Spot& from, const Spot& to, std::vector<Index>& ring) const {
        std::size_t axis = 0;
        while (from[axis] == to[axis]) ++axis;
        const std::vector<Index>& line = lines_[axis];
        const auto place = [&](const Spot& spot) {
            return std::lower_bound(line.begin(), line.end(), spot, [&](Index a, const Spot& b) {
                return along(axis, spots_[a]) < along(axis, b);
            });
        };
        auto at = place(from);
        const auto end = place(to);
        if (at < end)
            for (; at != end; ++at) ring.push_back(*at);
        else
            for (; at != end; --at) ring.push_back(*at);
    }

  private:
    static std::tuple<std::int32_t, std::int32_t, std::int32_t> along(std::size_t axis, const Spot& s) {
        return {s[(axis + 1) % 3], s[(axis + 2) % 3], s[axis]};
    }

    std::vector<Spot> spots_;
    std::array<std::vector<Index>, 3> lines_;
};

/// A side of a polygon between two neighbouring corners, which one or three other polygons share.
struct Side {
    Index low, high;  // corners
    Index polygon;    // in order of the squares
    Index slot;       // the corner it starts at, counted through all polygons
    bool upwards;
};

/// Where the surface meets itself its vertices are doubled: slots (a corner of a polygon) that are joined across an
/// edge or within it are one vertex.
using Fans = mesh::DisjointSets;

// Corners of squares, and then of polygons, are numbered by 32 bits.
constexpr std::size_t most_corners = 0xFFFFFFF0U;

Error too_many_corners() {
    return {ErrorCode::limit, "the boundary has more vertices than 32-bit indices number", {}};
}

class Builder {
    static constexpr Index none = ~Index{0};

  public:
    Builder(const octree::Octree& octree, std::vector<BoundarySquare> squares)
        : lattice_(octree.lattice()),
          squares_(std::move(squares)),
          corners_(squares_),
          spots_(corners_.spots()) {}

    Result<mesh::Mesh> run(const Context& context) {
        make_rings();
        if (ring_.size() > most_corners) return too_many_corners();
        cut_touching_edges();
        if (ring_.size() + squares_.size() > most_corners) return too_many_corners();
        if (context.cancelled()) return Context::cancelled_error();
        Fans fans(ring_.size());
        pair_sides(fans);
        if (context.cancelled()) return Context::cancelled_error();
        return triangles(fans);
    }

  private:
    void make_rings() {
        begin_.push_back(0);
        for (const BoundarySquare& square : squares_) {
            for (int corner = 0; corner < 4; ++corner) {
                // Seen from outside the corners run counter-clockwise.
                const int from = square.faces_up ? corner : 3 - corner;
                const int to = square.faces_up ? (corner + 1) % 4 : (6 - corner) % 4;
                corners_.append_between(Corners::corner_of(square, from), Corners::corner_of(square, to),
                                        ring_);
            }
            begin_.push_back(static_cast<Index>(ring_.size()));
        }
    }

    /// Gives every edge with four facets a corner in its middle.
    void cut_touching_edges() {
        const std::vector<Side> sides = sorted_sides();
        std::vector<Index> middle_after(ring_.size(), none);
        for (std::size_t i = 0; i + 2 < sides.size(); ++i) {
            if (sides[i].low != sides[i + 2].low || sides[i].high != sides[i + 2].high) continue;
            const Spot &a = spots_[sides[i].low], &b = spots_[sides[i].high];
            const auto middle = static_cast<Index>(spots_.size());
            spots_.push_back({a[0] + (b[0] - a[0]) / 2, a[1] + (b[1] - a[1]) / 2, a[2] + (b[2] - a[2]) / 2});
            for (std::size_t k = i; k < i + 4; ++k) middle_after[sides[k].slot] = middle;
            i += 3;
        }
        std::vector<Index> ring, begin{0};
        for (std::size_t polygon = 0; polygon + 1 < begin_.size(); ++polygon) {
            for (Index slot = begin_[polygon]; slot < begin_[polygon + 1]; ++slot) {
                ring.push_back(ring_[slot]);
                if (middle_after[slot] != none) ring.push_back(middle_after[slot]);
            }
            begin.push_back(static_cast<Index>(ring.size()));
        }
        ring_ = std::move(ring);
        begin_ = std::move(begin);
    }

    Index next(Index polygon, Index slot) const {
        return slot + 1 == begin_[polygon + 1] ? begin_[polygon] : slot + 1;
    }

    std::vector<Side> sorted_sides() const {
        std::vector<Side> sides;
        sides.reserve(ring_.size());
        for (Index polygon = 0; polygon < squares_.size(); ++polygon)
            for (Index slot = begin_[polygon]; slot < begin_[polygon + 1]; ++slot) {
                const Index a = ring_[slot], b = ring_[next(polygon, slot)];
                sides.push_back({std::min(a, b), std::max(a, b), polygon, slot, a < b});
            }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            return std::tie(a.low, a.high, a.upwards, a.slot) < std::tie(b.low, b.high, b.upwards, b.slot);
        });
        return sides;
    }

    void pair_sides(Fans& fans) const {
        const std::vector<Side> sides = sorted_sides();
        for (std::size_t i = 0; i < sides.size();) {
            std::size_t end = i;
            while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high)
                ++end;
            if (end - i == 2) {
                join(fans, sides[i], sides[i + 1]);
            } else {
                // Two solid quarters about the edge: the two facets of a quarter belong together. Facets of one
                // direction come first.
                const bool straight = same_quarter(sides[i], sides[i + 2]);
                join(fans, sides[i], sides[straight ? i + 2 : i + 3]);
                join(fans, sides[i + 1], sides[straight ? i + 3 : i + 2]);
            }
            i = end;
        }
    }

    /// Whether the solid next to both facets is the same quarter of the space about their common edge: each facet
    /// then lies on the other's solid side.
    bool same_quarter(const Side& a, const Side& b) const {
        const BoundarySquare &p = squares_[a.polygon], &q = squares_[b.polygon];
        const auto on_solid_side = [&](const BoundarySquare& facet, const BoundarySquare& other) {
            const std::int64_t middle2 =
                2 * std::int64_t{other.low[facet.axis]} + (other.axis == facet.axis ? 0 : other.side);
            const std::int64_t plane2 = 2 * std::int64_t{facet.low[facet.axis]};
            return facet.faces_up ? middle2 < plane2 : middle2 > plane2;
        };
        return p.axis != q.axis && on_solid_side(p, q) && on_solid_side(q, p);
    }

    void join(Fans& fans, const Side& a, const Side& b) const {
        fans.unite(a.slot, next(b.polygon, b.slot));
        fans.unite(next(a.polygon, a.slot), b.slot);
    }

    mesh::Mesh triangles(Fans& fans) const {
        mesh::Mesh mesh;
        std::vector<Index> vertex(ring_.size());
        for (Index slot = 0; slot < ring_.size(); ++slot) {
            const Index root = fans.find(slot);
            if (root == slot) {
                vertex[slot] = static_cast<Index>(mesh.vertices.size());
                mesh.vertices.push_back(world(spots_[ring_[slot]]));
            } else {
                vertex[slot] = vertex[root];  // roots come first
            }
        }
        for (Index polygon = 0; polygon < squares_.size(); ++polygon) {
            const Index first = begin_[polygon], last = begin_[polygon + 1];
            if (last - first == 4) {
                mesh.triangles.push_back({vertex[first], vertex[first + 1], vertex[first + 2]});
                mesh.triangles.push_back({vertex[first], vertex[first + 2], vertex[first + 3]});
                continue;
            }
            const auto middle = static_cast<Index>(mesh.vertices.size());
            const BoundarySquare& square = squares_[polygon];
            Spot spot = square.low;
            // Sides with corners inside are at least two cells of level 21 long, so the middle is a lattice point.
            spot[(square.axis + 1U) % 3] += square.side / 2;
            spot[(square.axis + 2U) % 3] += square.side / 2;
            mesh.vertices.push_back(world(spot));
            for (Index slot = first; slot < last; ++slot)
                mesh.triangles.push_back({middle, vertex[slot], vertex[next(polygon, slot)]});
        }
        return mesh;
    }

    Vec3 world(const Spot& spot) const { return lattice_.to_world({spot[0], spot[1], spot[2]}); }

    const exact::Lattice& lattice_;
    std::vector<BoundarySquare> squares_;
    Corners corners_;
    std::vector<Spot> spots_;   // of the squares, then of the middles
    std::vector<Index> ring_;   // corners of all polygons, one after the other
    std::vector<Index> begin_;  // of each polygon in `ring_`
};

}  // namespace

Result<mesh::Mesh> to_mesh(const octree::Octree& octree, const ToMeshOptions& options,
                           const Context& context) {
    const bool gray = options.counted == CountedLeaves::black_and_gray;
    Result<std::vector<BoundarySquare>> squares = boundary_squares(octree, {false, true, gray});
    if (!squares) return squares.error();
    if (squares->empty()) return mesh::Mesh{};
    if (squares->size() > most_corners / 4) return too_many_corners();
    return Builder(octree, std::move(*squares)).run(context);
}

}  // namespace octavo::classic
