// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/mesh/facet_octree.hpp>

namespace octavo::mesh {
namespace {

using exact::Point;

// Smaller leaves list facets more often, larger ones have more pairs.
constexpr std::size_t leaf_size = 24;

// A list that loses less than an eighth of its facets for so many levels will not become shorter: they really
// lie together there. Six levels let a cell shrink to 1/64, enough to get away from the far end of a fan.
constexpr int most_stalled = 6;

// Facets of a part. Small enough for eight threads to share 100K facets, large enough that the parts' own lists
// are lost in the cost.
constexpr std::size_t part_size = 4096;

/// The octants that a box touches, as bits: the low half of an axis holds [low, middle), the high one the rest.
std::uint32_t octants_of_box(const FacetBox& box, const std::array<std::int32_t, 3>& middle) {
    constexpr std::array<std::uint32_t, 3> low_halves{0x55, 0x33, 0x0f};
    std::uint32_t octants = 0xff;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.low[axis] >= middle[axis]) octants &= ~low_halves[axis];
        if (box.high[axis] < middle[axis]) octants &= low_halves[axis];
    }
    return octants;
}

FacetCell octant_of(const FacetCell& cell, std::size_t octant) {
    FacetCell child = cell;
    child.side = cell.side / 2;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (octant >> axis & 1) child.low[axis] += child.side;
    return child;
}

std::array<Point, 3> corners_of(const Triangle& t, std::span<const Point> points) {
    return {points[t[0]], points[t[1]], points[t[2]]};
}

/// The octants that a facet of the cell enters.
std::uint32_t octants_of(const std::array<Point, 3>& facet, const FacetCell& cell) {
    const std::int32_t half = cell.side / 2;
    const FacetBox box = box_of(facet);
    std::uint32_t octants = octants_of_box(box, {cell.low[0] + half, cell.low[1] + half, cell.low[2] + half});
    // A facet in one octant, or across one plane between two, is where its box is. Of the others only those
    // that are not small beside the cell are worth nine axes an octant.
    if (std::popcount(octants) <= 2) return octants;
    const std::int32_t extent =
        std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
    if (extent < cell.side / 4) return octants;
    for (std::uint32_t rest = octants; rest != 0; rest &= rest - 1) {
        const int octant = std::countr_zero(rest);
        if (!may_enter(facet, octant_of(cell, static_cast<std::size_t>(octant)).low, half))
            octants &= ~(1u << octant);
    }
    return octants;
}

/// The descent below one part; the lists of the cells on the path lie one after the other on a stack.
class LeafDescent {
  public:
    LeafDescent(std::span<const Point> points, std::span<const Triangle> triangles, const LeafVisitor& visit)
        : points_(points), triangles_(triangles), visit_leaf_(visit) {}

    void run(const FacetList& part) {
        stack_ = part.faces;
        visit(part.cell, 0);
    }

  private:
    /// The cell's list is the stack from `begin` to its top; it is gone afterwards.
    void visit(const FacetCell& cell, std::size_t begin) {
        const std::size_t count = stack_.size() - begin;
        if (count <= leaf_size || cell.side == 1 || cell.stalled >= most_stalled) {
            leaf(cell, begin);
        } else if (!is_fan_without_ends(cell, begin)) {
            split(cell, begin);
        }
        stack_.resize(begin);
    }

    void leaf(const FacetCell& cell, std::size_t begin) {
        const std::size_t count = stack_.size() - begin;
        if (count < 2) return;
        const std::size_t fan = count <= leaf_size ? 0 : put_fan_last(cell, begin);
        visit_leaf_({stack_.data() + begin, count}, fan);
    }

    void split(const FacetCell& cell, std::size_t begin) {
        const std::size_t end = stack_.size(), count = end - begin;
        const std::size_t first_mask = masks_.size();
        std::array<std::size_t, 8> counts{};
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t octants = octants_of(corners_of(triangles_[stack_[i]], points_), cell);
            masks_.push_back(static_cast<std::uint8_t>(octants));
            for (std::size_t octant = 0; octant < 8; ++octant) counts[octant] += octants >> octant & 1;
        }
        for (std::size_t octant = 0; octant < 8; ++octant) {
            if (counts[octant] < 2) continue;
            for (std::size_t i = 0; i < count; ++i)
                if (masks_[first_mask + i] >> octant & 1) stack_.push_back(stack_[begin + i]);
            FacetCell child = octant_of(cell, octant);
            child.stalled = counts[octant] > count - count / 8 ? cell.stalled + 1 : 0;
            visit(child, end);
        }
        masks_.resize(first_mask);
    }

    /// A vertex of the first facet that is a vertex of all, and is no end of an edge that enters the cell and
    /// lies opposite to it in some facet. Such a cell has nothing to find.
    bool is_fan_without_ends(const FacetCell& cell, std::size_t begin) {
        for (const VertexIndex vertex : triangles_[stack_[begin]]) {
            bool fan = true;
            for (std::size_t i = begin; fan && i < stack_.size(); ++i)
                fan = has_no_end_inside(stack_[i], vertex, cell);
            if (fan) return true;
        }
        return false;
    }

    /// Is `vertex` a vertex of the facet, whose side opposite to it stays out of the cell?
    bool has_no_end_inside(FaceIndex face, VertexIndex vertex, const FacetCell& cell) const {
        const auto [a, b, c] = triangles_[face];
        if (vertex == a) return !enters(points_[b], points_[c], cell.low, cell.side);
        if (vertex == b) return !enters(points_[c], points_[a], cell.low, cell.side);
        if (vertex == c) return !enters(points_[a], points_[b], cell.low, cell.side);
        return false;
    }

    /// Moves the largest such fan of the leaf to the end of its list; returns its size.
    std::size_t put_fan_last(const FacetCell& cell, std::size_t begin) {
        std::vector<VertexIndex> corners;
        for (std::size_t i = begin; i < stack_.size(); ++i)
            corners.insert(corners.end(), triangles_[stack_[i]].begin(), triangles_[stack_[i]].end());
        std::sort(corners.begin(), corners.end());
        VertexIndex commonest = corners[0];
        std::size_t most = 0;
        for (std::size_t i = 0; i < corners.size();) {
            std::size_t j = i;
            while (j < corners.size() && corners[j] == corners[i]) ++j;
            if (j - i > most) most = j - i, commonest = corners[i];
            i = j;
        }
        const auto first = stack_.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto fan = std::stable_partition(
            first, stack_.end(), [&](FaceIndex face) { return !has_no_end_inside(face, commonest, cell); });
        return static_cast<std::size_t>(stack_.end() - fan);
    }

    std::span<const Point> points_;
    std::span<const Triangle> triangles_;
    const LeafVisitor& visit_leaf_;
    std::vector<FaceIndex> stack_;
    std::vector<std::uint8_t> masks_;
};

struct Doubled {
    std::int64_t x, y, z;
    std::int64_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// Twice the vector from the cube's centre, so that half sides stay integers: |coordinate| < 2^28.
Doubled from_centre(Point p, const std::array<std::int32_t, 3>& low, std::int32_t side) {
    return {2 * (std::int64_t{p.x} - low[0]) - side, 2 * (std::int64_t{p.y} - low[1]) - side,
            2 * (std::int64_t{p.z} - low[2]) - side};
}

/// Do the values lie on one side of [−radius, radius]?
bool apart(std::int64_t a, std::int64_t b, std::int64_t radius) {
    return std::min(a, b) > radius || std::max(a, b) < -radius;
}

}  // namespace

std::vector<FacetList> split_into_parts(std::span<const Point> points, std::span<const Triangle> triangles,
                                        const Context& context) {
    std::vector<FacetList> parts(1);
    for (FaceIndex face = 0; face < triangles.size(); ++face) {
        const auto [a, b, c] = triangles[face];
        if (a != b && b != c && c != a) parts[0].faces.push_back(face);
    }
    // Level by level, the octants of a cell in its place.
    for (bool split = true; split && !context.cancelled();) {
        split = false;
        std::vector<FacetList> next;
        for (FacetList& part : parts) {
            if (part.faces.size() <= part_size || part.cell.stalled >= 2 || part.cell.side == 1) {
                next.push_back(std::move(part));
                continue;
            }
            split = true;
            std::array<FacetList, 8> octants;
            for (const FaceIndex face : part.faces)
                for (std::uint32_t rest = octants_of(corners_of(triangles[face], points), part.cell);
                     rest != 0; rest &= rest - 1)
                    octants[static_cast<std::size_t>(std::countr_zero(rest))].faces.push_back(face);
            for (std::size_t octant = 0; octant < 8; ++octant) {
                FacetList& list = octants[octant];
                list.cell = octant_of(part.cell, octant);
                list.cell.stalled =
                    list.faces.size() > part.faces.size() - part.faces.size() / 8 ? part.cell.stalled + 1 : 0;
                if (list.faces.size() > 1) next.push_back(std::move(list));
            }
        }
        parts = std::move(next);
    }
    return parts;
}

void for_each_leaf(const FacetList& part, std::span<const Point> points, std::span<const Triangle> triangles,
                   const LeafVisitor& visit) {
    LeafDescent(points, triangles, visit).run(part);
}

bool may_enter(const std::array<exact::Point, 3>& facet, const std::array<std::int32_t, 3>& low,
               std::int32_t side) {
    const std::array<Doubled, 3> p{from_centre(facet[0], low, side), from_centre(facet[1], low, side),
                                   from_centre(facet[2], low, side)};
    for (int axis = 0; axis < 3; ++axis)
        if (std::min({p[0][axis], p[1][axis], p[2][axis]}) > side ||
            std::max({p[0][axis], p[1][axis], p[2][axis]}) < -side)
            return false;
    // Cross products of the edges with the coordinate axes: 28 bits · 28 bits, two of them, fit int64.
    for (std::size_t i = 0; i < 3; ++i) {
        const Doubled a = p[i], b = p[(i + 1) % 3], c = p[(i + 2) % 3];
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const std::int64_t eu = b[u] - a[u], ev = b[v] - a[v];
            const std::int64_t radius = side * (std::abs(eu) + std::abs(ev));
            if (apart(eu * a[v] - ev * a[u], eu * c[v] - ev * c[u], radius)) return false;
        }
    }
    // The plane in doubles. Normal components are sums of two products below 2^57 each, their product with a
    // coordinate is below 2^86; the rounding of all steps together stays below 2^-49 of the sum of magnitudes.
    const Doubled e{p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z};
    const Doubled f{p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
    const auto nx = static_cast<double>(e.y * f.z - e.z * f.y);
    const auto ny = static_cast<double>(e.z * f.x - e.x * f.z);
    const auto nz = static_cast<double>(e.x * f.y - e.y * f.x);
    const double tx = nx * static_cast<double>(p[0].x), ty = ny * static_cast<double>(p[0].y),
                 tz = nz * static_cast<double>(p[0].z);
    const double radius = static_cast<double>(side) * (std::fabs(nx) + std::fabs(ny) + std::fabs(nz));
    const double error = 0x1p-49 * (std::fabs(tx) + std::fabs(ty) + std::fabs(tz) + radius);
    return std::fabs(tx + ty + tz) <= radius + error;
}

bool enters(exact::Point p, exact::Point q, const std::array<std::int32_t, 3>& low, std::int32_t side) {
    const Doubled a = from_centre(p, low, side), b = from_centre(q, low, side);
    for (int axis = 0; axis < 3; ++axis)
        if (apart(a[axis], b[axis], side)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const std::int64_t eu = b[u] - a[u], ev = b[v] - a[v];
        const std::int64_t radius = side * (std::abs(eu) + std::abs(ev));
        if (std::abs(eu * a[v] - ev * a[u]) > radius) return false;
    }
    return true;
}

}  // namespace octavo::mesh
