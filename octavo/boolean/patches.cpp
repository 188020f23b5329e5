// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <string>
#include <tuple>
#include <utility>

#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/concurrent_sets.hpp>
#include <octavo/boolean/lanes.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

/// For each point, the corners at it, as 4 · triangle + k.
struct CornerTable {
    std::vector<std::uint32_t> begin;
    UninitialisedVector<std::uint32_t> corners;
};

/// Threads share the work by ranges of points. Each looks at the blocks of triangles that have corners in its range,
/// which are few where meshes are numbered in some order.
CornerTable corners_by_point(const Complex& complex, std::size_t points, const Context& context) {
    constexpr std::uint32_t block = 1024;
    const std::size_t ranges = context.threads == 1 ? 1 : 8, range = points / ranges + 1;
    std::vector<std::uint8_t> ranges_of(complex.size() / block + 1, ranges == 1);
    const auto for_each_corner_of = [&](std::size_t number, const auto& visit) {
        const auto begin = static_cast<std::uint32_t>(number * block);
        for (std::uint32_t triangle = begin; triangle < std::min(begin + block, complex.size()); ++triangle) {
            if (!complex.exists(triangle)) continue;
            const mesh::Triangle& corners = complex.corners(triangle);
            for (std::uint32_t k = 0; k < 3; ++k) visit(corners[k], 4 * triangle + k);
        }
    };
    if (ranges > 1)
        parallel_chunks(context, ranges_of.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t number = first; number < last; ++number)
                for_each_corner_of(number, [&](PointId point, std::uint32_t) {
                    ranges_of[number] = static_cast<std::uint8_t>(ranges_of[number] | 1u << point / range);
                });
        });
    const auto for_each_corner = [&](std::size_t first, std::size_t last, const auto& visit) {
        for (std::size_t number = 0; number < ranges_of.size(); ++number)
            if (ranges_of[number] >> first / range & 1)
                for_each_corner_of(number, [&](PointId point, std::uint32_t corner) {
                    if (point >= first && point < last) visit(point, corner);
                });
    };
    // The corners of a point are counted two places on, and then its end is counted up from where it begins.
    CornerTable table;
    table.begin.assign(points + 2, 0);
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        for_each_corner(first, last, [&](PointId point, std::uint32_t) { ++table.begin[point + 2]; });
    });
    for (std::size_t point = 2; point < table.begin.size(); ++point)
        table.begin[point] += table.begin[point - 1];
    table.corners.resize(table.begin.back());
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        for_each_corner(first, last, [&](PointId point, std::uint32_t corner) {
            table.corners[table.begin[point + 1]++] = corner;
        });
    });
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

/// A facet at an edge where the winding changes of an operand do not cancel.
struct OpenFacet {
    std::uint32_t operand, facet;
    friend auto operator<=>(const OpenFacet&, const OpenFacet&) = default;
};

/// What is at the edges of a range of points.
struct FoundEdges {
    std::vector<Junction> junctions;
    std::vector<std::uint32_t> around;
    std::vector<OpenFacet> open;
};

/// Joins across edges that change nothing and records the others.
class EdgeSearch {
  public:
    EdgeSearch(const Complex& complex, const std::vector<char>& is_plain, ConcurrentSets& sets,
               FoundEdges& found)
        : complex_(complex), is_plain_(is_plain), sets_(sets), found_(found) {}

    /// The edges from `point` to higher points that are not plain either; fans have joined all others.
    void visit_edges(PointId point, std::span<const std::uint32_t> corners) {
        spokes_.clear();
        for (const std::uint32_t corner : corners) {
            const mesh::Triangle& t = complex_.corners(corner / 4);
            const std::uint32_t k = corner % 4;
            const PointId next = t[(k + 1) % 3], last = t[(k + 2) % 3];
            if (next > point && !is_plain_[next]) spokes_.push_back({next, corner / 4, true});
            if (last > point && !is_plain_[last]) spokes_.push_back({last, corner / 4, false});
        }
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
        });
        for (std::size_t i = 0, end; i < spokes_.size(); i = end) {
            for (end = i + 1; end < spokes_.size() && spokes_[end].other == spokes_[i].other;) ++end;
            visit_edge(point, {spokes_.data() + i, end - i});
        }
    }

  private:
    void visit_edge(PointId low, std::span<const Spoke> sides) {
        if (sides.size() == 2 && sides[0].leaves != sides[1].leaves &&
            complex_.transition(sides[0].triangle) == complex_.transition(sides[1].triangle)) {
            sets_.unite(sides[0].triangle, sides[1].triangle);
            return;
        }
        sum_.clear();
        for (const Spoke& side : sides)
            sum_.add(complex_.transitions.of(complex_.transition(side.triangle)), side.leaves ? 1 : -1);
        const std::span<const Delta> missing = sum_.normalised();
        if (!missing.empty()) {
            note_open(sides, missing);
            return;
        }
        const auto begin = static_cast<std::uint32_t>(found_.around.size());
        for (const Spoke& side : sides) found_.around.push_back(2 * side.triangle + (side.leaves ? 1 : 0));
        found_.junctions.push_back(
            {low, sides[0].other, begin, static_cast<std::uint32_t>(found_.around.size())});
    }

    /// Of the facets at the edge, those of operands whose changes do not cancel.
    void note_open(std::span<const Spoke> sides, std::span<const Delta> missing) {
        for (const Spoke& side : sides)
            for (const Delta& delta : complex_.transitions.of(complex_.transition(side.triangle)))
                if (std::any_of(missing.begin(), missing.end(),
                                [&](const Delta& other) { return other.operand == delta.operand; }))
                    found_.open.push_back({delta.operand, complex_.facet(side.triangle)});
    }

    const Complex& complex_;
    const std::vector<char>& is_plain_;
    ConcurrentSets& sets_;
    FoundEdges& found_;
    TransitionSum sum_;
    std::vector<Spoke> spokes_;
};

class PatchSearch {
  public:
    PatchSearch(const Complex& complex, const PointTable& points, const Context& context)
        : complex_(complex), points_(points), context_(context), sets_(complex.size()) {}

    Result<Patches> run() {
        const CornerTable table = corners_by_point(complex_, points_.size(), context_);
        join_fans(table);
        if (context_.cancelled()) return Context::cancelled_error();
        find_junctions(table);
        if (context_.cancelled()) return Context::cancelled_error();
        if (!open_.empty()) return open_error();
        number_patches();
        patches_.same_region.resize(patches_.around.size());
        parallel_chunks(context_, patches_.junctions.size(), grain, [&](std::size_t first, std::size_t last) {
            std::vector<AboutEdge> turned;
            for (std::size_t i = first; i < last; ++i) sort_around(patches_.junctions[i], turned);
        });
        if (context_.cancelled()) return Context::cancelled_error();
        return std::move(patches_);
    }

  private:
    static constexpr std::size_t grain = 1 << 13;

    static std::span<const std::uint32_t> corners_at(const CornerTable& table, std::size_t point) {
        return {table.corners.data() + table.begin[point], table.begin[point + 1] - table.begin[point]};
    }

    void join_fans(const CornerTable& table) {
        patches_.is_plain.assign(points_.size(), 0);
        parallel_chunks(context_, points_.size(), grain, [&](std::size_t first, std::size_t last) {
            FanTest test(complex_);
            for (std::size_t point = first; point < last; ++point) {
                const std::span<const std::uint32_t> corners = corners_at(table, point);
                if (!test.is_plain(corners)) continue;
                patches_.is_plain[point] = 1;
                for (const std::uint32_t corner : corners.subspan(1)) sets_.unite(corners[0] / 4, corner / 4);
            }
        });
    }

    /// Ranges of points find for themselves, and what they have found is put together in their order.
    void find_junctions(const CornerTable& table) {
        std::vector<FoundEdges> found((points_.size() + grain - 1) / grain);
        parallel_chunks(context_, points_.size(), grain, [&](std::size_t first, std::size_t last) {
            EdgeSearch search(complex_, patches_.is_plain, sets_, found[first / grain]);
            for (std::size_t point = first; point < last; ++point)
                if (!patches_.is_plain[point])
                    search.visit_edges(static_cast<PointId>(point), corners_at(table, point));
        });
        for (FoundEdges& part : found) {
            const auto begin = static_cast<std::uint32_t>(patches_.around.size());
            for (Junction junction : part.junctions) {
                junction.begin += begin, junction.end += begin;
                patches_.junctions.push_back(junction);
            }
            patches_.around.insert(patches_.around.end(), part.around.begin(), part.around.end());
            open_.insert(open_.end(), part.open.begin(), part.open.end());
            part = {};
        }
    }

    Error open_error() {
        std::sort(open_.begin(), open_.end());
        open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
        Error error{ErrorCode::not_a_solid, "", {}};
        error.place.operand = open_[0].operand;
        std::size_t facets = 0;
        for (const auto& [operand, facet] : open_) {
            if (operand != open_[0].operand) break;
            ++facets;
            const mesh::Source source = complex_.soup->source(facet);  // of several facets that coincide, one
            if (source.operand == operand && error.place.faces.size() < 8)
                error.place.faces.push_back(source.face);
        }
        error.sentence = "is not closed or not consistently oriented: at " + std::to_string(facets) +
                         " of its facets an edge has no partner that runs the other way";
        return error;
    }

    /// Patches are numbered by their first triangles, which stand for their sets.
    void number_patches() {
        const auto is_first = [&](std::size_t triangle) {
            const auto t = static_cast<std::uint32_t>(triangle);
            return complex_.exists(t) && sets_.find(t) == t;
        };
        constexpr std::size_t triangles = 1 << 16;
        const std::vector<std::size_t> offset =
            chunk_offsets(context_, complex_.size(), triangles, [&](std::size_t first, std::size_t last) {
                std::size_t count = 0;
                for (std::size_t t = first; t < last; ++t) count += is_first(t);
                return count;
            });
        patches_.count = static_cast<std::uint32_t>(offset.back());
        patches_.first.resize(patches_.count);
        patches_.of_triangle.resize(complex_.size());
        parallel_chunks(context_, complex_.size(), triangles, [&](std::size_t first, std::size_t last) {
            auto patch = static_cast<std::uint32_t>(offset[first / triangles]);
            for (std::size_t t = first; t < last; ++t) {
                if (!is_first(t)) continue;
                patches_.first[patch] = static_cast<std::uint32_t>(t);
                patches_.of_triangle[t] = patch++;
            }
        });
        parallel_chunks(context_, complex_.size(), triangles, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                const auto t = static_cast<std::uint32_t>(i);
                const std::uint32_t root = sets_.find(t);
                if (!complex_.exists(t))
                    patches_.of_triangle[t] = no_index;
                else if (root != t)
                    patches_.of_triangle[t] = patches_.of_triangle[root];
            }
        });
    }

    exact::Plane plane_of(std::uint32_t triangle) const {
        const Soup& soup = *complex_.soup;
        const mesh::Triangle& corner = soup.facets[complex_.facet(triangle)];
        return exact::Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
    }

    /// Sorts the triangles about the edge and equates the regions between neighbours.
    void sort_around(const Junction& junction, std::vector<AboutEdge>& about) {
        about.clear();
        for (std::uint32_t at = junction.begin; at < junction.end; ++at) {
            const std::uint32_t entry = patches_.around[at];
            about.push_back(turned(plane_of(entry / 2), entry % 2 != 0, entry));
        }
        sort_about_edge(points_, junction.low, junction.high, about);
        for (std::size_t k = 0; k < about.size(); ++k) {
            const std::uint32_t entry = about[k].entry, next = about[(k + 1) % about.size()].entry;
            patches_.around[junction.begin + k] = entry;
            // A triangle that runs upward has its front after it, one that runs downward its back.
            const PatchSide after = 2 * patches_.of_triangle[entry / 2] + (entry % 2 ? 0 : 1);
            const PatchSide before = 2 * patches_.of_triangle[next / 2] + (next % 2 ? 1 : 0);
            patches_.same_region[junction.begin + k] = {after, before};
        }
    }

    const Complex& complex_;
    const PointTable& points_;
    const Context& context_;
    ConcurrentSets sets_;
    Patches patches_;
    std::vector<OpenFacet> open_;
};

}  // namespace

Result<Patches> find_patches(const Complex& complex, const PointTable& points, const Context& context) {
    return PatchSearch(complex, points, context).run();
}

}  // namespace octavo::boolean
