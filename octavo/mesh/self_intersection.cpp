// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>

#include <octavo/base/parallel.hpp>
#include <octavo/base/shared_progress.hpp>
#include <octavo/mesh/facet_octree.hpp>
#include <octavo/mesh/facet_pair.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/self_intersection.hpp>

namespace octavo::mesh {
namespace {

using exact::Point;

// Beyond this many facets at a vertex its pairs are left to the descent, which prunes fans; below, all pairs of
// a star are cheaper.
constexpr std::uint32_t largest_star = 24;

// Lists of fewer facets hold no fan worth looking for.
constexpr std::size_t least_fan = 25;

// Vertices whose stars are searched at once: far above the cost of handing out work.
constexpr std::size_t stars_at_once = 4096;

/// The facets round each vertex; facets that repeat a vertex are left out.
struct Stars {
    std::vector<std::uint32_t> begin;  ///< per vertex, and one past the last
    std::vector<FaceIndex> faces;

    std::span<const FaceIndex> of(VertexIndex vertex) const {
        return {faces.data() + begin[vertex], begin[vertex + std::size_t{1}] - begin[vertex]};
    }
    bool searched(VertexIndex vertex) const { return of(vertex).size() <= largest_star; }
    std::vector<bool> hubs() const {
        std::vector<bool> hubs(begin.size() - 1);
        for (VertexIndex vertex = 0; vertex < hubs.size(); ++vertex) hubs[vertex] = !searched(vertex);
        return hubs;
    }
};

Stars gather_stars(std::span<const Triangle> triangles, std::size_t vertex_count) {
    Stars stars;
    stars.begin.assign(vertex_count + 2, 0);
    const auto for_each_corner = [&](const auto& visit) {
        for (FaceIndex face = 0; face < triangles.size(); ++face)
            if (!names_a_vertex_twice(triangles[face]))
                for (const VertexIndex vertex : triangles[face]) visit(vertex, face);
    };
    for_each_corner([&](VertexIndex vertex, FaceIndex) { ++stars.begin[vertex + std::size_t{2}]; });
    for (std::size_t i = 2; i < stars.begin.size(); ++i) stars.begin[i] += stars.begin[i - 1];
    stars.faces.resize(stars.begin.back());
    for_each_corner([&](VertexIndex vertex, FaceIndex face) {
        stars.faces[stars.begin[vertex + std::size_t{1}]++] = face;
    });
    stars.begin.pop_back();
    return stars;
}

void add(SelfIntersections& found, FacetContact contact, FaceIndex a, FaceIndex b) {
    const FacePair pair{std::min(a, b), std::max(a, b)};
    switch (contact) {
        case FacetContact::none:
            break;
        case FacetContact::touching:
            found.touching.push_back(pair);
            break;
        case FacetContact::penetrating:
            found.penetrating.push_back(pair);
            break;
        case FacetContact::crossing:
            found.crossing.push_back(pair);
            break;
        case FacetContact::overlapping:
            found.overlapping.push_back(pair);
            break;
    }
}

Triangle started_at(const Triangle& t, VertexIndex vertex) {
    if (t[0] == vertex) return t;
    return t[1] == vertex ? Triangle{t[1], t[2], t[0]} : Triangle{t[2], t[0], t[1]};
}

/// The pairs of a star that share no lower vertex: so each pair with a common vertex is tested once.
void search_star(std::span<const Point> points, std::span<const Triangle> triangles,
                 std::span<const FaceIndex> faces, VertexIndex vertex, std::vector<Facet>& star,
                 SelfIntersections& found) {
    star.clear();
    for (const FaceIndex face : faces) star.emplace_back(started_at(triangles[face], vertex), points.data());
    for (std::size_t i = 0; i < star.size(); ++i)
        for (std::size_t j = i + 1; j < star.size(); ++j) {
            const Triangle& a = star[i].vertices;
            const Triangle& b = star[j].vertices;
            const bool first = a[1] == b[1] || a[1] == b[2], second = a[2] == b[1] || a[2] == b[2];
            if (!first && !second)
                add(found, contact_at_first_corner(star[i], star[j]), faces[i], faces[j]);
            else if (first != second && (first ? a[1] : a[2]) > vertex)
                add(found, contact(star[i], star[j]), faces[i], faces[j]);
        }
}

/// Finds the pairs that no star has, in one cell after the other.
class CellSearch {
  public:
    CellSearch(std::span<const Point> points, std::span<const Triangle> triangles, const Stars& stars,
               SelfIntersections& found)
        : points_(points), triangles_(triangles), stars_(stars), found_(found) {}

    void operator()(const FacetCell& cell, const NearPairs& pairs) {
        gather(pairs.faces);
        note_ends(cell);
        for (std::size_t i = 0; i < pairs.fresh; ++i) {
            const std::size_t first = pairs.fan ? pairs.fresh : i + 1;
            mark_boxes_that_meet(i, first);
            for (std::size_t j = first; j < pairs.faces.size(); ++j)
                if (meets_[j]) test(i, j, pairs.faces);
        }
    }

  private:
    void gather(std::span<const FaceIndex> faces) {
        facets_.clear();
        for (const FaceIndex face : faces) facets_.emplace_back(triangles_[face], points_.data());
        for (auto* side : {&low_, &high_})
            for (auto& axis : *side) axis.resize(faces.size());
        meets_.resize(faces.size());
        for (std::size_t i = 0; i < faces.size(); ++i) {
            const FacetBox box = box_of(facets_[i].points);
            for (std::size_t axis = 0; axis < 3; ++axis)
                low_[axis][i] = box.low[axis], high_[axis][i] = box.high[axis];
        }
    }

    /// For each corner of each facet that is at a hub: does the side opposite to it enter the cell?
    void note_ends(const FacetCell& cell) {
        ends_inside_.assign(facets_.size(), {true, true, true});
        if (facets_.size() < least_fan) return;
        for (std::size_t i = 0; i < facets_.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner)
                if (!stars_.searched(facets_[i].vertices[corner]))
                    ends_inside_[i][corner] =
                        enters(facets_[i].points[(corner + 1) % 3], facets_[i].points[(corner + 2) % 3],
                               cell.low, cell.side);
    }

    /// Six comparisons an entry in a loop without branches, which compilers make eight entries wide.
    void mark_boxes_that_meet(std::size_t i, std::size_t first) {
        const std::int32_t lx = low_[0][i], ly = low_[1][i], lz = low_[2][i];
        const std::int32_t hx = high_[0][i], hy = high_[1][i], hz = high_[2][i];
        const std::int32_t *low_x = low_[0].data(), *low_y = low_[1].data(), *low_z = low_[2].data();
        const std::int32_t *high_x = high_[0].data(), *high_y = high_[1].data(), *high_z = high_[2].data();
        std::int32_t* meets = meets_.data();
        const std::size_t count = meets_.size();
        for (std::size_t j = first; j < count; ++j)
            meets[j] = (low_x[j] <= hx) & (high_x[j] >= lx) & (low_y[j] <= hy) & (high_y[j] >= ly) &
                       (low_z[j] <= hz) & (high_z[j] >= lz);
    }

    void test(std::size_t i, std::size_t j, std::span<const FaceIndex> faces) {
        const Triangle& a = facets_[i].vertices;
        const Triangle& b = facets_[j].vertices;
        VertexIndex least = ~VertexIndex{0};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l) {
                if (a[k] != b[l]) continue;
                // What they have in common beyond this vertex ends on a side opposite to it: not in this cell.
                if (!ends_inside_[i][k] && !ends_inside_[j][l]) return;
                least = std::min(least, a[k]);
            }
        if (least != ~VertexIndex{0} && stars_.searched(least)) return;
        add(found_, contact(facets_[i], facets_[j]), faces[i], faces[j]);
    }

    std::span<const Point> points_;
    std::span<const Triangle> triangles_;
    const Stars& stars_;
    SelfIntersections& found_;
    std::vector<Facet> facets_;
    std::vector<std::array<bool, 3>> ends_inside_;  ///< by facet and corner
    std::array<std::vector<std::int32_t>, 3> low_, high_;
    std::vector<std::int32_t> meets_;
};

SelfIntersections merged(std::span<const SelfIntersections> parts) {
    SelfIntersections all;
    for (const auto list : {&SelfIntersections::crossing, &SelfIntersections::penetrating,
                            &SelfIntersections::overlapping, &SelfIntersections::touching}) {
        std::vector<FacePair>& pairs = all.*list;
        for (const SelfIntersections& part : parts)
            pairs.insert(pairs.end(), (part.*list).begin(), (part.*list).end());
        std::sort(pairs.begin(), pairs.end());
        // A pair is found in every cell that both enter.
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    }
    return all;
}

}  // namespace

Result<SelfIntersections> find_self_intersections(std::span<const Point> points,
                                                  std::span<const Triangle> triangles,
                                                  const Context& context) {
    const Stars stars = gather_stars(triangles, points.size());
    std::vector<SelfIntersections> found((points.size() + stars_at_once - 1) / stars_at_once);
    constexpr std::string_view phase = "self-intersections";
    SharedProgress in_stars(context, phase, found.size(), 0, 0.4);
    parallel_chunks(context, points.size(), stars_at_once, [&](std::size_t begin, std::size_t end) {
        std::vector<Facet> star;
        for (auto vertex = static_cast<VertexIndex>(begin); vertex < end; ++vertex)
            if (stars.searched(vertex))
                search_star(points, triangles, stars.of(vertex), vertex, star, found[begin / stars_at_once]);
        in_stars.step();
    });

    if (context.cancelled()) return Context::cancelled_error();
    const std::vector<bool> hubs = stars.hubs();
    const PairSearch search{points, triangles, hubs};
    const std::vector<PairTask> tasks = make_pair_tasks(search, context);
    if (context.cancelled()) return Context::cancelled_error();
    const std::size_t first_task = found.size();
    found.resize(first_task + tasks.size());
    SharedProgress in_cells(context, phase, tasks.size(), 0.5, 1);
    parallel_chunks(context, tasks.size(), 1, [&](std::size_t task, std::size_t) {
        CellSearch cell_search(points, triangles, stars, found[first_task + task]);
        for_near_pairs(tasks[task], search, std::ref(cell_search));
        in_cells.step();
    });
    if (context.cancelled()) return Context::cancelled_error();
    return merged(found);
}

}  // namespace octavo::mesh
