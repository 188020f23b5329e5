// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/base/parallel_sort.hpp>
#include <octavo/bsp_octree/borders.hpp>
#include <octavo/bsp_octree/line_key.hpp>
#include <octavo/bsp_octree/line_sum.hpp>
#include <octavo/exact/compare.hpp>
#include <octavo/exact/intersect.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::PointId;
using boolean::PointTable;
using exact::Sign;

/// Removes segments of one facing that run opposite ways, unless they may be slits.
void cancel_opposite(std::vector<BoundedSegment>& edges, const Context& context) {
    const auto ends = [](const Segment& s) {
        return std::pair(std::min(s.from, s.to), std::max(s.from, s.to));
    };
    parallel_sort(context, edges, [&](const BoundedSegment& a, const BoundedSegment& b) {
        if (a.segment.facing != b.segment.facing) return a.segment.facing < b.segment.facing;
        if (ends(a.segment) != ends(b.segment)) return ends(a.segment) < ends(b.segment);
        if (a.segment.from != b.segment.from) return a.segment.from < b.segment.from;
        return a.bound.bits < b.bound.bits;
    });
    std::size_t kept = 0;
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        std::ptrdiff_t balance = 0;  // of those that run upwards
        const auto [low, high] = ends(edges[i].segment);
        std::size_t up = i, down = i;
        bool stay = false;
        for (end = i; end < edges.size() && edges[end].segment.facing == edges[i].segment.facing &&
                      ends(edges[end].segment) == std::pair{low, high};
             ++end) {
            const bool upwards = edges[end].segment.from == low;
            balance += upwards ? 1 : -1;
            (upwards ? up : down) = end;
            stay = stay || edges[end].may_be_slit;
        }
        if (stay) {
            while (i < end) edges[kept++] = edges[i++];
            continue;
        }
        const BoundedSegment left = edges[balance > 0 ? up : down];
        for (; balance != 0; balance += balance > 0 ? -1 : 1) edges[kept++] = left;
    }
    edges.resize(kept);
}

/// Segments by the line of space on which they lie.
class ByLine {
  public:
    ByLine(std::span<const BoundedSegment> edges, const bsp::PlaneTable& planes, const PointTable& points)
        : edges_(edges), planes_(planes), points_(points) {}

    /// Brings together those whose lines have equal keys.
    void sort(int attempt, const Context& context) {
        keyed_.resize(edges_.size());
        parallel_chunks(context, edges_.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::vector<PlanePair> lines;
            lines.reserve(end - begin);
            for (std::size_t i = begin; i < end; ++i) lines.push_back(line_of(edges_[i]));
            const std::vector<std::uint64_t> keys = line_keys(lines, attempt);
            for (std::size_t i = begin; i < end; ++i)
                keyed_[i] = {keys[i - begin], static_cast<std::uint32_t>(i)};
        });
        parallel_sort(context, keyed_);
    }

    /// What is left on each line, sorted.
    LineSums sums(const std::vector<char>& is_kept, const Context& context) const {
        std::vector<LineSums> parts((keyed_.size() + grain - 1) / grain);
        parallel_chunks(context, keyed_.size(), grain, [&](std::size_t begin, std::size_t end) {
            LineSum sum(points_, is_kept);
            std::vector<std::uint32_t> others, on_line;
            std::size_t i = begin;
            // A line whose key began in the chunk before was added up there.
            while (i > 0 && i < end && keyed_[i].first == keyed_[i - 1].first) ++i;
            for (std::size_t next; i < end; i = next) {
                others.clear();
                for (next = i; next < keyed_.size() && keyed_[next].first == keyed_[i].first; ++next)
                    others.push_back(keyed_[next].second);
                while (!others.empty()) {  // more than once only when different lines have one key
                    const exact::LineOrder order = take_line(others, on_line);
                    sum.add(edges_, on_line, order, parts[begin / grain]);
                }
            }
        });
        LineSums all;
        for (const LineSums& part : parts) {
            all.borders.insert(all.borders.end(), part.borders.begin(), part.borders.end());
            all.passed.insert(all.passed.end(), part.passed.begin(), part.passed.end());
        }
        parallel_sort(context, all.borders), parallel_sort(context, all.passed);
        return all;
    }

  private:
    static constexpr std::size_t grain = 1 << 13;

    /// The plane of a bound, which is no side.
    exact::Plane plane_of(bsp::Bound bound) const {
        return bound.is_wall() ? bsp::wall_plane(bound.axis(), bound.twice()) : planes_[bound.plane_id()];
    }
    PlanePair line_of(const BoundedSegment& edge) const {
        return {planes_[edge.segment.facing.plane()], plane_of(edge.bound)};
    }

    /// Two planes have one line, whichever of them is a segment's own. Nearly all edges of a solid are cuts of two of
    /// its planes, seen from both; checking the points of those costs a fifth of all.
    static std::pair<std::uint32_t, std::uint32_t> planes_of(const BoundedSegment& edge) {
        return std::minmax({bsp::Bound::plane(edge.segment.facing.plane()).bits, edge.bound.bits});
    }

    bool lies_on(PointId point, const exact::Plane& plane) const {
        return points_.with(point, [&](const auto& p) { return exact::side_of(plane, p) == Sign::zero; });
    }

    /// Moves those to `on_line` that lie on the line of the first.
    exact::LineOrder take_line(std::vector<std::uint32_t>& others,
                               std::vector<std::uint32_t>& on_line) const {
        const BoundedSegment& first = edges_[others[0]];
        const auto planes = planes_of(first);
        const PlanePair line = line_of(first);
        on_line.clear();
        std::erase_if(others, [&](std::uint32_t member) {
            const BoundedSegment& edge = edges_[member];
            if (planes_of(edge) != planes)
                for (const PointId point : {edge.segment.from, edge.segment.to})
                    if (!lies_on(point, line.first) || !lies_on(point, line.second)) return false;
            on_line.push_back(member);
            return true;
        });
        return exact::LineOrder::along(exact::Line(line.first, line.second));
    }

    std::span<const BoundedSegment> edges_;
    const bsp::PlaneTable& planes_;
    const PointTable& points_;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed_;  ///< key of the line, number of the segment
};

/// Notes the points that borders of one facing pass on several lines; whether there are any. `passed` is sorted.
bool keep_crossings(const std::vector<Passed>& passed, std::vector<char>& is_kept) {
    bool any = false;
    for (auto at = passed.begin(); (at = std::adjacent_find(at, passed.end())) != passed.end(); ++at)
        is_kept[at->point] = 1, any = true;
    return any;
}

/// At every point, as many segments of a facing end as start; and on every segment, the solid is on one side of as
/// many faces as it is on the other side of.
bool closes(const std::vector<Segment>& borders, const Context& context) {
    using Run = std::pair<std::uint32_t, std::uint32_t>;
    const auto are_equal = [&](std::vector<Run> first, std::vector<Run> second) {
        parallel_sort(context, first), parallel_sort(context, second);
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

bool sum_borders(std::vector<BoundedSegment> edges, const bsp::PlaneTable& planes, const PointTable& points,
                 int attempt, std::vector<Segment>& borders, const Context& context) {
    cancel_opposite(edges, context);
    ByLine lines(edges, planes, points);
    lines.sort(attempt, context);
    std::vector<char> is_kept(points.size());
    LineSums sums = lines.sums(is_kept, context);
    if (keep_crossings(sums.passed, is_kept)) sums = lines.sums(is_kept, context);
    borders = std::move(sums.borders);
    return closes(borders, context);
}

}  // namespace octavo::bsp_octree
