// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <map>
#include <set>

#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/assemble.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
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

/// The corners at special points, as 4 · triangle + k, in one list: those of a point from `begin[point]` on, ascending.
/// Their places in the list are called slots.
struct SpecialCorners {
    std::vector<std::uint32_t> begin, corners;

    std::uint32_t slot_of(PointId point, std::uint32_t corner) const {
        const auto from = corners.begin() + begin[point], to = corners.begin() + begin[point + 1];
        return static_cast<std::uint32_t>(std::lower_bound(from, to, corner) - corners.begin());
    }
};

/// Joins the corners at special points to fans.
class FanJoiner {
  public:
    FanJoiner(const Surface& surface, const Soup& soup, const PointTable& points,
              const SpecialCorners& special, mesh::DisjointSets& fans, std::vector<Pair>& pairs)
        : surface_(surface), soup_(soup), points_(points), special_(special), fans_(fans), pairs_(pairs) {}

    /// Unites slots of this point only.
    void join_at(PointId point) {
        sides_.clear();
        for (std::uint32_t slot = special_.begin[point]; slot < special_.begin[point + 1]; ++slot) {
            const mesh::Triangle& t = surface_.triangles[special_.corners[slot] / 4];
            const std::uint32_t k = special_.corners[slot] % 4;
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
                fans_.unite(sides_[i].slot, sides_[i + 1].slot);
            else
                join_about(point, {sides_.data() + i, end - i});
        }
    }

  private:
    struct Side {
        PointId other;
        std::uint32_t slot;
        bool leaves;
    };

    void join_about(PointId point, std::span<const Side> sides) {
        const PointId low = std::min(point, sides[0].other), high = std::max(point, sides[0].other);
        const auto triangle_of = [&](const Side& side) { return special_.corners[side.slot] / 4; };
        about_.clear();
        for (std::uint32_t i = 0; i < sides.size(); ++i)
            about_.push_back(
                turned(surface_.plane(soup_, triangle_of(sides[i])), sides[i].leaves == (point == low), i));
        sort_about_edge(points_, low, high, about_);
        for (std::size_t i = 0; i < about_.size(); ++i) {
            const Side &side = sides[about_[i].entry], &next = sides[about_[(i + 1) % about_.size()].entry];
            const bool is_down = side.leaves != (point == low);
            if (!is_down) continue;  // the solid is after a facet that runs down
            fans_.unite(side.slot, next.slot);
            if (point == low) pairs_.push_back({low, high, triangle_of(side), triangle_of(next)});
        }
    }

    const Surface& surface_;
    const Soup& soup_;
    const PointTable& points_;
    const SpecialCorners& special_;
    mesh::DisjointSets& fans_;
    std::vector<Pair>& pairs_;
    std::vector<Side> sides_;
    std::vector<AboutEdge> about_;
};

/// Gives every point of the surface a vertex, and every fan at a special point one of its own. Vertices are in the
/// order of the points.
class VertexNumbering {
  public:
    VertexNumbering(const Surface& surface, const std::vector<char>& special, const Context& context)
        : surface_(surface), special_(special), context_(context), is_used_(special.size(), 0), fans_(0) {
        gather();
    }

    void join_fans(const Soup& soup, const PointTable& points) {
        std::vector<std::vector<Pair>> found((special_.size() + grain - 1) / grain);
        parallel_chunks(context_, special_.size(), grain, [&](std::size_t begin, std::size_t end) {
            FanJoiner joiner(surface_, soup, points, corners_, fans_, found[begin / grain]);
            for (std::size_t point = begin; point < end; ++point)
                if (corners_.begin[point] != corners_.begin[point + 1])
                    joiner.join_at(static_cast<PointId>(point));
        });
        for (const std::vector<Pair>& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    }

    /// Makes the vertices of `mesh`, its triangles, and room for their sources.
    void run(const RoundedPoints& rounded, mesh::Mesh& mesh) {
        const std::vector<std::size_t> offset =
            chunk_offsets(context_, special_.size(), grain, [&](std::size_t begin, std::size_t end) {
                std::size_t count = 0;
                for (std::size_t point = begin; point < end; ++point) count += vertices_at(point);
                return count;
            });
        // Zeroing these and bringing in their pages is much of the phase: each on a thread.
        const std::size_t triangles = surface_.triangles.size();
        parallel_chunks(context_, 3, 1, [&](std::size_t task, std::size_t) {
            if (task == 0) mesh.vertices.resize(offset.back());
            if (task == 1) mesh.triangles.resize(triangles);
            if (task == 2) mesh.sources.resize(triangles);
        });
        if (context_.cancelled()) return;
        vertex_of_point_.resize(special_.size());
        vertex_of_slot_.resize(corners_.corners.size());
        parallel_chunks(context_, special_.size(), grain, [&](std::size_t begin, std::size_t end) {
            auto vertex = static_cast<std::uint32_t>(offset[begin / grain]);
            for (std::size_t point = begin; point < end; ++point) {
                const std::uint32_t first = vertex;
                if (special_[point]) {
                    vertex = number_fans(point, vertex);
                } else {
                    vertex_of_point_[point] = vertex;
                    vertex += is_used_[point] != 0;
                }
                for (std::uint32_t v = first; v < vertex; ++v)
                    mesh.vertices[v] = rounded.world(static_cast<PointId>(point));
            }
        });
        parallel_chunks(context_, triangles, grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::uint32_t k = 0; k < 3; ++k)
                    mesh.triangles[i][k] =
                        vertex_of(surface_.triangles[i][k], 4 * static_cast<std::uint32_t>(i) + k);
        });
    }

    std::vector<Pair> pairs;  ///< at edges with more than two facets
    std::size_t used_points() const {
        return static_cast<std::size_t>(std::count(is_used_.begin(), is_used_.end(), 1));
    }

  private:
    static constexpr std::size_t grain = 1 << 10;

    /// Which points are used, and the corners at special ones. Threads mark points at the same time, all with the same.
    void gather() {
        struct Found {
            PointId point;
            std::uint32_t corner;
        };
        std::vector<std::vector<Found>> found((surface_.triangles.size() + grain - 1) / grain);
        parallel_chunks(context_, surface_.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const PointId point = surface_.triangles[i][k];
                    const std::atomic_ref<char> is_used(is_used_[point]);
                    if (!is_used.load(std::memory_order_relaxed)) is_used.store(1, std::memory_order_relaxed);
                    if (special_[point])
                        found[begin / grain].push_back({point, 4 * static_cast<std::uint32_t>(i) + k});
                }
        });
        corners_.begin.assign(special_.size() + 2, 0);
        for (const std::vector<Found>& part : found)
            for (const Found& each : part) ++corners_.begin[each.point + 2];
        for (std::size_t point = 2; point < corners_.begin.size(); ++point)
            corners_.begin[point] += corners_.begin[point - 1];
        corners_.corners.resize(corners_.begin.back());
        for (const std::vector<Found>& part : found)
            for (const Found& each : part) corners_.corners[corners_.begin[each.point + 1]++] = each.corner;
        fans_ = mesh::DisjointSets(corners_.corners.size());
    }

    /// How many vertices a point gets. Fans are told by their first slots.
    std::size_t vertices_at(std::size_t point) {
        if (!special_[point]) return is_used_[point] != 0;
        std::size_t fans = 0;
        for (std::uint32_t slot = corners_.begin[point]; slot < corners_.begin[point + 1]; ++slot)
            fans += fans_.find(slot) == slot;
        return fans;
    }

    /// Gives the fans at a special point the vertices from `next` on; returns the next one after them.
    std::uint32_t number_fans(std::size_t point, std::uint32_t next) {
        for (std::uint32_t slot = corners_.begin[point]; slot < corners_.begin[point + 1]; ++slot) {
            const std::uint32_t first = fans_.find(slot);
            vertex_of_slot_[slot] = first == slot ? next++ : vertex_of_slot_[first];
        }
        return next;
    }

    std::uint32_t vertex_of(PointId point, std::uint32_t corner) const {
        return special_[point] ? vertex_of_slot_[corners_.slot_of(point, corner)] : vertex_of_point_[point];
    }

    const Surface& surface_;
    const std::vector<char>& special_;
    const Context& context_;
    std::vector<char> is_used_;
    SpecialCorners corners_;
    mesh::DisjointSets fans_;  ///< over slots; those of different points are never united
    UninitialisedVector<std::uint32_t> vertex_of_point_, vertex_of_slot_;
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
                   const RoundedPoints& rounded, const std::vector<char>& special, const Context& context) {
    Assembled result;
    VertexNumbering numbering(surface, special, context);
    numbering.join_fans(soup, points);
    numbering.run(rounded, result.mesh);
    if (context.cancelled()) return result;
    result.duplicated_vertices = result.mesh.vertices.size() - numbering.used_points();

    parallel_chunks(context, surface.facets.size(), 1 << 12, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            result.mesh.sources[i] = soup.source(surface.facets[i].soup_facet);
    });
    result.split_edges = separate_pairs(numbering.pairs, surface, result.mesh);
    return result;
}

}  // namespace octavo::boolean
