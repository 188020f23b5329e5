// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/assemble.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

/// Two facets that belong together at an edge with more than two.
struct Pair {
    PointId low, high;
    std::uint32_t down, up;  ///< triangles that run from high to low, and from low to high
};

int index_of(const mesh::Triangle& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex ? 0 : triangle[1] == vertex ? 1 : 2;
}

/// Gives every fan at a special point a vertex of its own.
class FanSplitter {
  public:
    FanSplitter(const Surface& surface, const Soup& soup, const PointTable& points,
                const std::vector<char>& special)
        : surface_(surface), soup_(soup), points_(points), special_(special), sets_(0) {}

    /// Renames the corners of `triangles` from point ids to vertex numbers and appends the point of each vertex.
    void run(std::vector<mesh::Triangle>& triangles, std::vector<PointId>& point_of_vertex) {
        gather();
        for (PointId point = 0; point < special_.size(); ++point)
            if (begin_[point] != begin_[point + 1]) join_at(point);
        std::vector<std::uint32_t> vertex_of_fan(corners_.size(), no_index),
            vertex_of_point(special_.size(), no_index);
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const PointId point = surface_.triangles[i][k];
                std::uint32_t& vertex =
                    special_[point]
                        ? vertex_of_fan[sets_.find(slot_of(point, 4 * static_cast<std::uint32_t>(i) + k))]
                        : vertex_of_point[point];
                if (vertex == no_index) {
                    vertex = static_cast<std::uint32_t>(point_of_vertex.size());
                    point_of_vertex.push_back(point);
                    if (special_[point] && vertex_of_point[point] != no_index) ++duplicates;
                    vertex_of_point[point] = vertex;
                }
                triangles[i][k] = vertex;
            }
    }

    std::vector<Pair> pairs;  ///< at edges with more than two facets
    std::size_t duplicates = 0;

  private:
    struct Side {
        PointId other;
        std::uint32_t slot;
        bool leaves;
    };

    void gather() {
        begin_.assign(special_.size() + 1, 0);
        for (const mesh::Triangle& t : surface_.triangles)
            for (const PointId point : t)
                if (special_[point]) ++begin_[point + 1];
        for (std::size_t point = 0; point < special_.size(); ++point) begin_[point + 1] += begin_[point];
        corners_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t i = 0; i < surface_.triangles.size(); ++i)
            for (std::uint32_t k = 0; k < 3; ++k) {
                const PointId point = surface_.triangles[i][k];
                if (special_[point]) corners_[next[point]++] = 4 * i + k;
            }
        sets_ = mesh::DisjointSets(corners_.size());
    }

    std::uint32_t slot_of(PointId point, std::uint32_t corner) const {
        const auto from = corners_.begin() + begin_[point], to = corners_.begin() + begin_[point + 1];
        return static_cast<std::uint32_t>(std::lower_bound(from, to, corner) - corners_.begin());
    }

    void join_at(PointId point) {
        sides_.clear();
        for (std::uint32_t slot = begin_[point]; slot < begin_[point + 1]; ++slot) {
            const mesh::Triangle& t = surface_.triangles[corners_[slot] / 4];
            const std::uint32_t k = corners_[slot] % 4;
            sides_.push_back({t[(k + 1) % 3], slot, true});
            sides_.push_back({t[(k + 2) % 3], slot, false});
        }
        std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) {
            return a.other != b.other ? a.other < b.other : a.slot < b.slot;
        });
        for (std::size_t i = 0, end; i < sides_.size(); i = end) {
            for (end = i + 1; end < sides_.size() && sides_[end].other == sides_[i].other;) ++end;
            OCTAVO_CHECK((end - i) % 2 == 0, "an edge of the result has an odd number of facets");
            if (end - i == 2)
                sets_.unite(sides_[i].slot, sides_[i + 1].slot);
            else
                join_about(point, {sides_.data() + i, end - i});
        }
    }

    void join_about(PointId point, std::span<const Side> sides) {
        const PointId low = std::min(point, sides[0].other), high = std::max(point, sides[0].other);
        about_.clear();
        for (std::uint32_t i = 0; i < sides.size(); ++i)
            about_.push_back(turned(surface_.plane(soup_, corners_[sides[i].slot] / 4),
                                    sides[i].leaves == (point == low), i));
        sort_about_edge(points_, low, high, about_);
        for (std::size_t i = 0; i < about_.size(); ++i) {
            const std::size_t next = (i + 1) % about_.size();
            const bool is_down = sides[about_[i].entry].leaves != (point == low);
            if (!is_down) continue;  // the solid is after a facet that runs down
            sets_.unite(sides[about_[i].entry].slot, sides[about_[next].entry].slot);
            if (point == low)
                pairs.push_back({low, high, corners_[sides[about_[i].entry].slot] / 4,
                                 corners_[sides[about_[next].entry].slot] / 4});
        }
    }

    const Surface& surface_;
    const Soup& soup_;
    const PointTable& points_;
    const std::vector<char>& special_;
    mesh::DisjointSets sets_;                     ///< over slots of corners_
    std::vector<std::uint32_t> begin_, corners_;  ///< 4 · triangle + k by special point, ascending
    std::vector<Side> sides_;
    std::vector<AboutEdge> about_;
};

/// Where two pairs at one edge share both its vertices, one of them gets a vertex in the middle.
std::size_t separate_pairs(const std::vector<Pair>& pairs, const Surface& surface, mesh::Mesh& mesh) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts;  ///< of a triangle that was split before
    const auto split = [&](std::uint32_t triangle, std::uint32_t a, std::uint32_t b, std::uint32_t middle) {
        std::vector<std::uint32_t>& of = parts[triangle];
        if (of.empty()) of.push_back(triangle);
        for (const std::uint32_t part : of) {
            mesh::Triangle& t = mesh.triangles[part];
            for (int k = 0; k < 3; ++k) {
                if (t[k] != a || t[(k + 1) % 3] != b) continue;
                const mesh::Triangle second{middle, b, t[(k + 2) % 3]};
                t[(k + 1) % 3] = middle;
                of.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
                mesh.triangles.push_back(second);
                const mesh::Source source = mesh.sources[part];
                mesh.sources.push_back(source);
                return;
            }
        }
    };
    // Ends first: splitting moves corners.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
    for (const Pair& pair : pairs) {
        const mesh::Triangle& points = surface.triangles[pair.up];
        const mesh::Triangle& vertices = mesh.triangles[pair.up];
        ends.push_back({vertices[index_of(points, pair.low)], vertices[index_of(points, pair.high)]});
    }
    std::size_t count = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto [low, high] = ends[i];
        if (seen.insert(ends[i]).second) continue;
        const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(0.5 * (mesh.vertices[low] + mesh.vertices[high]));
        split(pairs[i].up, low, high, middle);
        split(pairs[i].down, high, low, middle);
        ++count;
    }
    return count;
}

}  // namespace

void append_dangling(const Surface& dangling, const Soup& soup, const RoundedPoints& rounded,
                     Assembled& result) {
    struct Side {
        PointId low, high;
        std::uint32_t corner;  ///< 3 · facet + k, from which it leaves
        bool upward;
    };
    std::vector<Side> sides;
    for (std::uint32_t i = 0; i < dangling.triangles.size(); ++i)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const PointId from = dangling.triangles[i][k], to = dangling.triangles[i][(k + 1) % 3];
            sides.push_back({std::min(from, to), std::max(from, to), 3 * i + k, from < to});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.corner < b.corner;
    });
    mesh::DisjointSets fans(3 * dangling.triangles.size());
    const auto next = [](std::uint32_t corner) { return corner / 3 * 3 + (corner + 1) % 3; };
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        for (end = i + 1;
             end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;)
            ++end;
        if (end - i != 2 || sides[i].upward == sides[i + 1].upward) continue;
        fans.unite(sides[i].corner, next(sides[i + 1].corner));
        fans.unite(next(sides[i].corner), sides[i + 1].corner);
    }
    std::vector<std::uint32_t> vertex_of_fan(3 * dangling.triangles.size(), no_index);
    for (std::uint32_t i = 0; i < dangling.triangles.size(); ++i) {
        mesh::Triangle corners;
        for (std::uint32_t k = 0; k < 3; ++k) {
            std::uint32_t& vertex = vertex_of_fan[fans.find(3 * i + k)];
            if (vertex == no_index) {
                vertex = static_cast<std::uint32_t>(result.mesh.vertices.size());
                result.mesh.vertices.push_back(rounded.world(dangling.triangles[i][k]));
            }
            corners[k] = vertex;
        }
        result.mesh.triangles.push_back(corners);
        result.mesh.sources.push_back(soup.source(dangling.facets[i].soup_facet));
    }
}

Assembled assemble(const Surface& surface, const Soup& soup, const PointTable& points,
                   const RoundedPoints& rounded, const std::vector<char>& special) {
    Assembled result;
    result.mesh.triangles.resize(surface.triangles.size());
    std::vector<PointId> point_of_vertex;
    FanSplitter splitter(surface, soup, points, special);
    splitter.run(result.mesh.triangles, point_of_vertex);
    result.duplicated_vertices = splitter.duplicates;

    result.mesh.vertices.reserve(point_of_vertex.size());
    for (const PointId point : point_of_vertex) result.mesh.vertices.push_back(rounded.world(point));
    result.mesh.sources.reserve(surface.triangles.size());
    for (const Surface::Facet& facet : surface.facets)
        result.mesh.sources.push_back(soup.source(facet.soup_facet));
    result.split_edges = separate_pairs(splitter.pairs, surface, result.mesh);
    return result;
}

}  // namespace octavo::boolean
