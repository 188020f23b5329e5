// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/rounding_faults.hpp>

namespace octavo::boolean {
namespace {

using exact::Sign;
using Triangle = mesh::Triangle;

/// Pairs of rounded triangles that are not flat.
class RoundedTriangles {
  public:
    explicit RoundedTriangles(const RoundedPoints& rounded) : rounded_(rounded) {}

    /// Whether two triangles have more in common than the corners and edges that they share.
    bool cross(const Triangle& a, const Triangle& b) const {
        std::size_t shared = 0, first = 0, second = 0, lone_a = 0, lone_b = 0;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                if (a[i] == b[j]) ++shared, first = i, second = j, lone_a += i, lone_b += j;
        if (shared == 3) return true;
        if (shared == 2) return folded(a, 3 - lone_a, b[3 - lone_b]);
        if (shared == 1)
            return meets(a[(first + 1) % 3], a[(first + 2) % 3], b) ||
                   meets(b[(second + 1) % 3], b[(second + 2) % 3], a);
        for (std::size_t k = 0; k < 3; ++k)
            if (meets(a[k], a[(k + 1) % 3], b) || meets(b[k], b[(k + 1) % 3], a)) return true;
        return false;
    }

  private:
    /// Whether `point` lies in the plane of `t` and on the same side of the edge opposite to corner k as that corner.
    bool folded(const Triangle& t, std::size_t k, PointId point) const {
        const auto &p = rounded_[t[(k + 1) % 3]], &q = rounded_[t[(k + 2) % 3]], &own = rounded_[t[k]],
                   &other = rounded_[point];
        if (orient3d(p, q, own, other) != Sign::zero) return false;
        for (int axis = 0; axis < 3; ++axis) {
            const Sign side = orient2d(axis, p, q, own);
            if (side != Sign::zero) return orient2d(axis, p, q, other) == side;
        }
        return false;
    }

    /// Whether the closed segment from p to q meets the closed triangle.
    bool meets(PointId from, PointId to, const Triangle& t) const {
        const auto &p = rounded_[from], &q = rounded_[to], &a = rounded_[t[0]], &b = rounded_[t[1]],
                   &c = rounded_[t[2]];
        const Sign at_p = orient3d(a, b, c, p), at_q = orient3d(a, b, c, q);
        if (at_p == at_q && at_p != Sign::zero) return false;
        if (at_p == Sign::zero && at_q == Sign::zero) return meets_in_plane(p, q, {&a, &b, &c});
        const Sign turns[3] = {orient3d(p, q, a, b), orient3d(p, q, b, c), orient3d(p, q, c, a)};
        bool positive = false, negative = false;
        for (const Sign turn : turns) {
            positive = positive || turn == Sign::positive;
            negative = negative || turn == Sign::negative;
        }
        return !(positive && negative);
    }

    using Corners = std::array<const RoundedPoints::Point*, 3>;

    /// All five points lie in one plane: neither the segment's line nor a side of the triangle separates them, nor do the
    /// segment's ends along the line.
    static bool meets_in_plane(const RoundedPoints::Point& p, const RoundedPoints::Point& q,
                               const Corners& corner) {
        int axis = 0;
        while (orient2d(axis, *corner[0], *corner[1], *corner[2]) == Sign::zero) ++axis;
        const Sign turn = orient2d(axis, *corner[0], *corner[1], *corner[2]);
        for (std::size_t k = 0; k < 3; ++k) {
            const auto &a = *corner[k], &b = *corner[(k + 1) % 3];
            if (orient2d(axis, a, b, p) == -turn && orient2d(axis, a, b, q) == -turn) return false;
        }
        std::size_t left = 0, right = 0;
        for (const auto* const point : corner) {
            const Sign side = orient2d(axis, p, q, *point);
            left += side == Sign::positive, right += side == Sign::negative;
        }
        return left != 3 && right != 3;
    }

    const RoundedPoints& rounded_;
};

bool has_moved(const Triangle& t, const RoundedPoints& rounded) {
    return rounded.is_moved(t[0]) || rounded.is_moved(t[1]) || rounded.is_moved(t[2]);
}

/// Some facets of the surface as a soup on the lattice.
struct NearSoup {
    Soup soup;
    std::vector<std::uint32_t> facet;  ///< of the surface
};

NearSoup near_soup(const Surface& surface, const std::vector<std::uint32_t>& facets,
                   const RoundedPoints& rounded) {
    NearSoup result;
    result.facet = facets;
    std::vector<std::uint32_t> number(rounded.size(), no_index);
    for (const std::uint32_t facet : facets) {
        Triangle corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const PointId point = surface.triangles[facet][k];
            if (number[point] == no_index) {
                number[point] = static_cast<std::uint32_t>(result.soup.points.size());
                result.soup.points.push_back(rounded.nearest(point));
            }
            corners[k] = number[point];
        }
        result.soup.facets.push_back(corners);
    }
    return result;
}

/// Adds the facets that are near one with a moved corner; sorted.
std::vector<std::uint32_t> with_neighbours(const Surface& surface, const std::vector<std::uint32_t>& moved,
                                           const RoundedPoints& rounded, const Context& context) {
    const NearSoup near = near_soup(surface, moved, rounded);
    std::vector<std::uint32_t> all(near.soup.facets.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    const BoxTree tree(near.soup, std::move(all), 2, context);
    constexpr std::size_t grain = 1 << 14;
    std::vector<std::vector<std::uint32_t>> parts(surface.triangles.size() / grain + 1);
    parallel_chunks(context, surface.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Triangle& t = surface.triangles[i];
            const exact::Point a = rounded.nearest(t[0]), b = rounded.nearest(t[1]),
                               c = rounded.nearest(t[2]);
            if (has_moved(t, rounded) ||
                tree.meets({std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
                           {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}))
                parts[begin / grain].push_back(static_cast<std::uint32_t>(i));
        }
    });
    std::vector<std::uint32_t> result;
    for (const auto& part : parts) result.insert(result.end(), part.begin(), part.end());
    return result;
}

bool is_inverted(const Surface& surface, std::uint32_t facet, const Soup& soup,
                 const RoundedPoints& rounded) {
    const Triangle& t = surface.triangles[facet];
    const exact::Plane plane = surface.plane(soup, facet);
    const int axis = plane.dominant_axis();
    return orient2d(axis, rounded[t[0]], rounded[t[1]], rounded[t[2]]) != exact::sign_of(plane.normal(axis));
}

}  // namespace

RoundingFaults find_rounding_faults(const Surface& surface, const Soup& soup, const RoundedPoints& rounded,
                                    const Context& context) {
    RoundingFaults faults;
    std::vector<std::uint32_t> moved;
    for (std::uint32_t i = 0; i < surface.triangles.size(); ++i) {
        if (!has_moved(surface.triangles[i], rounded)) continue;
        moved.push_back(i);
        if (is_inverted(surface, i, soup, rounded)) faults.inverted.push_back(i);
    }
    if (moved.empty()) return faults;
    const NearSoup near = near_soup(surface, with_neighbours(surface, moved, rounded, context), rounded);
    const auto is_bad = [&](std::uint32_t facet) {
        return std::binary_search(faults.inverted.begin(), faults.inverted.end(), facet);
    };
    // Corners went to the nearest lattice points, by less than one unit each.
    const FacetTree tree(near.soup, context, 2);
    const std::vector<FacetTree::Task> tasks = tree.pair_tasks(moved.size() < 2000 ? 1 : 256);
    std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> found(tasks.size());
    parallel_chunks(context, tasks.size(), 4, [&](std::size_t begin, std::size_t end) {
        const RoundedTriangles triangles(rounded);
        for (std::size_t task = begin; task < end; ++task)
            tree.for_each_pair(tasks[task], [&](std::uint32_t first, std::uint32_t second) {
                const auto [a, b] = std::minmax(near.facet[first], near.facet[second]);
                const Triangle &s = surface.triangles[a], &t = surface.triangles[b];
                if (!has_moved(s, rounded) && !has_moved(t, rounded)) return;
                if (is_bad(a) || is_bad(b)) return;
                if (triangles.cross(s, t)) found[task].push_back({a, b});
            });
    });
    for (const auto& part : found) faults.crossing.insert(faults.crossing.end(), part.begin(), part.end());
    std::sort(faults.crossing.begin(), faults.crossing.end());
    return faults;
}

}  // namespace octavo::boolean
