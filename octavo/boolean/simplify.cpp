// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/balanced_chunks.hpp>
#include <octavo/boolean/cells.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/simplify.hpp>
#include <octavo/boolean/subdivision.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

using exact::int128;
using exact::Plane;
using exact::wide;

/// Whether two planes that share a line are one plane, fronts on the same side.
bool same_plane(const Plane& a, const Plane& b) {
    const auto minor = [&](int i, int j) {
        return wide(a.normal(i)) * b.normal(j) - wide(a.normal(j)) * b.normal(i);
    };
    if (minor(1, 2) != 0 || minor(2, 0) != 0 || minor(0, 1) != 0) return false;
    const int axis = a.dominant_axis();
    return (a.normal(axis) > 0) == (b.normal(axis) > 0);
}

/// A facet's side along an edge with both ends at pieces.
struct Side {
    PointId low, high;
    std::uint32_t triangle;
    bool upward;
    bool is_inner = false;  ///< of one region on both sides
};

/// The borders that meet in a point: up to two neighbours along borders, or that there are more.
struct Borders {
    PointId neighbour[2] = {no_index, no_index};
    bool more = false;
    std::uint32_t triangle = no_index;  ///< one facet at the point, for its plane

    void add(PointId point) {
        if (neighbour[0] == point || neighbour[1] == point) return;
        if (neighbour[0] == no_index)
            neighbour[0] = point;
        else if (neighbour[1] == no_index)
            neighbour[1] = point;
        else
            more = true;
    }
};

/// The pieces of one region, and its border: directed, needless points skipped.
struct Region {
    std::span<const std::uint32_t> triangles;  ///< of the surface
    std::span<std::pair<PointId, PointId>> border;
};

/// All regions, by their first pieces.
struct Regions {
    std::vector<std::uint32_t> triangles, first_triangle;  ///< per region, and one past the last
    std::vector<std::pair<PointId, PointId>> borders;
    std::vector<std::uint32_t> first_border;

    std::size_t size() const { return first_triangle.size() - 1; }
    Region operator[](std::size_t region) {
        return {
            {triangles.data() + first_triangle[region], first_triangle[region + 1] - first_triangle[region]},
            {borders.data() + first_border[region], first_border[region + 1] - first_border[region]}};
    }
};

/// What has become of regions.
struct Polygons {
    std::vector<mesh::Triangle> triangles;
    std::vector<Surface::Facet> facets;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> merged;  ///< as in Surface
};

/// Triangulates regions from their borders, one after another, in memory that they share.
class RegionTriangulator {
  public:
    RegionTriangulator(const Surface& surface, const Soup& soup, const Faces& faces, const PointTable& points,
                       Polygons& made)
        : surface_(surface), soup_(soup), faces_(faces), subdivision_(points), made_(made) {}

    /// `is_needed` tells of points of pieces whether they stay.
    template <class IsNeeded>
    void run(const Region& region, const IsNeeded& is_needed) {
        const Surface::Facet name = find_facets(region);
        if (region.triangles.size() > 1)
            triangulate(region, is_needed);
        else
            made_.triangles.push_back(surface_.triangles[region.triangles[0]]);
        made_.facets.resize(made_.triangles.size(), name);
        if (soup_facets_.size() < 2) return;
        for (const std::uint32_t part : soup_facets_)
            made_.merged.emplace_back(part, std::uint32_t{name.soup_facet});
    }

  private:
    /// The soup facets that the region has parts of, ascending; returns the first, after which it is named.
    Surface::Facet find_facets(const Region& region) {
        Surface::Facet name = surface_.facets[region.triangles[0]];
        soup_facets_.clear();
        for (const std::uint32_t triangle : region.triangles) {
            const Surface::Facet facet = surface_.facets[triangle];
            if (!soup_facets_.empty() && soup_facets_.back() == facet.soup_facet) continue;
            if (facet.soup_facet < name.soup_facet) name = facet;
            soup_facets_.push_back(facet.soup_facet);
        }
        if (faces_.any_joined())
            for (std::size_t i = soup_facets_.size(); i-- > 0;) {
                const std::uint32_t partner = faces_.partner(soup_facets_[i]);
                if (partner != no_index) soup_facets_.push_back(partner);
            }
        std::sort(soup_facets_.begin(), soup_facets_.end());
        soup_facets_.erase(std::unique(soup_facets_.begin(), soup_facets_.end()), soup_facets_.end());
        return name;
    }

    template <class IsNeeded>
    void triangulate(const Region& region, const IsNeeded& is_needed) {
        const Plane plane = surface_.plane(soup_, region.triangles[0]);
        corners_.clear(), points_.clear();
        for (const std::uint32_t facet : soup_facets_)
            for (const std::uint32_t corner : soup_.facets[facet]) corners_.push_back(soup_.points[corner]);
        subdivision_.begin_round(plane, corners_);
        for (const auto& [from, to] : region.border) points_.push_back({from, Subdivision::no_line});
        // A point inside may be needed too: something touches the region there.
        for (const std::uint32_t triangle : region.triangles)
            for (const PointId point : surface_.triangles[triangle])
                if (is_needed(point)) points_.push_back({point, Subdivision::no_line});
        subdivision_.add_points(points_);
        // A border that the region has on both sides does not lead out of it.
        constexpr std::uint32_t border = 0, slit = 1;
        std::sort(region.border.begin(), region.border.end());
        for (const auto& [from, to] : region.border) {
            const bool both =
                std::binary_search(region.border.begin(), region.border.end(), std::pair{to, from});
            subdivision_.add_segment(subdivision_.vertex_of(from), subdivision_.vertex_of(to),
                                     Subdivision::no_line, both ? slit : border);
        }
        subdivision_.refine();

        const auto all = subdivision_.triangles();
        cells_.find(subdivision_, slit);
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!cells_.cover(cells_.of_triangle()[i]).empty())
                made_.triangles.push_back({subdivision_.point_of(all[i].v[0]),
                                           subdivision_.point_of(all[i].v[1]),
                                           subdivision_.point_of(all[i].v[2])});
    }

    const Surface& surface_;
    const Soup& soup_;
    const Faces& faces_;
    Subdivision subdivision_;
    Polygons& made_;
    std::vector<std::uint32_t> soup_facets_;  ///< of the region at hand
    std::vector<exact::Point> corners_;
    std::vector<Subdivision::PointOnLine> points_;
    Cells cells_;
};

class CoplanarMerge {
  public:
    CoplanarMerge(Surface surface, const Soup& soup, const Faces& faces, const PointTable& points,
                  const Context& context)
        : surface_(std::move(surface)),
          soup_(soup),
          faces_(faces),
          points_(points),
          context_(context),
          first_piece_(surface_.first_piece()),
          sets_(0) {}

    Surface run() {
        if (first_piece_ == surface_.triangles.size()) return std::move(surface_);
        number_points();
        find_sides();
        if (context_.cancelled()) return {};
        find_regions();
        find_needless();
        return rebuild();
    }

  private:
    std::size_t pieces() const { return surface_.triangles.size() - first_piece_; }

    /// Points of pieces get numbers 0, 1, …
    void number_points() {
        number_of_.assign(points_.size(), no_index);
        for (std::size_t i = first_piece_; i < surface_.triangles.size(); ++i)
            for (const PointId point : surface_.triangles[i]) {
                if (number_of_[point] != no_index) continue;
                number_of_[point] = static_cast<std::uint32_t>(borders_.size());
                borders_.emplace_back();
                borders_.back().triangle = static_cast<std::uint32_t>(i);
            }
    }

    /// The sides between points of pieces, by their low points; those points that whole facets have are pinned.
    void find_sides() {
        struct Found {
            std::vector<Side> sides;
            std::vector<std::uint32_t> pinned;
        };
        constexpr std::size_t grain = 1 << 10;
        std::vector<Found> found(surface_.triangles.size() / grain + 1);
        parallel_chunks(context_, surface_.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            Found& here = found[begin / grain];
            for (std::size_t i = begin; i < end; ++i) {
                const mesh::Triangle& t = surface_.triangles[i];
                for (int k = 0; k < 3; ++k) {
                    const PointId from = t[k], to = t[(k + 1) % 3];
                    if (number_of_[from] == no_index) continue;
                    if (i < first_piece_) here.pinned.push_back(number_of_[from]);
                    if (number_of_[to] == no_index) continue;
                    here.sides.push_back(
                        {std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i), from < to});
                }
            }
        });
        // The sides of a point are counted two places on, and then its end is counted up from where it begins.
        std::vector<std::uint32_t> begin_of(borders_.size() + 2, 0);
        pinned_.assign(borders_.size(), 0);
        for (const Found& part : found) {
            for (const std::uint32_t number : part.pinned) pinned_[number] = 1;
            for (const Side& side : part.sides) ++begin_of[number_of_[side.low] + 2];
        }
        for (std::size_t i = 2; i < begin_of.size(); ++i) begin_of[i] += begin_of[i - 1];
        sides_.resize(begin_of.back());
        for (const Found& part : found)
            for (const Side& side : part.sides) sides_[begin_of[number_of_[side.low] + 1]++] = side;
        parallel_chunks(context_, borders_.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t number = begin; number < end; ++number) {
                const auto first = sides_.begin() + begin_of[number],
                           last = sides_.begin() + begin_of[number + 1];
                std::sort(first, last, [](const Side& a, const Side& b) {
                    return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
                });
                mark_inner({first, last});
            }
        });
    }

    /// Of sides with one low point.
    void mark_inner(std::span<Side> sides) const {
        for (std::size_t i = 0, end; i < sides.size(); i = end) {
            end = end_of_edge(sides, i);
            if (is_inner(sides.subspan(i, end - i))) sides[i].is_inner = sides[i + 1].is_inner = true;
        }
    }

    static std::size_t end_of_edge(std::span<const Side> sides, std::size_t begin) {
        std::size_t end = begin + 1;
        while (end < sides.size() && sides[end].low == sides[begin].low &&
               sides[end].high == sides[begin].high)
            ++end;
        return end;
    }

    bool is_inner(std::span<const Side> edge) const {
        if (edge.size() != 2 || edge[0].upward == edge[1].upward || edge[0].triangle < first_piece_)
            return false;
        const Surface::Facet &a = surface_.facets[edge[0].triangle], &b = surface_.facets[edge[1].triangle];
        if (a.soup_facet == b.soup_facet) return true;
        return same_plane(surface_.plane(soup_, edge[0].triangle), surface_.plane(soup_, edge[1].triangle));
    }

    void find_regions() {
        sets_ = mesh::DisjointSets(pieces());
        std::size_t borders = 0;
        for (std::size_t i = 0, end; i < sides_.size(); i = end) {
            end = end_of_edge(sides_, i);
            if (sides_[i].is_inner) {
                sets_.unite(sides_[i].triangle - static_cast<std::uint32_t>(first_piece_),
                            sides_[i + 1].triangle - static_cast<std::uint32_t>(first_piece_));
                continue;
            }
            borders_[number_of_[sides_[i].low]].add(sides_[i].high);
            borders_[number_of_[sides_[i].high]].add(sides_[i].low);
            for (std::size_t k = i; k < end; ++k)
                if (sides_[k].triangle >= first_piece_) sides_[borders++] = sides_[k];
        }
        sides_.resize(borders);
    }

    void find_needless() {
        needless_.assign(borders_.size(), 0);
        parallel_chunks(context_, number_of_.size(), 1 << 12, [&](std::size_t begin, std::size_t end) {
            for (std::size_t point = begin; point < end; ++point) {
                const std::uint32_t number = number_of_[point];
                if (number != no_index && !pinned_[number])
                    needless_[number] = is_needless(static_cast<PointId>(point), borders_[number]);
            }
        });
    }

    bool is_needless(PointId point, const Borders& borders) const {
        if (borders.more) return false;
        if (borders.neighbour[0] == no_index) return true;
        if (borders.neighbour[1] == no_index) return false;
        const int axis = surface_.plane(soup_, borders.triangle).dominant_axis();
        return points_.is_between(axis, borders.neighbour[0], point, borders.neighbour[1]);
    }

    /// Where the border that a needed side begins comes to a point that is needed.
    std::pair<PointId, PointId> straight_border(const Side& side) const {
        PointId from = side.upward ? side.low : side.high, to = side.upward ? side.high : side.low;
        const PointId start = from;
        while (needless_[number_of_[to]]) {
            const Borders& borders = borders_[number_of_[to]];
            const PointId next = borders.neighbour[0] == from ? borders.neighbour[1] : borders.neighbour[0];
            from = to, to = next;
        }
        return {start, to};
    }

    Regions collect_regions() {
        Regions regions;
        std::vector<std::uint32_t> region_of(pieces());
        for (std::uint32_t piece = 0; piece < pieces(); ++piece) {
            const std::uint32_t root = sets_.find(piece);
            if (root == piece) {
                region_of[piece] = static_cast<std::uint32_t>(regions.first_triangle.size());
                regions.first_triangle.push_back(0);
            }
            region_of[piece] = region_of[root];
            ++regions.first_triangle[region_of[piece]];
        }
        std::erase_if(sides_, [&](const Side& side) {
            return needless_[number_of_[side.upward ? side.low : side.high]] != 0;
        });
        regions.first_border.assign(regions.first_triangle.size(), 0);
        for (const Side& side : sides_) ++regions.first_border[region_of[side.triangle - first_piece_]];
        make_offsets(regions.first_triangle);
        make_offsets(regions.first_border);
        regions.triangles.resize(pieces());
        regions.borders.resize(sides_.size());
        std::vector<std::uint32_t> next(regions.first_triangle);
        for (std::uint32_t piece = 0; piece < pieces(); ++piece)
            regions.triangles[next[region_of[piece]]++] = piece + static_cast<std::uint32_t>(first_piece_);
        next = regions.first_border;
        for (const Side& side : sides_)
            regions.borders[next[region_of[side.triangle - first_piece_]]++] = straight_border(side);
        return regions;
    }

    Surface rebuild() {
        Regions regions = collect_regions();
        const std::vector<std::size_t> chunk = balanced_chunks(
            regions.size(), 64, 1024, [&](std::size_t i) { return regions[i].triangles.size(); });
        std::vector<Polygons> made(chunk.size() - 1);
        const auto is_needed = [&](PointId point) { return !needless_[number_of_[point]]; };
        parallel_chunks(context_, made.size(), 1, [&](std::size_t part, std::size_t) {
            RegionTriangulator triangulator(surface_, soup_, faces_, points_, made[part]);
            for (std::size_t i = chunk[part]; i < chunk[part + 1]; ++i)
                triangulator.run(regions[i], is_needed);
        });
        surface_.merged.clear();
        std::vector<std::size_t> begin{first_piece_};
        for (const Polygons& part : made) {
            begin.push_back(begin.back() + part.triangles.size());
            surface_.merged.insert(surface_.merged.end(), part.merged.begin(), part.merged.end());
        }
        surface_.triangles.resize(begin.back());
        surface_.facets.resize(begin.back());
        parallel_chunks(context_, made.size(), 16, [&](std::size_t first, std::size_t last) {
            for (std::size_t part = first; part < last; ++part) {
                std::copy(made[part].triangles.begin(), made[part].triangles.end(),
                          surface_.triangles.data() + begin[part]);
                std::copy(made[part].facets.begin(), made[part].facets.end(),
                          surface_.facets.data() + begin[part]);
            }
        });
        return std::move(surface_);
    }

    Surface surface_;
    const Soup& soup_;
    const Faces& faces_;
    const PointTable& points_;
    const Context& context_;
    std::size_t first_piece_;
    std::vector<std::uint32_t> number_of_;
    std::vector<Borders> borders_;
    std::vector<char> pinned_, needless_;
    std::vector<Side> sides_;  ///< all, then only those of pieces at borders
    mesh::DisjointSets sets_;
};

}  // namespace

Surface merge_coplanar(Surface surface, const Soup& soup, const Faces& faces, const PointTable& points,
                       const Context& context) {
    return CoplanarMerge(std::move(surface), soup, faces, points, context).run();
}

}  // namespace octavo::boolean
