// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <string>
#include <utility>

#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/concurrent_sets.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/boolean/ring.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

/// The triangles about each point.
class CornersAt {
  public:
    CornersAt(const Complex& complex, const Stars& stars, std::size_t points, const Context& context)
        : complex_(complex),
          stars_(stars),
          pieces_(corners_by_point(complex.pieces, complex.facets(), points, context)),
          is_cut_(complex.soup->points.size(), 0) {
        constexpr std::size_t grain = 1 << 12;
        parallel_chunks(context, complex.facets(), grain, [&](std::size_t first, std::size_t last) {
            for (std::size_t facet = first; facet < last; ++facet)
                if (complex.is_cut[facet])
                    for (const std::uint32_t corner : complex.soup->facets[facet])
                        std::atomic_ref(is_cut_[corner]).store(1, std::memory_order_relaxed);
        });
    }

    /// Whether the star is that of a vertex of the soup, as it was.
    bool is_whole(std::size_t point) const {
        return point < is_cut_.size() && !is_cut_[point] && pieces_.at(point).empty();
    }
    /// Ascending; `gathered` is where they are put unless they are together somewhere.
    std::span<const std::uint32_t> operator()(std::size_t point, std::vector<std::uint32_t>& gathered) const {
        if (is_whole(point)) return stars_.corners.at(point);
        if (point >= is_cut_.size()) return pieces_.at(point);
        gathered.clear();
        for (const std::uint32_t corner : stars_.corners.at(point))
            if (!complex_.is_cut[corner / 4]) gathered.push_back(corner);
        const std::span<const std::uint32_t> pieces = pieces_.at(point);
        gathered.insert(gathered.end(), pieces.begin(), pieces.end());
        return gathered;
    }

  private:
    const Complex& complex_;
    const Stars& stars_;
    CornerTable pieces_;
    std::vector<char> is_cut_;  ///< per vertex of the soup: a facet at it
};

/// Whether the triangles at a point form one closed fan of equal ones.
bool is_plain_fan(const Complex& complex, std::span<const std::uint32_t> corners, Ring& ring) {
    if (corners.size() < 3) return false;
    const TransitionId transition = complex.transition(corners[0] / 4);
    ring.begin(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t triangle = corners[i] / 4, k = corners[i] % 4;
        if (complex.transition(triangle) != transition) return false;
        const mesh::Triangle& t = complex.corners(triangle);
        ring.set(i, t[(k + 1) % 3], t[(k + 2) % 3]);
    }
    return ring.close();
}

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
    PatchSearch(const Complex& complex, const Stars& stars, const PointTable& points, const Context& context)
        : complex_(complex),
          stars_(stars),
          points_(points),
          context_(context),
          sets_(complex.size(), context) {}

    Result<Patches> run() {
        const CornersAt corners_at(complex_, stars_, points_.size(), context_);
        if (context_.cancelled()) return Context::cancelled_error();
        join_fans(corners_at);
        if (context_.cancelled()) return Context::cancelled_error();
        find_junctions(corners_at);
        if (context_.cancelled()) return Context::cancelled_error();
        if (!open_.empty()) return open_error();
        number_patches();
        patches_.same_region.resize(patches_.around.size());
        parallel_chunks(context_, patches_.junctions.size(), junction_grain,
                        [&](std::size_t first, std::size_t last) {
                            std::vector<AboutEdge> turned;
                            for (std::size_t i = first; i < last; ++i)
                                sort_around(patches_.junctions[i], turned);
                        });
        if (context_.cancelled()) return Context::cancelled_error();
        return std::move(patches_);
    }

  private:
    /// Of points, and of junctions, which are more work.
    static constexpr std::size_t grain = 1 << 10, junction_grain = 1 << 8;

    void join_fans(const CornersAt& corners_at) {
        patches_.is_plain.assign(points_.size(), 0);
        parallel_chunks(context_, points_.size(), grain, [&](std::size_t first, std::size_t last) {
            Ring ring;
            std::vector<std::uint32_t> gathered;
            for (std::size_t point = first; point < last; ++point) {
                const bool is_whole = corners_at.is_whole(point);
                if (is_whole && !stars_.is_fan[point]) continue;
                const std::span<const std::uint32_t> corners = corners_at(point, gathered);
                if (!is_whole && !is_plain_fan(complex_, corners, ring)) continue;
                patches_.is_plain[point] = 1;
                for (const std::uint32_t corner : corners.subspan(1)) sets_.unite(corners[0] / 4, corner / 4);
            }
        });
    }

    /// Ranges of points find for themselves, and what they have found is put together in their order.
    void find_junctions(const CornersAt& corners_at) {
        std::vector<FoundEdges> found((points_.size() + grain - 1) / grain);
        parallel_chunks(context_, points_.size(), grain, [&](std::size_t first, std::size_t last) {
            EdgeSearch search(complex_, patches_.is_plain, sets_, found[first / grain]);
            std::vector<std::uint32_t> gathered;
            for (std::size_t point = first; point < last; ++point)
                if (!patches_.is_plain[point])
                    search.visit_edges(static_cast<PointId>(point), corners_at(point, gathered));
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
        constexpr std::size_t triangles = 1 << 12;
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
    const Stars& stars_;
    const PointTable& points_;
    const Context& context_;
    ConcurrentSets sets_;
    Patches patches_;
    std::vector<OpenFacet> open_;
};

}  // namespace

Result<Patches> find_patches(const Complex& complex, const Stars& stars, const PointTable& points,
                             const Context& context) {
    return PatchSearch(complex, stars, points, context).run();
}

}  // namespace octavo::boolean
