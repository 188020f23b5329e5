// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bsp/plane_table.hpp>
#include <octavo/exact/homogeneous_point.hpp>
#include <octavo/exact/side.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/cell.hpp>

// Convex pieces of faces, cut by planes exactly.
//
// A fragment lies in one plane of the table and is bounded by lines in it: each corner knows the vertex and what
// bounds the fragment from there to the next corner, which is another plane, the wall of a cell or a side of an input
// triangle. A cut makes its new vertices from the bounding line and the cutting plane, never from other constructed
// vertices: three planes (at most 190 bits) or a lattice edge and a plane (109 bits), however often it was cut.
//
// Cell walls lie between the lattice's points: a cell of lattice points low … low + side − 1 is the open box from
// low − ½ to low + side − ½. So no vertex of the input lies on a wall and no axis-parallel input face lies in one,
// which is the case that half-open cells with integer walls would have to treat apart in every algorithm. (Campen and
// Kobbelt, Exact and robust (self-)intersections for polygonal meshes, 2010.)
//
// Rings run counter-clockwise seen from where the plane's normal points, whichever way the face looks.
// Vertices that a cut makes on a common edge of two fragments are one vertex: fragments that were neighbours share
// ids, and signs of vertices are asked once.

namespace octavo::bsp {

/// What cuts or bounds: a plane of the table, a wall of a cell, or (as a bound only) a side of an input triangle.
struct Bound {
    std::uint32_t bits = 0;

    static constexpr Bound plane(PlaneId id) { return {id}; }
    /// Coordinate `axis` equals `twice` / 2, with twice in [-1, 2^27).
    static constexpr Bound wall(int axis, std::int32_t twice) {
        return {std::uint32_t{1} << 31 | static_cast<std::uint32_t>(axis) << 28 |
                static_cast<std::uint32_t>(twice + 1)};
    }
    /// Side k of input triangle t is 3 t + k.
    static constexpr Bound side(std::uint32_t side) { return {std::uint32_t{1} << 30 | side}; }

    constexpr bool is_wall() const { return bits >> 31; }
    constexpr bool is_side() const { return bits >> 30 == 1; }
    constexpr bool is_plane() const { return bits >> 30 == 0; }
    constexpr PlaneId plane_id() const { return bits; }
    constexpr std::uint32_t side_index() const { return bits & ((std::uint32_t{1} << 30) - 1); }
    constexpr int axis() const { return static_cast<int>(bits >> 28 & 3); }
    constexpr std::int32_t twice() const {
        return static_cast<std::int32_t>(bits & ((std::uint32_t{1} << 28) - 1)) - 1;
    }
    friend constexpr bool operator==(Bound, Bound) = default;
};

/// The plane of a wall.
constexpr exact::Plane wall_plane(int axis, std::int32_t twice) {
    return exact::Plane::from_coefficients(axis == 0 ? 2 : 0, axis == 1 ? 2 : 0, axis == 2 ? 2 : 0,
                                           -exact::int128{twice});
}
/// Twice the coordinates of a cell's low and high walls.
constexpr std::int32_t low_wall(const octree::Cell& cell, int axis) { return 2 * cell.low[axis] - 1; }
constexpr std::int32_t high_wall(const octree::Cell& cell, int axis) {
    return 2 * (cell.low[axis] + cell.side()) - 1;
}

using VertexId = std::uint32_t;

struct Corner {
    VertexId vertex;
    Bound edge;  ///< from here to the next corner
};

struct Fragment {
    std::uint32_t begin = 0, count = 0;  ///< corners in the pool
    Facing facing;
    std::uint32_t source = 0;  ///< input triangle, where there is one
};

/// Owns corners and vertices of many fragments; everything made after a mark can be thrown away at once.
class FragmentPool {
  public:
    explicit FragmentPool(const PlaneTable& planes) : planes_(planes) {}
    /// Fragments of these triangles may be added.
    FragmentPool(const PlaneTable& planes, std::span<const exact::Point> points,
                 std::span<const mesh::Triangle> triangles)
        : planes_(planes), points_(points), triangles_(triangles) {}

    const PlaneTable& planes() const { return planes_; }

    /// The whole of an input triangle, which lies in a plane as `facing` says.
    Fragment triangle(std::uint32_t index, Facing facing);
    /// The convex polygon in which a plane meets a cell; no corners when it misses the open cell.
    Fragment section(PlaneId plane, const octree::Cell& cell);

    std::span<const Corner> corners(const Fragment& f) const { return {corners_.data() + f.begin, f.count}; }

    bool is_lattice(VertexId vertex) const { return !(vertex >> 31); }
    exact::Point lattice(VertexId vertex) const { return points_[vertex]; }
    const exact::TriplePoint& constructed(VertexId vertex) const {
        return constructed_[vertex & ~constructed_bit];
    }
    Vec3 approximation(VertexId vertex) const {
        if (!is_lattice(vertex)) return constructed(vertex).approximation();
        const exact::Point p = points_[vertex];
        return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    }

    /// The ends of a side of an input triangle.
    std::array<exact::Point, 2> ends_of(Bound side) const {
        const mesh::Triangle& t = triangles_[side.side_index() / 3];
        const std::uint32_t k = side.side_index() % 3;
        return {points_[t[k]], points_[t[(k + 1) % 3]]};
    }

    exact::Sign side_of(const exact::Plane& plane, VertexId vertex) const {
        return is_lattice(vertex) ? exact::side_of(plane, points_[vertex])
                                  : exact::side_of(plane, constructed(vertex));
    }

    /// The plane of a bound that is no side.
    exact::Plane plane_of(Bound bound) const {
        return bound.is_wall() ? wall_plane(bound.axis(), bound.twice()) : planes_[bound.plane_id()];
    }

    /// Tells that the next splits are by this plane, so that they can share vertices.
    void begin_cut(Bound bound);
    void begin_cut(Bound bound, const exact::Plane& plane);

    /// Where a fragment lies that the current cut is asked about.
    enum class Place : std::uint8_t { front, back, both, within };
    /// Sets the signs that `split` works with. `within`: the fragment lies in the plane.
    Place place(const Fragment& f);
    /// Whether the fragment that was placed last has an edge in the cut.
    bool has_edge_in_cut() const;
    /// Cuts a fragment that lies on both sides.
    void split(const Fragment& f, Fragment& front, Fragment& back);

    /// The vertex in which an edge that starts at corner `corner` of a fragment meets the current cut.
    VertexId cut_edge(PlaneId plane, Corner corner, VertexId next);

    struct Mark {
        std::size_t corners, vertices;
    };
    Mark mark() const { return {corners_.size(), constructed_.size()}; }
    void release(Mark mark);

    static constexpr VertexId constructed_bit = VertexId{1} << 31;

  private:
    template <class Side>
    Place place(const Fragment& f, const Side& side);
    VertexId construct(PlaneId plane, Bound edge);
    VertexId push(const exact::TriplePoint& point);

    struct Made {
        std::uint64_t edge = 0;  ///< its ends
        VertexId vertex = 0;
        std::uint32_t cut = 0;
    };

    const PlaneTable& planes_;
    std::span<const exact::Point> points_;
    std::span<const mesh::Triangle> triangles_;
    std::vector<Corner> corners_, back_;
    std::vector<exact::TriplePoint> constructed_;

    Bound bound_;
    exact::Plane plane_;
    std::vector<std::int8_t> signs_;
    std::vector<Made> made_{std::vector<Made>(64)};  ///< hash table of vertices by edge, for the current cut
    std::uint32_t cut_ = 0, made_now_ = 0;
};

/// Splits a convex ring: `sign(i)` of corner i against the cut, not all of one sign; `meet(i)` makes the vertex in
/// which the edge from corner i meets it. Appends the parts to `front` and `back`.
template <class Sign, class Meet>
void split_ring(std::span<const Corner> ring, Bound cut, const Sign& sign, const Meet& meet,
                std::vector<Corner>& front, std::vector<Corner>& back) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const std::size_t next = i + 1 == ring.size() ? 0 : i + 1;
        const Corner corner = ring[i];
        const int here = sign(i), there = sign(next);
        if (here == 0) {
            front.push_back(there > 0 ? corner : Corner{corner.vertex, cut});
            back.push_back(there < 0 ? corner : Corner{corner.vertex, cut});
            continue;
        }
        (here > 0 ? front : back).push_back(corner);
        if (here * there >= 0) continue;
        const VertexId vertex = meet(i);
        (here > 0 ? front : back).push_back({vertex, cut});
        (here > 0 ? back : front).push_back({vertex, corner.edge});
    }
}

}  // namespace octavo::bsp
