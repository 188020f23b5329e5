// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/cells.hpp>
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
        constexpr std::size_t grain = 1 << 14;
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
            for (std::size_t number = begin; number < end; ++number)
                std::sort(sides_.begin() + begin_of[number], sides_.begin() + begin_of[number + 1],
                          [](const Side& a, const Side& b) {
                              return a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
                          });
        });
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
            for (end = i + 1; end < sides_.size() && sides_[end].low == sides_[i].low &&
                              sides_[end].high == sides_[i].high;)
                ++end;
            const std::span<const Side> edge{sides_.data() + i, end - i};
            if (is_inner(edge)) {
                sets_.unite(edge[0].triangle - static_cast<std::uint32_t>(first_piece_),
                            edge[1].triangle - static_cast<std::uint32_t>(first_piece_));
                continue;
            }
            borders_[number_of_[sides_[i].low]].add(sides_[i].high);
            borders_[number_of_[sides_[i].high]].add(sides_[i].low);
            for (const Side& side : edge)
                if (side.triangle >= first_piece_) sides_[borders++] = side;
        }
        sides_.resize(borders);
    }

    void find_needless() {
        needless_.assign(borders_.size(), 0);
        for (PointId point = 0; point < number_of_.size(); ++point) {
            const std::uint32_t number = number_of_[point];
            if (number == no_index || pinned_[number]) continue;
            const Borders& borders = borders_[number];
            if (borders.more) continue;
            if (borders.neighbour[0] == no_index) {
                needless_[number] = 1;
            } else if (borders.neighbour[1] != no_index) {
                const int axis = surface_.plane(soup_, borders.triangle).dominant_axis();
                needless_[number] =
                    points_.is_between(axis, borders.neighbour[0], point, borders.neighbour[1]);
            }
        }
    }

    struct Region {
        std::vector<std::uint32_t> triangles;             ///< of the surface
        std::vector<std::pair<PointId, PointId>> border;  ///< directed, needless points skipped
        std::vector<std::uint32_t> soup_facets;           ///< that it has parts of, ascending
        Surface::Facet name;                              ///< the first of these
        std::vector<mesh::Triangle> merged;
    };

    std::vector<Region> collect_regions() {
        std::vector<Region> regions;
        std::vector<std::uint32_t> region_of(pieces());
        for (std::uint32_t piece = 0; piece < pieces(); ++piece) {
            const std::uint32_t root = sets_.find(piece);
            if (root == piece) {
                region_of[piece] = static_cast<std::uint32_t>(regions.size());
                regions.emplace_back();
            }
            region_of[piece] = region_of[root];
            regions[region_of[piece]].triangles.push_back(piece + static_cast<std::uint32_t>(first_piece_));
        }
        for (const Side& side : sides_) {
            PointId from = side.upward ? side.low : side.high, to = side.upward ? side.high : side.low;
            if (needless_[number_of_[from]]) continue;
            const PointId start = from;
            while (needless_[number_of_[to]]) {
                const Borders& borders = borders_[number_of_[to]];
                const PointId next =
                    borders.neighbour[0] == from ? borders.neighbour[1] : borders.neighbour[0];
                from = to, to = next;
            }
            regions[region_of[side.triangle - first_piece_]].border.push_back({start, to});
        }
        return regions;
    }

    void name(Region& region) const {
        region.name = surface_.facets[region.triangles[0]];
        for (const std::uint32_t triangle : region.triangles) {
            const Surface::Facet facet = surface_.facets[triangle];
            if (facet.soup_facet < region.name.soup_facet) region.name = facet;
            region.soup_facets.push_back(facet.soup_facet);
            const std::uint32_t partner = faces_.partner(facet.soup_facet);
            if (partner != no_index) region.soup_facets.push_back(partner);
        }
        std::sort(region.soup_facets.begin(), region.soup_facets.end());
        region.soup_facets.erase(std::unique(region.soup_facets.begin(), region.soup_facets.end()),
                                 region.soup_facets.end());
    }

    /// The region's triangles, from its border alone.
    std::vector<mesh::Triangle> triangulate(Region& region, Subdivision& subdivision) const {
        const Plane plane = surface_.plane(soup_, region.triangles[0]);
        std::vector<exact::Point> corners;
        for (const std::uint32_t facet : region.soup_facets)
            for (const std::uint32_t corner : soup_.facets[facet]) corners.push_back(soup_.points[corner]);
        subdivision.begin_round(plane, corners);
        std::vector<Subdivision::PointOnLine> points;
        for (const auto& [from, to] : region.border) points.push_back({from, Subdivision::no_line});
        // A point inside may be needed too: something touches the region there.
        for (const std::uint32_t triangle : region.triangles)
            for (const PointId point : surface_.triangles[triangle])
                if (!needless_[number_of_[point]]) points.push_back({point, Subdivision::no_line});
        subdivision.add_points(points);
        // A border that the region has on both sides does not lead out of it.
        constexpr std::uint32_t border = 0, slit = 1;
        std::sort(region.border.begin(), region.border.end());
        for (const auto& [from, to] : region.border) {
            const bool both =
                std::binary_search(region.border.begin(), region.border.end(), std::pair{to, from});
            subdivision.add_segment(subdivision.vertex_of(from), subdivision.vertex_of(to),
                                    Subdivision::no_line, both ? slit : border);
        }
        subdivision.refine();

        const auto all = subdivision.triangles();
        const Cells cells = find_cells(subdivision, slit);
        std::vector<mesh::Triangle> triangles;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!cells.covers[cells.of_triangle[i]].empty())
                triangles.push_back({subdivision.point_of(all[i].v[0]), subdivision.point_of(all[i].v[1]),
                                     subdivision.point_of(all[i].v[2])});
        return triangles;
    }

    Surface rebuild() {
        std::vector<Region> regions = collect_regions();
        parallel_chunks(context_, regions.size(), 64, [&](std::size_t begin, std::size_t end) {
            Subdivision subdivision(points_);
            for (std::size_t i = begin; i < end; ++i) {
                name(regions[i]);
                if (regions[i].triangles.size() > 1)
                    regions[i].merged = triangulate(regions[i], subdivision);
                else
                    regions[i].merged = {surface_.triangles[regions[i].triangles[0]]};
            }
        });
        surface_.triangles.resize(first_piece_);
        surface_.facets.resize(first_piece_);
        surface_.merged.clear();
        for (const Region& region : regions) {
            surface_.triangles.insert(surface_.triangles.end(), region.merged.begin(), region.merged.end());
            surface_.facets.insert(surface_.facets.end(), region.merged.size(), region.name);
            if (region.soup_facets.size() < 2) continue;
            for (const std::uint32_t part : region.soup_facets)
                surface_.merged.emplace_back(part, std::uint32_t{region.name.soup_facet});
        }
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
