// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>

#include <octavo/bsp_octree/borders.hpp>
#include <octavo/bsp_octree/line_key.hpp>
#include <octavo/exact/compare.hpp>
#include <octavo/exact/intersect.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::PointId;
using boolean::PointTable;
using bsp::Facing;
using exact::Sign;

/// Removes segments of one facing that run opposite ways.
void cancel_opposite(std::vector<BoundedSegment>& edges) {
    const auto ends = [](const Segment& s) {
        return std::pair(std::min(s.from, s.to), std::max(s.from, s.to));
    };
    std::sort(edges.begin(), edges.end(), [&](const BoundedSegment& a, const BoundedSegment& b) {
        if (a.segment.facing != b.segment.facing) return a.segment.facing < b.segment.facing;
        if (ends(a.segment) != ends(b.segment)) return ends(a.segment) < ends(b.segment);
        return a.segment.from < b.segment.from;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        std::ptrdiff_t balance = 0;  // of those that run upwards
        const auto [low, high] = ends(edges[i].segment);
        std::size_t up = i, down = i;
        for (end = i; end < edges.size() && edges[end].segment.facing == edges[i].segment.facing &&
                      ends(edges[end].segment) == std::pair{low, high};
             ++end) {
            const bool upwards = edges[end].segment.from == low;
            balance += upwards ? 1 : -1;
            (upwards ? up : down) = end;
        }
        const BoundedSegment left = edges[balance > 0 ? up : down];
        for (; balance != 0; balance += balance > 0 ? -1 : 1) edges[kept++] = left;
    }
    edges.resize(kept);
}

/// The segments on one line, added up.
class LineSum {
  public:
    explicit LineSum(const PointTable& points) : points_(points) {}

    /// `members` index `edges`; all lie on the line of the two planes.
    void add(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
             const exact::LineOrder& order, std::vector<Segment>& borders) {
        sort_ends(edges, members, order);
        cover(edges, members);
        // Runs of intervals that agree become one segment.
        for (std::size_t i = 0, end; i < covers_.size(); i = end) {
            const std::size_t count = interval_end(i);
            end = count;
            while (end < covers_.size() && continues(i, count, end)) end = interval_end(end);
            const PointId from = ends_[covers_[i].interval], to = ends_[covers_[end - 1].interval + 1];
            for (std::size_t k = i; k < count; ++k)
                for (std::int32_t n = covers_[k].net; n != 0; n += n > 0 ? -1 : 1)
                    borders.push_back({covers_[k].facing, n > 0 ? from : to, n > 0 ? to : from});
        }
    }

  private:
    /// How often a facing runs along an interval between ends, more often one way than the other.
    struct Cover {
        std::uint32_t interval;
        Facing facing;
        std::int32_t net;
    };

    void sort_ends(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
                   const exact::LineOrder& order) {
        ends_.clear();
        for (const std::uint32_t member : members)
            ends_.push_back(edges[member].segment.from), ends_.push_back(edges[member].segment.to);
        std::sort(ends_.begin(), ends_.end());
        ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
        by_id_ = ends_;
        std::sort(ends_.begin(), ends_.end(), [&](PointId a, PointId b) {
            return points_.compare_coordinate(order.axis, a, b) == Sign::negative;
        });
        // The place along the line of each end, by id.
        place_.resize(ends_.size());
        for (std::uint32_t i = 0; i < ends_.size(); ++i) place_[number_of(ends_[i])] = i;
    }

    std::size_t number_of(PointId id) const {
        return static_cast<std::size_t>(std::lower_bound(by_id_.begin(), by_id_.end(), id) - by_id_.begin());
    }

    void cover(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members) {
        all_.clear(), covers_.clear();
        for (const std::uint32_t member : members) {
            const Segment& s = edges[member].segment;
            std::uint32_t from = place_[number_of(s.from)], to = place_[number_of(s.to)];
            const std::int32_t direction = from < to ? 1 : -1;
            if (from > to) std::swap(from, to);
            for (; from < to; ++from) all_.push_back({from, s.facing, direction});
        }
        std::sort(all_.begin(), all_.end(), [](const Cover& a, const Cover& b) {
            return a.interval != b.interval ? a.interval < b.interval : a.facing < b.facing;
        });
        for (std::size_t i = 0, end; i < all_.size(); i = end) {
            std::int32_t net = 0;
            for (end = i; end < all_.size() && all_[end].interval == all_[i].interval &&
                          all_[end].facing == all_[i].facing;
                 ++end)
                net += all_[end].net;
            if (net != 0) covers_.push_back({all_[i].interval, all_[i].facing, net});
        }
    }

    std::size_t interval_end(std::size_t i) const {
        std::size_t end = i;
        while (end < covers_.size() && covers_[end].interval == covers_[i].interval) ++end;
        return end;
    }

    /// Whether the interval that starts at `next` is covered like that at `first` and follows the run before it.
    bool continues(std::size_t first, std::size_t first_end, std::size_t next) const {
        const std::size_t count = first_end - first;
        if (interval_end(next) - next != count || covers_[next].interval != covers_[next - 1].interval + 1)
            return false;
        for (std::size_t k = 0; k < count; ++k)
            if (covers_[first + k].facing != covers_[next + k].facing ||
                covers_[first + k].net != covers_[next + k].net)
                return false;
        return true;
    }

    const PointTable& points_;
    std::vector<PointId> ends_, by_id_;
    std::vector<std::uint32_t> place_;
    std::vector<Cover> all_, covers_;
};

bool lies_on(const PointTable& points, PointId point, const exact::Plane& plane) {
    return points.with(point, [&](const auto& p) { return exact::side_of(plane, p) == Sign::zero; });
}

/// At every point, as many segments of a facing end as start; and on every segment, the solid is on one side of as
/// many faces as it is on the other side of.
bool closes(const std::vector<Segment>& borders) {
    using Run = std::pair<std::uint32_t, std::uint32_t>;
    const auto are_equal = [](std::vector<Run> first, std::vector<Run> second) {
        std::sort(first.begin(), first.end()), std::sort(second.begin(), second.end());
        return first == second;
    };
    std::vector<Run> starts, ends, along, against;
    for (const Segment& s : borders) {
        starts.push_back({s.facing.bits, s.from});
        ends.push_back({s.facing.bits, s.to});
        along.push_back(s.facing.reversed() ? Run{s.to, s.from} : Run{s.from, s.to});
        against.push_back({along.back().second, along.back().first});
    }
    return are_equal(std::move(starts), std::move(ends)) && are_equal(std::move(along), std::move(against));
}

}  // namespace

bool sum_borders(std::vector<BoundedSegment> edges, const bsp::FragmentPool& planes, const PointTable& points,
                 int attempt, std::vector<Segment>& borders) {
    cancel_opposite(edges);
    std::vector<PlanePair> lines;
    lines.reserve(edges.size());
    for (const BoundedSegment& edge : edges)
        lines.push_back({planes.planes()[edge.segment.facing.plane()], planes.plane_of(edge.bound)});
    const std::vector<std::uint64_t> keys = line_keys(lines, attempt);
    std::vector<std::uint32_t> by_line(edges.size());
    std::iota(by_line.begin(), by_line.end(), 0U);
    std::sort(by_line.begin(), by_line.end(), [&](std::uint32_t a, std::uint32_t b) {
        return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    });

    borders.clear();
    LineSum sum(points);
    std::vector<std::uint32_t> on_line, others;
    for (std::size_t i = 0, end; i < by_line.size(); i = end) {
        for (end = i; end < by_line.size() && keys[by_line[end]] == keys[by_line[i]];) ++end;
        others.assign(by_line.begin() + static_cast<std::ptrdiff_t>(i),
                      by_line.begin() + static_cast<std::ptrdiff_t>(end));
        while (!others.empty()) {  // more than once only when different lines have one key
            const PlanePair& line = lines[others[0]];
            on_line.clear();
            std::erase_if(others, [&](std::uint32_t member) {
                for (const PointId point : {edges[member].segment.from, edges[member].segment.to})
                    if (!lies_on(points, point, line.first) || !lies_on(points, point, line.second))
                        return false;
                on_line.push_back(member);
                return true;
            });
            sum.add(edges, on_line, exact::LineOrder::along(exact::Line(line.first, line.second)), borders);
        }
    }
    std::sort(borders.begin(), borders.end());
    return closes(borders);
}

}  // namespace octavo::bsp_octree
