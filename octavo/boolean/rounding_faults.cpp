// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/rounding_faults.hpp>

namespace octavo::boolean {
namespace {

using exact::Sign;
using Triangle = mesh::Triangle;

bool has_moved(const Triangle& t, const RoundedPoints& rounded) {
    return rounded.is_moved(t[0]) || rounded.is_moved(t[1]) || rounded.is_moved(t[2]);
}

bool is_inverted(const Surface& surface, std::uint32_t facet, const Soup& soup,
                 const RoundedPoints& rounded) {
    const Triangle& t = surface.triangles[facet];
    const exact::Plane plane = surface.plane(soup, facet);
    const int axis = plane.dominant_axis();
    return orient2d(axis, rounded[t[0]], rounded[t[1]], rounded[t[2]]) != exact::sign_of(plane.normal(axis));
}

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
        if (apart(a, b) || apart(b, a)) return false;
        for (int axis = 0; axis < 3; ++axis)
            if (seen_apart(axis, a, b) || seen_apart(axis, b, a)) return false;
        if (shared == 2) return folded(a, 3 - lone_a, b[3 - lone_b]);
        if (shared == 1)
            return meets(a[(first + 1) % 3], a[(first + 2) % 3], b) ||
                   meets(b[(second + 1) % 3], b[(second + 2) % 3], a);
        for (std::size_t k = 0; k < 3; ++k)
            if (meets(a[k], a[(k + 1) % 3], b) || meets(b[k], b[(k + 1) % 3], a)) return true;
        return false;
    }

  private:
    /// Whether all corners of `b`, those shared aside, lie on one side of the plane of `a`.
    bool apart(const Triangle& a, const Triangle& b) const {
        const RoundedPoints::Point p = rounded_[a[0]], q = rounded_[a[1]], r = rounded_[a[2]];
        Sign all = Sign::zero;
        for (const PointId corner : b) {
            if (corner == a[0] || corner == a[1] || corner == a[2]) continue;
            const Sign side = orient3d(p, q, r, rounded_[corner]);
            if (side == Sign::zero || side == -all) return false;
            all = side;
        }
        return true;
    }

    /// Whether, seen along an axis, an edge of `a` has all corners of `b` that do not end it on its outer side.
    bool seen_apart(int axis, const Triangle& a, const Triangle& b) const {
        const std::array<RoundedPoints::Point, 3> at{rounded_[a[0]], rounded_[a[1]], rounded_[a[2]]};
        const Sign turn = orient2d(axis, at[0], at[1], at[2]);
        if (turn == Sign::zero) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t next = (k + 1) % 3;
            const bool parting = std::all_of(b.begin(), b.end(), [&](PointId corner) {
                return corner == a[k] || corner == a[next] ||
                       orient2d(axis, at[k], at[next], rounded_[corner]) == -turn;
            });
            if (parting) return true;
        }
        return false;
    }

    /// Whether `point` lies in the plane of `t` and on the same side of the edge opposite to corner k as that corner.
    bool folded(const Triangle& t, std::size_t k, PointId point) const {
        const RoundedPoints::Point p = rounded_[t[(k + 1) % 3]], q = rounded_[t[(k + 2) % 3]],
                                   own = rounded_[t[k]], other = rounded_[point];
        if (orient3d(p, q, own, other) != Sign::zero) return false;
        for (int axis = 0; axis < 3; ++axis) {
            const Sign side = orient2d(axis, p, q, own);
            if (side != Sign::zero) return orient2d(axis, p, q, other) == side;
        }
        return false;
    }

    /// Whether the closed segment from p to q meets the closed triangle.
    bool meets(PointId from, PointId to, const Triangle& t) const {
        const RoundedPoints::Point p = rounded_[from], q = rounded_[to], a = rounded_[t[0]],
                                   b = rounded_[t[1]], c = rounded_[t[2]];
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

    /// All five points lie in one plane: neither the segment's line nor a side of the triangle separates them, nor do
    /// the segment's ends along the line.
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

/// Finds faults, all of them or those about one point.
class FaultSearch {
  public:
    using Crossing = std::pair<std::uint32_t, std::uint32_t>;

    FaultSearch(const Surface& surface, const Soup& soup, const NearFacets& near,
                const RoundedPoints& rounded)
        : surface_(surface), soup_(soup), near_(near), rounded_(rounded), triangles_(rounded) {}

    RoundingFaults all(const Context& context) const {
        RoundingFaults faults;
        faults.inverted = find_inverted(surface_, soup_, rounded_, context);
        // A pair of two fans of slivers may be a third of the work: those of many parts are dealt out afterwards.
        struct Part {
            NearFacets::Work work;
            std::uint32_t begin, end;
        };
        constexpr std::uint32_t at_once = 32;
        constexpr std::size_t grain = 64;
        const std::size_t chunks = near_.pairs().size() / grain + 1;
        std::vector<std::vector<Crossing>> found(chunks);
        std::vector<std::vector<Part>> later(chunks);
        const auto search = [&](const Part& part, std::vector<Crossing>& crossing) {
            near_.for_each(part.work, part.begin, part.end, [&](std::uint32_t a, std::uint32_t b) {
                const auto is_bad = [&](std::uint32_t facet) {
                    return std::binary_search(faults.inverted.begin(), faults.inverted.end(), facet);
                };
                if (!is_bad(a) && !is_bad(b) && crosses(a, b)) crossing.push_back(std::minmax(a, b));
            });
        };
        parallel_chunks(context, near_.pairs().size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const NearFacets::Work work = near_.work(near_.pairs()[i]);
                if (work.parts() <= at_once)
                    search({work, 0, work.parts()}, found[begin / grain]);
                else
                    for (std::uint32_t part = 0; part < work.parts(); part += at_once)
                        later[begin / grain].push_back({work, part, std::min(part + at_once, work.parts())});
            }
        });
        std::vector<Part> large;
        for (const auto& part : later) large.insert(large.end(), part.begin(), part.end());
        found.resize(chunks + large.size());
        parallel_chunks(context, large.size(), 1,
                        [&](std::size_t i, std::size_t) { search(large[i], found[chunks + i]); });
        for (const auto& part : found)
            faults.crossing.insert(faults.crossing.end(), part.begin(), part.end());
        std::sort(faults.crossing.begin(), faults.crossing.end());
        return faults;
    }

    /// Of two triangles that are not inverted.
    bool crosses(std::uint32_t a, std::uint32_t b) const {
        const Triangle &s = surface_.triangles[a], &t = surface_.triangles[b];
        if (!has_moved(s, rounded_) && !has_moved(t, rounded_)) return false;
        // On different sides of an edge that they share, seen along their normal.
        if (surface_.facets[a].soup_facet == surface_.facets[b].soup_facet && shared_corners(s, t) == 2)
            return false;
        return triangles_.cross(s, t);
    }

    bool inverted(std::uint32_t facet) const { return is_inverted(surface_, facet, soup_, rounded_); }

  private:
    static int shared_corners(const Triangle& s, const Triangle& t) {
        int shared = 0;
        for (const PointId corner : s) shared += corner == t[0] || corner == t[1] || corner == t[2];
        return shared;
    }

    const Surface& surface_;
    const Soup& soup_;
    const NearFacets& near_;
    const RoundedPoints& rounded_;
    RoundedTriangles triangles_;
};

/// Takes points of facets at fault to other places nearby.
class Mending {
  public:
    Mending(const Surface& surface, const NearFacets& near, RoundedPoints& rounded, const FaultSearch& search)
        : surface_(surface), near_(near), rounded_(rounded), search_(search) {}

    void run(const RoundingFaults& faults, const Context& context) {
        find_points(faults);
        constexpr int most_rounds = 4;
        for (int round = 0; round < most_rounds; ++round) {
            bool any = false;
            for (std::size_t i = 0; i < points_.size() && !context.cancelled(); ++i)
                if (improve(i)) any = true;
            if (!any) break;
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            const RoundedPoints::Point end = rounded_[points_[i]];
            if (end == nearest_[i]) continue;
            ++moved_points;
            for (std::size_t axis = 0; axis < 3; ++axis)
                farthest_move = std::max(farthest_move, std::abs(end[axis] - nearest_[i][axis]));
        }
    }

    std::size_t moved_points = 0;
    std::int64_t farthest_move = 0;  ///< of a coordinate, as in RoundedPoints::Point

  private:
    void find_points(const RoundingFaults& faults) {
        const auto add = [&](std::uint32_t facet) {
            for (const PointId corner : surface_.triangles[facet])
                if (rounded_.is_moved(corner)) points_.push_back(corner);
        };
        for (const std::uint32_t facet : faults.inverted) add(facet);
        for (const auto& [first, second] : faults.crossing) add(first), add(second);
        std::sort(points_.begin(), points_.end());
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
        for (const PointId point : points_) {
            nearest_.push_back(rounded_[point]);
            spacing_.push_back(
                {rounded_.spacing(0, point), rounded_.spacing(1, point), rounded_.spacing(2, point)});
        }
        stars_.resize(points_.size());
        for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i)
            for (const PointId corner : surface_.triangles[i]) {
                const auto at = std::lower_bound(points_.begin(), points_.end(), corner);
                if (at != points_.end() && *at == corner)
                    stars_[static_cast<std::size_t>(at - points_.begin())].push_back(i);
            }
        const auto& pairs = near_.pairs();
        for (std::uint32_t i = 0; i < pairs.size(); ++i) {
            pairs_of_.push_back({pairs[i].first, i});
            if (pairs[i].first != pairs[i].second) pairs_of_.push_back({pairs[i].second, i});
        }
        std::sort(pairs_of_.begin(), pairs_of_.end());
    }

    /// The pairs of triangles that may be at fault about a point.
    std::vector<FaultSearch::Crossing> pairs_about(const std::vector<std::uint32_t>& star) const {
        std::vector<FaultSearch::Crossing> result;
        std::vector<std::uint32_t> seen;
        for (const std::uint32_t triangle : star) {
            const std::uint32_t facet = surface_.facets[triangle].soup_facet;
            for (auto at = std::lower_bound(pairs_of_.begin(), pairs_of_.end(), std::pair{facet, 0u});
                 at != pairs_of_.end() && at->first == facet; ++at)
                seen.push_back(at->second);
        }
        std::sort(seen.begin(), seen.end());
        seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
        const auto in_star = [&](std::uint32_t triangle) {
            return std::binary_search(star.begin(), star.end(), triangle);
        };
        for (const std::uint32_t pair : seen)
            near_.for_each(near_.pairs()[pair], [&](std::uint32_t a, std::uint32_t b) {
                if (in_star(a) || in_star(b)) result.push_back({a, b});
            });
        return result;
    }

    std::size_t faults_about(const std::vector<std::uint32_t>& star,
                             const std::vector<FaultSearch::Crossing>& pairs) const {
        std::size_t count = 0;
        for (const std::uint32_t triangle : star) count += search_.inverted(triangle);
        for (const auto& [a, b] : pairs)
            count += !search_.inverted(a) && !search_.inverted(b) && search_.crosses(a, b);
        return count;
    }

    /// Tries the nearest place and those about it; whether it has found a better one. None is farther from the exact
    /// point than near_pairs.hpp allows for.
    bool improve(std::size_t number) {
        const PointId id = points_[number];
        const std::vector<std::uint32_t>& star = stars_[number];
        const auto pairs = pairs_about(star);
        std::size_t least = faults_about(star, pairs);
        if (least == 0) return false;
        const RoundedPoints::Point start = rounded_[id];
        RoundedPoints::Point best = start;
        for (int place = 0; place < 27; ++place) {
            RoundedPoints::Point to = start;
            for (int axis = 0, rest = place; axis < 3; ++axis, rest /= 3)
                to[static_cast<std::size_t>(axis)] =
                    nearest_[number][static_cast<std::size_t>(axis)] +
                    (rest % 3 - 1) * spacing_[number][static_cast<std::size_t>(axis)];
            rounded_.move(id, to);
            const std::size_t count = faults_about(star, pairs);
            rounded_.move(id, start);
            if (count < least) least = count, best = to;
        }
        rounded_.move(id, best);
        return best != start;
    }

    const Surface& surface_;
    const NearFacets& near_;
    RoundedPoints& rounded_;
    const FaultSearch& search_;
    std::vector<PointId> points_;
    std::vector<RoundedPoints::Point> nearest_, spacing_;  ///< where each point was, and steps from there
    std::vector<std::vector<std::uint32_t>> stars_;        ///< triangles about each point
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_of_;  ///< facet and pair, sorted
};

}  // namespace

std::vector<std::uint32_t> find_inverted(const Surface& surface, const Soup& soup,
                                         const RoundedPoints& rounded, const Context& context) {
    constexpr std::size_t grain = 1 << 12;
    const std::size_t first = rounded.moves_vertices() ? 0 : surface.first_piece(),
                      count = surface.triangles.size() - first;
    std::vector<std::vector<std::uint32_t>> found(count / grain + 1);
    parallel_chunks(context, count, grain, [&](std::size_t begin, std::size_t end) {
        for (auto i = static_cast<std::uint32_t>(first + begin); i < first + end; ++i)
            if (has_moved(surface.triangles[i], rounded) && is_inverted(surface, i, soup, rounded))
                found[begin / grain].push_back(i);
    });
    std::vector<std::uint32_t> inverted;
    for (const auto& part : found) inverted.insert(inverted.end(), part.begin(), part.end());
    return inverted;
}

RoundingFaults mend_rounding(const Surface& surface, const Soup& soup, std::span<const NearFacets::Pair> near,
                             RoundedPoints& rounded, const Context& context) {
    const NearFacets near_facets(surface, soup, near, rounded, context);
    const FaultSearch search(surface, soup, near_facets, rounded);
    RoundingFaults faults = search.all(context);
    if (faults.empty() || context.cancelled()) return faults;
    Mending mending(surface, near_facets, rounded, search);
    mending.run(faults, context);
    if (mending.moved_points == 0) return faults;
    faults = search.all(context);
    faults.moved_points = mending.moved_points;
    faults.farthest_move =
        std::ldexp(static_cast<double>(mending.farthest_move), -RoundedPoints::fraction_bits);
    return faults;
}

}  // namespace octavo::boolean
