// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/boolean/subdivision.hpp>
#include <octavo/bsp_octree/fill.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::no_index;
using boolean::PointId;
using boolean::PointTable;
using boolean::Subdivision;
using boolean::Surface;

/// A point in the middle of a segment.
struct Touch {
    PointId low, high;  ///< ends of the segment
    PointId middle;
    friend auto operator<=>(const Touch&, const Touch&) = default;
};

class PlaneFiller {
  public:
    PlaneFiller(const bsp::PlaneTable& planes, const PointTable& points)
        : planes_(planes), points_(points), subdivision_(points) {}

    /// Appends the triangles between the borders of one plane and facing, and the points that cut borders.
    void fill(std::span<const Segment> borders, Surface& surface, std::vector<Touch>& touches) {
        const bsp::Facing facing = borders[0].facing;
        if (borders.size() == 3 && is_triangle(borders)) {
            const Segment& s = borders[0];
            const PointId third = borders[1].from == s.to ? borders[1].to : borders[2].to;
            return add(facing, {s.from, s.to, third}, surface);
        }
        begin(borders);
        corners_.clear();
        for (const Segment& s : borders) corners_.push_back({s.from, Subdivision::no_line});
        subdivision_.add_points(corners_);
        constexpr std::uint32_t border = 0, slit = 1;
        for (const Segment& s : borders) {
            // What the faces have on both sides does not lead out of them.
            const bool both =
                std::binary_search(borders.begin(), borders.end(), Segment{facing, s.to, s.from});
            subdivision_.add_segment(subdivision_.vertex_of(s.from), subdivision_.vertex_of(s.to),
                                     Subdivision::no_line, both ? slit : border);
        }
        subdivision_.refine();
        flood(border);
        rim_.clear();
        const auto all = subdivision_.triangles();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (state_[i] != inside) continue;
            const PointId corner[3] = {subdivision_.point_of(all[i].v[0]), subdivision_.point_of(all[i].v[1]),
                                       subdivision_.point_of(all[i].v[2])};
            for (int k = 0; k < 3; ++k)
                if (all[i].owner[k]) rim_.push_back({facing, corner[k], corner[(k + 1) % 3]});
            add(facing, {corner[0], corner[1], corner[2]}, surface);
        }
        find_touches(borders, touches);
    }

  private:
    static bool is_triangle(std::span<const Segment> borders) {
        // Three segments each with one follower; two of them cannot be a ring.
        return std::all_of(borders.begin(), borders.end(), [&](const Segment& s) {
            return std::count_if(borders.begin(), borders.end(),
                                 [&](const Segment& next) { return next.from == s.to; }) == 1;
        });
    }

    /// A triangle around all border points, seen along the plane's dominant axis.
    void begin(std::span<const Segment> borders) {
        const exact::Plane& plane = planes_[borders[0].facing.plane()];
        const int axis = plane.dominant_axis(), i = (axis + 1) % 3, j = (axis + 2) % 3;
        double low[2] = {Box3::infinity, Box3::infinity}, high[2] = {-Box3::infinity, -Box3::infinity};
        for (const Segment& s : borders) {
            const Vec3 p = points_.approximation(s.from);
            low[0] = std::min(low[0], p[i]), high[0] = std::max(high[0], p[i]);
            low[1] = std::min(low[1], p[j]), high[1] = std::max(high[1], p[j]);
        }
        const auto x = static_cast<std::int32_t>(std::floor(low[0])) - 1,
                   y = static_cast<std::int32_t>(std::floor(low[1])) - 1;
        const auto reach = static_cast<std::int32_t>(std::ceil((high[0] - low[0]) + (high[1] - low[1]))) + 8;
        const auto at = [axis](std::int32_t u, std::int32_t v) {
            return axis == 0   ? exact::Point{0, u, v}
                   : axis == 1 ? exact::Point{v, 0, u}
                               : exact::Point{u, v, 0};
        };
        const exact::Point a = at(x, y), b = at(x + reach, y), c = at(x, y + reach);
        const bool up = plane.normal(axis) > 0;
        const PointId ids[3] = {no_index, no_index, no_index};
        const exact::Point corners[3] = {a, up ? b : c, up ? c : b};
        subdivision_.begin(plane, corners, ids);
    }

    /// From the outside inwards, turning at every border.
    void flood(std::uint32_t border) {
        const auto all = subdivision_.triangles();
        state_.assign(all.size(), unknown);
        std::uint32_t outer = 0;
        const auto is_outer = [&](const Subdivision::Triangle& t) {
            return std::any_of(t.v, t.v + 3,
                               [&](std::uint32_t v) { return subdivision_.point_of(v) == no_index; });
        };
        while (!is_outer(all[outer])) ++outer;
        state_[outer] = outside;
        stack_.assign(1, outer);
        while (!stack_.empty()) {
            const std::uint32_t at = stack_.back();
            stack_.pop_back();
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t next = all[at].neighbour[k];
                if (next == no_index || state_[next] != unknown) continue;
                const std::uint32_t owner = all[at].owner[k];
                const bool crossed = owner && subdivision_.owner(owner - 1).tag == border;
                state_[next] = crossed ? (state_[at] == inside ? outside : inside) : state_[at];
                stack_.push_back(next);
            }
        }
    }

    /// Borders that are no edge of the triangles are chains of edges.
    void find_touches(std::span<const Segment> borders, std::vector<Touch>& touches) {
        std::sort(rim_.begin(), rim_.end());
        const int axis = planes_[borders[0].facing.plane()].dominant_axis();
        for (const Segment& s : borders) {
            if (std::binary_search(rim_.begin(), rim_.end(), s)) continue;
            for (PointId at = s.from; at != s.to;) {
                auto next = std::lower_bound(rim_.begin(), rim_.end(), Segment{s.facing, at, 0});
                while (next != rim_.end() && next->from == at && next->to != s.to &&
                       !points_.is_between(axis, at, next->to, s.to))
                    ++next;
                OCTAVO_CHECK(next != rim_.end() && next->from == at, "a border is no chain of edges");
                at = next->to;
                if (at != s.to) touches.push_back({std::min(s.from, s.to), std::max(s.from, s.to), at});
            }
        }
    }

    void add(bsp::Facing facing, mesh::Triangle triangle, Surface& surface) const {
        if (facing.reversed()) std::swap(triangle[1], triangle[2]);
        surface.triangles.push_back(triangle);
        surface.facets.push_back({facing.plane() & 0x3fffffffu, facing.reversed() ? 1U : 0U, 1U});
    }

    static constexpr char unknown = 0, outside = 1, inside = 2;
    const bsp::PlaneTable& planes_;
    const PointTable& points_;
    Subdivision subdivision_;
    std::vector<char> state_;
    std::vector<std::uint32_t> stack_;
    std::vector<Subdivision::PointOnLine> corners_;
    std::vector<Segment> rim_;  ///< edges of triangles inside, on borders
};

/// Cuts the segments that are touched, in all planes.
void cut_at(const PointTable& points, std::vector<Touch> touches, std::vector<Segment>& borders) {
    std::sort(touches.begin(), touches.end());
    touches.erase(std::unique(touches.begin(), touches.end()), touches.end());
    std::vector<Segment> cut;
    std::vector<PointId> chain;
    for (const Segment& s : borders) {
        const PointId low = std::min(s.from, s.to), high = std::max(s.from, s.to);
        chain.assign({s.from, s.to});
        for (auto touch = std::lower_bound(touches.begin(), touches.end(), Touch{low, high, 0});
             touch != touches.end() && touch->low == low && touch->high == high; ++touch)
            chain.push_back(touch->middle);
        int axis = 0;
        while (points.compare_coordinate(axis, s.from, s.to) == exact::Sign::zero) ++axis;
        const exact::Sign forward = points.compare_coordinate(axis, s.from, s.to);
        std::sort(chain.begin(), chain.end(),
                  [&](PointId a, PointId b) { return points.compare_coordinate(axis, a, b) == forward; });
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) cut.push_back({s.facing, chain[i], chain[i + 1]});
    }
    std::sort(cut.begin(), cut.end());
    borders = std::move(cut);
}

}  // namespace

boolean::Surface fill_borders(std::vector<Segment>& borders, const bsp::PlaneTable& planes,
                              const PointTable& points) {
    PlaneFiller filler(planes, points);
    while (true) {
        Surface surface;
        std::vector<Touch> touches;
        for (std::size_t i = 0, end; i < borders.size(); i = end) {
            for (end = i; end < borders.size() && borders[end].facing == borders[i].facing;) ++end;
            filler.fill({borders.data() + i, end - i}, surface, touches);
        }
        if (touches.empty()) return surface;
        cut_at(points, std::move(touches), borders);
    }
}

}  // namespace octavo::bsp_octree
