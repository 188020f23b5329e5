// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/triangulation.hpp>
#include <octavo/exact/plane.hpp>

// A triangulation of a part of one lattice plane that holds given points and segments: the arrangement of all that
// cuts a facet, or of facets that overlap in one plane.
//
// Idea: a triangulation is its own search structure. A point is located by walking to it and splits a triangle or
// an edge. A segment is followed from its start: past vertices that lie on it, along edges that already run its
// way, and through edges in its way. A free edge in its way is flipped away; a fixed edge is crossed in the point
// that the planes behind both segments have in common with this plane, which becomes a vertex. So crossings,
// overlaps and T-contacts of segments need no search and no cases of their own. Everything is decided by the exact
// turn of three points, seen along the plane's dominant axis. Points of one line would all need exact arithmetic for
// that; but mostly they are known to lie on it because of how they came about, so vertices note their lines.
//
// Invariants: every triangle turns counter-clockwise seen from the front of the plane; every vertex is a different
// point; an edge of the triangulation that lies on an inserted segment is fixed and knows the owners of all
// segments on it; a segment ends where it ends.
// Cost: about 0.2 µs a point plus the walk to it. Memory is reused by the next `begin`.
// Sources: A. Lawson, Software for C1 surface interpolation, 1977 (walk, flips); S. Sloan, A fast algorithm for
// generating constrained Delaunay triangulations, 1993 (edges by flips). Triangles here are not Delaunay unless
// `refine` is called.

namespace octavo::boolean {

class Subdivision {
  public:
    using VertexId = Triangulation::VertexId;
    using TriangleId = Triangulation::TriangleId;
    /// An edge's owner is 1 + the index of the first in its chain, or 0: it is free.
    using Triangle = Triangulation::Triangle;

    /// A chain of what lies on a fixed edge.
    struct Owner {
        std::uint32_t line = 0;  ///< that the segment lies on
        std::uint32_t tag = 0;   ///< the caller's name for the segment
        std::uint32_t next = 0;  ///< 1 + index of the next owner; 0 ends the chain
    };

    /// `cut_planes` are the planes that lines of this number lie in; they must stay.
    explicit Subdivision(const PointTable& points, std::span<const exact::Plane> cut_planes = {})
        : points_(points), cut_planes_(cut_planes) {}

    /// Starts with a triangle, or a strictly convex quadrilateral, of lattice points of `plane` (or any that, seen
    /// along the plane's dominant axis, surround all that will be inserted). They become the vertices 0, 1, 2 and 3 and
    /// must turn counter-clockwise seen from the plane's front; `ids` are their point ids, no_index for points that are
    /// in no table.
    void begin(const exact::Plane& plane, std::span<const exact::Point> corners,
               std::span<const PointId> ids);

    /// Starts with a triangle that holds these points strictly inside. Its corners are in no table.
    void begin_round(const exact::Plane& plane, std::span<const exact::Point> points);

    /// Where segments lie: the line that this plane has in common with another one. Numbers below that of the cut
    /// planes are theirs; more are made by `add_line`. Equal lines should have equal numbers, for speed.
    using LineId = std::uint32_t;
    static constexpr LineId no_line = ~LineId{0};

    LineId add_line(const exact::Plane& plane) {
        lines_.push_back(plane);
        return static_cast<LineId>(cut_planes_.size() + lines_.size() - 1);
    }

    /// The vertex at a point of the plane inside or on the first triangle; the same vertex for the same id.
    VertexId add_point(PointId id);

    /// The vertex of a point that has been added.
    VertexId vertex_of(PointId id) const;

    /// A point and a line on which it is known to lie, or `no_line`.
    struct PointOnLine {
        PointId id;
        LineId line;
    };
    /// Adds points before all segments, in an order and with flips that keep large sets fast. Reorders them.
    void add_points(std::vector<PointOnLine>& points);

    /// Fixes the segment between two vertices, which lies on line `line`; with `no_line` it must not cross others.
    void add_segment(VertexId from, VertexId to, LineId line, std::uint32_t tag);

    /// Flips free edges towards a Delaunay triangulation as far as rounded coordinates tell; never across a fixed
    /// edge and never so that a triangle turns over.
    void refine();

    std::span<const Triangle> triangles() const { return mesh_.triangles(); }
    const Owner& owner(std::uint32_t index) const { return owners_[index]; }
    std::size_t vertices() const { return vertices_.size(); }

    /// Point id of a vertex; for a vertex that came about by crossing segments, new_point + its index in
    /// `new_points`.
    std::uint32_t point_of(VertexId vertex) const { return vertices_[vertex].id; }
    static constexpr std::uint32_t new_point = std::uint32_t{1} << 31;
    std::span<const exact::TriplePoint> new_points() const { return new_points_; }

    /// Positive: a, b, c turn counter-clockwise seen from the front of the plane.
    exact::Sign turn(VertexId a, VertexId b, VertexId c) const;

  private:
    struct Vertex {
        double x, y;  ///< seen along the dominant axis, from the front
        std::uint32_t id;
        exact::Point lattice;  ///< where kind says so
        enum class Kind : std::uint8_t { lattice, table, crossing } kind;
        std::array<LineId, 4> lines{no_line, no_line, no_line, no_line};  ///< that it is known to lie on
    };
    struct Location {
        TriangleId triangle;
        int edge;  ///< of the triangle, on which the point lies; -1: inside
    };
    using Edge = Triangulation::Edge;

    VertexId push(const Vertex& vertex);
    VertexId push(PointId id);
    const exact::Plane& plane_of(LineId line) const {
        return line < cut_planes_.size() ? cut_planes_[line] : lines_[line - cut_planes_.size()];
    }
    void note(VertexId vertex, LineId line);
    bool lies_on(VertexId vertex, LineId line) const;
    bool share_line(const Vertex& a, const Vertex& b, const Vertex& c) const;
    void insert(VertexId vertex);
    void legalise(VertexId vertex);
    bool prefers_flip(VertexId a, VertexId b, VertexId c, VertexId d) const;
    template <class Visit>
    decltype(auto) with(const Vertex& vertex, const Visit& visit) const;
    exact::Sign exact_turn(const Vertex& a, const Vertex& b, const Vertex& c) const;
    bool is_ahead(VertexId from, VertexId to, VertexId vertex) const;
    Location locate(VertexId vertex);
    void own(Edge edge, std::uint32_t line, std::uint32_t tag);
    VertexId advance(VertexId from, VertexId to, LineId line, std::uint32_t tag);
    VertexId walk(Edge through, VertexId from, VertexId to, LineId line);
    VertexId cross(Edge fixed, LineId line);
    bool may_flip(Edge edge) const;
    void force_edge(VertexId from, VertexId to);

    const PointTable& points_;
    std::span<const exact::Plane> cut_planes_;
    exact::Plane plane_;
    int axis_ = 2, i_ = 0, j_ = 1;
    bool reversed_ = false;
    std::vector<exact::Plane> lines_;
    std::vector<Vertex> vertices_;
    Triangulation mesh_;
    std::vector<Owner> owners_;
    std::vector<exact::TriplePoint> new_points_;
    std::vector<std::uint32_t> vertex_of_;  ///< hash of point id to vertex
    std::vector<std::pair<VertexId, VertexId>> in_the_way_;
    std::vector<TriangleId> pending_;  ///< triangles whose edge opposite to a new vertex may have to go
    TriangleId hint_ = 0;
    std::uint32_t walk_seed_ = 1;
};

}  // namespace octavo::boolean
