// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <string>
#include <tuple>
#include <utility>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/concurrent_sets.hpp>
#include <octavo/boolean/lanes.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

/// For each point, the corners at it, as 4 · triangle + k.
struct CornerTable {
    std::vector<std::uint32_t> begin, corners;
};

/// Threads share the work by ranges of points: each looks at all triangles, which are read fast and in order, and
/// writes what belongs to its range.
CornerTable corners_by_point(const Complex& complex, std::size_t points, const Context& context) {
    CornerTable table;
    table.begin.assign(points + 1, 0);
    const std::size_t range = context.threads == 1 ? points + 1 : points / 4 + 1;
    const auto for_each_corner = [&](std::size_t first, std::size_t last, const auto& visit) {
        for (std::uint32_t triangle = 0; triangle < complex.size(); ++triangle) {
            if (!complex.exists(triangle)) continue;
            const mesh::Triangle& corners = complex.corners(triangle);
            for (std::uint32_t k = 0; k < 3; ++k)
                if (corners[k] >= first && corners[k] < last) visit(corners[k], 4 * triangle + k);
        }
    };
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        for_each_corner(first, last, [&](PointId point, std::uint32_t) { ++table.begin[point]; });
    });
    std::uint32_t sum = 0;
    for (std::uint32_t& begin : table.begin) begin = std::exchange(sum, sum + begin);
    table.corners.resize(sum);
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        for_each_corner(first, last, [&](PointId point, std::uint32_t corner) {
            table.corners[table.begin[point]++] = corner;
        });
    });
    for (std::size_t point = points; point > 0; --point) table.begin[point] = table.begin[point - 1];
    table.begin[0] = 0;
    return table;
}

/// Recognises points whose triangles form one closed fan of equal ones.
class FanTest {
  public:
    explicit FanTest(const Complex& complex) : complex_(complex) {}

    bool is_plain(std::span<const std::uint32_t> corners) {
        if (corners.size() < 3) return false;
        const TransitionId transition = complex_.transition(corners[0] / 4);
        for (const std::uint32_t corner : corners)
            if (complex_.transition(corner / 4) != transition) return false;
        return corners.size() <= small ? is_small_cycle(corners) : is_large_cycle(corners);
    }

  private:
    static constexpr std::size_t small = 32;

    /// The side of the triangle that lies opposite to the corner.
    std::pair<PointId, PointId> opposite(std::uint32_t corner) const {
        const mesh::Triangle& t = complex_.corners(corner / 4);
        const std::uint32_t k = corner % 4;
        return {t[(k + 1) % 3], t[(k + 2) % 3]};
    }

    /// Follows the sides; each next one is found among all by comparing eight at once.
    bool is_small_cycle(std::span<const std::uint32_t> corners) const {
        std::uint32_t from[small], to[small];
        const std::size_t count = corners.size(), padded = (count + 7) / 8 * 8;
        for (std::size_t i = 0; i < count; ++i) std::tie(from[i], to[i]) = opposite(corners[i]);
        for (std::size_t i = count; i < padded; ++i) from[i] = no_index;
        std::size_t at = 0;
        for (std::size_t step = 1; step <= count; ++step) {
            std::uint32_t starts = 0;
            for (std::size_t block = 0; block < padded; block += 8)
                starts |= bits(load_block(from + block) == static_cast<std::int32_t>(to[at])) << block;
            if (!std::has_single_bit(starts)) return false;
            at = static_cast<std::size_t>(std::countr_zero(starts));
            if (at == 0) return step == count;
        }
        return false;
    }

    /// Sorted by start, a fan is a permutation that each search follows in logarithmic time.
    bool is_large_cycle(std::span<const std::uint32_t> corners) {
        fan_.clear();
        for (const std::uint32_t corner : corners) fan_.push_back(opposite(corner));
        std::sort(fan_.begin(), fan_.end());
        std::size_t at = 0;
        for (std::size_t step = 1; step <= fan_.size(); ++step) {
            const auto next =
                std::lower_bound(fan_.begin(), fan_.end(), std::pair<PointId, PointId>{fan_[at].second, 0});
            if (next == fan_.end() || next->first != fan_[at].second) return false;
            if (next + 1 != fan_.end() && (next + 1)->first == next->first) return false;
            at = static_cast<std::size_t>(next - fan_.begin());
            if (at == 0) return step == fan_.size();
        }
        return false;
    }

    const Complex& complex_;
    std::vector<std::pair<PointId, PointId>> fan_;
};

/// A triangle at a vertex, as its opposite edge; or one of its sides at the vertex.
struct Spoke {
    PointId other;
    std::uint32_t triangle;
    bool leaves;  ///< the triangle runs from the vertex to `other`
};

class PatchSearch {
  public:
    PatchSearch(const Complex& complex, const PointTable& points)
        : complex_(complex), points_(points), sets_(complex.size()) {}

    Result<Patches> run(const Context& context) {
        const CornerTable table = corners_by_point(complex_, points_.size(), context);
        patches_.is_plain.assign(points_.size(), 0);
        parallel_chunks(context, points_.size(), 1 << 13, [&](std::size_t first, std::size_t last) {
            FanTest test(complex_);
            for (std::size_t point = first; point < last; ++point) {
                const std::span<const std::uint32_t> corners{table.corners.data() + table.begin[point],
                                                             table.begin[point + 1] - table.begin[point]};
                if (!test.is_plain(corners)) continue;
                patches_.is_plain[point] = 1;
                for (const std::uint32_t corner : corners.subspan(1)) sets_.unite(corners[0] / 4, corner / 4);
            }
        });
        if (context.cancelled()) return Context::cancelled_error();
        for (PointId point = 0; point < points_.size(); ++point) {
            const std::uint32_t begin = table.begin[point], end = table.begin[point + 1];
            if (begin != end && !patches_.is_plain[point])
                visit_edges(point, {table.corners.data() + begin, end - begin});
        }
        if (!open_.empty()) return open_error();
        number_patches();
        for (Junction& junction : patches_.junctions) sort_around(junction);
        return std::move(patches_);
    }

  private:
    /// Joins across or records the edges from `point` to higher points that are not plain either; fans have
    /// joined all others.
    void visit_edges(PointId point, std::span<const std::uint32_t> corners) {
        spokes_.clear();
        for (const std::uint32_t corner : corners) {
            const mesh::Triangle& t = complex_.corners(corner / 4);
            const std::uint32_t k = corner % 4;
            const PointId next = t[(k + 1) % 3], last = t[(k + 2) % 3];
            if (next > point && !patches_.is_plain[next]) spokes_.push_back({next, corner / 4, true});
            if (last > point && !patches_.is_plain[last]) spokes_.push_back({last, corner / 4, false});
        }
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
        });
        for (std::size_t i = 0, end; i < spokes_.size(); i = end) {
            for (end = i + 1; end < spokes_.size() && spokes_[end].other == spokes_[i].other;) ++end;
            visit_edge(point, {spokes_.data() + i, end - i});
        }
    }

    void visit_edge(PointId low, std::span<const Spoke> sides) {
        if (sides.size() == 2 && sides[0].leaves != sides[1].leaves &&
            complex_.transition(sides[0].triangle) == complex_.transition(sides[1].triangle)) {
            sets_.unite(sides[0].triangle, sides[1].triangle);
            return;
        }
        sum_.clear();
        for (const Spoke& side : sides)
            sum_.add(complex_.transitions.of(complex_.transition(side.triangle)), side.leaves ? 1 : -1);
        if (!sum_.normalised().empty()) {
            for (const Spoke& side : sides) open_.push_back(complex_.facet(side.triangle));
            return;
        }
        Junction junction{low, sides[0].other, static_cast<std::uint32_t>(patches_.around.size()), 0};
        for (const Spoke& side : sides) patches_.around.push_back(2 * side.triangle + (side.leaves ? 1 : 0));
        junction.end = static_cast<std::uint32_t>(patches_.around.size());
        patches_.junctions.push_back(junction);
    }

    Error open_error() {
        std::sort(open_.begin(), open_.end());
        open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
        const mesh::Source first = complex_.soup->source(open_[0]);
        Error error{ErrorCode::not_a_solid, "", {}};
        std::size_t in_operand = 0;
        for (const std::uint32_t facet : open_) {
            const mesh::Source source = complex_.soup->source(facet);
            if (source.operand != first.operand) continue;
            ++in_operand;
            if (error.place.faces.size() < 8) error.place.faces.push_back(source.face);
        }
        error.sentence = "operand " + std::to_string(first.operand) +
                         " is not closed or not consistently oriented: at " + std::to_string(in_operand) +
                         " of its facets an edge has no partner that runs the other way";
        return error;
    }

    void number_patches() {
        patches_.of_triangle.assign(complex_.size(), no_index);
        for (std::uint32_t triangle = 0; triangle < complex_.size(); ++triangle) {
            if (!complex_.exists(triangle)) continue;
            const std::uint32_t root = sets_.find(triangle);
            patches_.of_triangle[triangle] = root == triangle ? patches_.count++ : patches_.of_triangle[root];
        }
    }

    exact::Plane plane_of(std::uint32_t triangle) const {
        const Soup& soup = *complex_.soup;
        const mesh::Triangle& corner = soup.facets[complex_.facet(triangle)];
        return exact::Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
    }

    /// Sorts the triangles about the edge and equates the regions between neighbours.
    void sort_around(const Junction& junction) {
        turned_.clear();
        for (std::uint32_t at = junction.begin; at < junction.end; ++at) {
            const std::uint32_t entry = patches_.around[at];
            turned_.push_back(turned(plane_of(entry / 2), entry % 2 != 0, entry));
        }
        sort_about_edge(points_, junction.low, junction.high, turned_);
        for (std::size_t k = 0; k < turned_.size(); ++k)
            patches_.around[junction.begin + k] = turned_[k].entry;
        for (std::size_t k = 0; k < turned_.size(); ++k) {
            const std::uint32_t entry = turned_[k].entry, next = turned_[(k + 1) % turned_.size()].entry;
            // A triangle that runs upward has its front after it, one that runs downward its back.
            const PatchSide after = 2 * patches_.of_triangle[entry / 2] + (entry % 2 ? 0 : 1);
            const PatchSide before = 2 * patches_.of_triangle[next / 2] + (next % 2 ? 1 : 0);
            patches_.same_region.push_back({after, before});
        }
    }

    const Complex& complex_;
    const PointTable& points_;
    ConcurrentSets sets_;
    Patches patches_;
    TransitionSum sum_;
    std::vector<Spoke> spokes_;
    std::vector<AboutEdge> turned_;
    std::vector<std::uint32_t> open_;
};

}  // namespace

Result<Patches> find_patches(const Complex& complex, const PointTable& points, const Context& context) {
    return PatchSearch(complex, points).run(context);
}

}  // namespace octavo::boolean
