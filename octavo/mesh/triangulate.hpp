// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/ear_clipping.hpp>
#include <octavo/mesh/mesh.hpp>

// From polygons to triangles: concave ones, ones with holes, ones whose corners are not quite in a plane.
//
// The polygon is seen along the coordinate axis nearest to its normal (the sum over its edges, after Newell),
// which changes no coordinate, so all decisions are exact on the very numbers of the file. A polygon that
// crosses itself in that view, as warped ones may, is tried along the other two axes. Three corners are taken
// as they are, four by the fan from the first corner when that is a triangulation, else by the other
// diagonal; everything else by ear clipping.
//
// Guaranteed for any polygon whatever: every corner is used and each edge of its contours is an edge, in the
// same direction, of exactly one triangle; inner edges are used once in either direction. So a polygon mesh
// that is closed gives a closed triangle mesh. (Triangles that would name a vertex twice are left out, as
// their edges cancel.)

namespace octavo::mesh {

/// How a polygon was; later is worse.
enum class PolygonShape : std::uint8_t {
    simple,      ///< all triangles have area and none overlap, in the view along an axis
    degenerate,  ///< some triangles have no area: repeated corners, spikes, or no area at all
    crossing,    ///< it crosses itself in every view (or is not finite): triangles overlap or are turned over
};

struct Triangulation {
    std::span<const Triangle> triangles;  ///< vertex indices; valid until the next call
    PolygonShape shape = PolygonShape::simple;
};

/// Triangulates one polygon after the other and keeps its memory. Not for use by two threads at once.
class Triangulator {
  public:
    Triangulator() = default;
    /// Once `context`, which must outlive the triangulator, is cancelled, the triangles of a large polygon mean
    /// nothing: ask it after each.
    explicit Triangulator(const Context& context) : context_(&context) {}

    /// A polygon with one contour. Fewer than three corners give no triangle and `degenerate`.
    Triangulation operator()(std::span<const Vec3> vertices, std::span<const VertexIndex> corners);

    /// A polygon with holes: contour c is corners [contour_begin[c], contour_begin[c + 1]), the first is the
    /// outer one. It turns counter-clockwise round the facet's normal; holes may run either way. No triangle
    /// when the outer contour has fewer than three corners.
    Triangulation operator()(std::span<const Vec3> vertices, std::span<const VertexIndex> corners,
                             std::span<const std::uint32_t> contour_begin);

  private:
    void project(int axis, double normal_component);
    PolygonShape clip_along(int axis, double normal_component, std::span<const VertexIndex> corners,
                            std::span<const std::uint32_t> contour_begin);

    const Context* context_ = nullptr;
    std::vector<Vec3> positions_;
    std::vector<Point2> projected_;
    CornerRing ring_;
    EarClipping ears_;
    std::vector<Triangle> triangles_, best_;
};

struct TriangulatedMesh {
    Mesh mesh;  ///< same vertices; sources name the polygon of each triangle
    std::vector<FaceIndex> degenerate, crossing;  ///< polygons of these shapes, ascending
};

/// Triangulates every face. Precondition: the offsets ascend and corners name vertices. Cancelled, it stops with some.
TriangulatedMesh triangulate(const PolygonMesh& polygons, const Context& context = {});

}  // namespace octavo::mesh
