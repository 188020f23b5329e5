// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/exact/bit_budget.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/windings_beside.hpp>

namespace octavo::mesh {
namespace {

using exact::int128;
using exact::Plane;
using exact::Point;
using exact::wide;

// Three times the middle of a facet is a whole number of 28 bits, and so is its distance from three times a corner. The
// step is a normal.
static_assert(exact::budget::sum(3, exact::budget::normal + exact::coordinate_bits + 2) < 127,
              "value of a plane");
static_assert(exact::budget::sum(3, 2 * exact::budget::normal) < 127, "its derivative along the step");
static_assert(exact::budget::sum(2, 2 * exact::coordinate_bits + 2) < 63, "value of an edge");

/// Where a ray starts.
struct Start {
    std::array<std::int64_t, 3> thrice;  ///< three times the middle of the facet
    std::array<std::int64_t, 3> step;    ///< the direction of the first symbolic step
    std::uint32_t shell = 0;
};

struct FacetOnLattice {
    std::array<Point, 3> corner;
    Plane plane;
};

Plane plane_of(const std::array<Point, 3>& corner) { return Plane::through(corner[0], corner[1], corner[2]); }

std::array<Point, 3> corners_of(std::span<const Point> points, const Triangle& t) {
    return {points[t[0]], points[t[1]], points[t[2]]};
}

Start start_of(const std::array<Point, 3>& corner, bool behind, std::uint32_t shell) {
    const Plane plane = plane_of(corner);
    Start start;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        start.thrice[i] = std::int64_t{corner[0][axis]} + corner[1][axis] + corner[2][axis];
        start.step[i] = behind ? -plane.normal(axis) : plane.normal(axis);
    }
    start.shell = shell;
    return start;
}

template <class Number>
int sign(Number number) {
    return static_cast<int>(exact::sign_of(number));
}

/// On which side of the facet's plane the moved start lies; the plane must not be parallel to the ray.
int side_of(const FacetOnLattice& facet, const Start& start) {
    int128 value = 0, along = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const int128 normal = wide(facet.plane.normal(axis));
        value += normal * (start.thrice[i] - 3 * std::int64_t{facet.corner[0][axis]});
        along += normal * start.step[i];
    }
    if (value != 0) return sign(value);
    if (along != 0) return sign(along);
    return -sign(facet.plane.a());
}

/// On which side of the edge from p to q the moved start lies, seen along x.
int side_of(Point p, Point q, const Start& start) {
    const std::int64_t y = q.y - p.y, z = q.z - p.z;
    const std::int64_t value =
        y * (start.thrice[2] - 3 * std::int64_t{p.z}) - z * (start.thrice[1] - 3 * std::int64_t{p.y});
    if (value != 0) return sign(value);
    const int128 along = wide(y) * start.step[2] - wide(z) * start.step[1];
    if (along != 0) return sign(along);
    return z != 0 ? -sign(z) : sign(y);
}

/// The change of the winding number where the ray to the left leaves through the facet: 1, or −1 where it enters; 0
/// when it misses it. The start is known to lie in the facet's box, but for being right of it.
int crossing_to_the_left(const FacetOnLattice& facet, const Start& start) {
    const int outward = sign(facet.plane.a());
    if (outward == 0 || side_of(facet, start) != outward) return 0;
    for (std::size_t i = 0; i < 3; ++i)
        if (side_of(facet.corner[i], facet.corner[(i + 1) % 3], start) != outward) return 0;
    return -outward;
}

/// The starts by their y and z, for facets to find those that they may cover.
class StartGrid {
  public:
    explicit StartGrid(std::span<const Start> starts) : starts_(starts) {
        const auto side = static_cast<std::int32_t>(std::sqrt(static_cast<double>(starts.size())));
        cells_ = std::clamp(side, 1, 1024);
        width_ = exact::universe_side / cells_ + 1;
        begin_.assign(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_) + 2, 0);
        for (const Start& start : starts) ++begin_[cell_of(start) + 2];
        for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        members_.resize(starts.size());
        for (std::uint32_t i = 0; i < starts.size(); ++i) members_[begin_[cell_of(starts[i]) + 1]++] = i;
        begin_.pop_back();
    }

    /// Calls visit(number of the start) for those in the box, and maybe others.
    template <class Visit>
    void for_each_in(std::int32_t y0, std::int32_t y1, std::int32_t z0, std::int32_t z1,
                     const Visit& visit) const {
        for (std::int32_t row = z0 / width_; row <= z1 / width_; ++row) {
            const std::size_t first = begin_[cell(y0 / width_, row)],
                              last = begin_[cell(y1 / width_, row) + 1];
            for (std::size_t i = first; i < last; ++i) visit(members_[i]);
        }
    }

  private:
    std::size_t cell(std::int32_t column, std::int32_t row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_) +
               static_cast<std::size_t>(column);
    }
    std::size_t cell_of(const Start& start) const {
        return cell(static_cast<std::int32_t>(start.thrice[1] / 3) / width_,
                    static_cast<std::int32_t>(start.thrice[2] / 3) / width_);
    }

    std::span<const Start> starts_;
    std::int32_t cells_ = 1, width_ = 1;
    std::vector<std::uint32_t> begin_, members_;
};

/// Adds up what is said of the same place and shell.
void add_up(std::vector<PlaceWinding>& windings) {
    std::sort(windings.begin(), windings.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < windings.size();) {
        PlaceWinding sum{windings[i].place, windings[i].shell, 0};
        for (; i < windings.size() && windings[i].place == sum.place && windings[i].shell == sum.shell; ++i)
            sum.winding += windings[i].winding;
        if (sum.winding != 0) windings[kept++] = sum;
    }
    windings.resize(kept);
}

}  // namespace

std::vector<PlaceWinding> windings_beside(std::span<const Point> points, std::span<const Triangle> triangles,
                                          std::span<const std::uint32_t> shell_of_face,
                                          std::span<const PlaceBeside> places, Winders winders) {
    std::vector<PlaceWinding> windings;
    if (places.empty()) return windings;
    std::vector<Start> starts;
    starts.reserve(places.size());
    for (const PlaceBeside& place : places)
        starts.push_back(
            start_of(corners_of(points, triangles[place.face]), place.behind, shell_of_face[place.face]));
    const StartGrid grid(starts);
    FacetOnLattice facet;
    for (FaceIndex face = 0; face < triangles.size(); ++face) {
        const std::uint32_t shell = shell_of_face[face];
        if (shell == no_index) continue;
        facet.corner = corners_of(points, triangles[face]);
        const auto [a, b, c] = facet.corner;
        const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
        const auto [z0, z1] = std::minmax({a.z, b.z, c.z});
        const std::int64_t x0 = std::min({a.x, b.x, c.x});
        const std::array<std::int64_t, 4> thrice{3 * std::int64_t{y0}, 3 * std::int64_t{y1},
                                                 3 * std::int64_t{z0}, 3 * std::int64_t{z1}};
        bool has_plane = false;
        grid.for_each_in(y0, y1, z0, z1, [&](std::uint32_t number) {
            const Start& start = starts[number];
            const auto& [x, y, z] = start.thrice;
            if ((start.shell == shell) != (winders == Winders::own)) return;
            if (x < 3 * x0 || y < thrice[0] || y > thrice[1] || z < thrice[2] || z > thrice[3]) return;
            if (!has_plane) facet.plane = plane_of(facet.corner), has_plane = true;
            const int crossing = crossing_to_the_left(facet, start);
            if (crossing != 0) windings.push_back({number, shell, crossing});
        });
    }
    add_up(windings);
    return windings;
}

}  // namespace octavo::mesh
