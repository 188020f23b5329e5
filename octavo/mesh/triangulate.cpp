// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <octavo/base/check.hpp>
#include <octavo/mesh/area_vector.hpp>
#include <octavo/mesh/collinear.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::mesh {
namespace {

/// The normal of the outer contour times twice its area, after Newell. Rounded: it only chooses the view.
/// Coordinate axes, the one nearest to `normal` first.
std::array<int, 3> axes_by_closeness(Vec3 normal) {
    std::array<int, 3> axes{0, 1, 2};
    std::stable_sort(axes.begin(), axes.end(),
                     [&](int a, int b) { return std::fabs(normal[a]) > std::fabs(normal[b]); });
    return axes;
}

}  // namespace

Triangulation Triangulator::operator()(std::span<const Vec3> vertices, std::span<const VertexIndex> corners) {
    const std::uint32_t contour_begin[] = {0, static_cast<std::uint32_t>(corners.size())};
    return (*this)(vertices, corners, contour_begin);
}

Triangulation Triangulator::operator()(std::span<const Vec3> vertices, std::span<const VertexIndex> corners,
                                       std::span<const std::uint32_t> contour_begin) {
    triangles_.clear();
    const bool one_contour = contour_begin.size() == 2;
    if (contour_begin[1] - contour_begin[0] < 3) return {{}, PolygonShape::degenerate};
    if (one_contour && corners.size() == 3) {
        const Triangle triangle{corners[0], corners[1], corners[2]};
        if (names_a_vertex_twice(triangle)) return {{}, PolygonShape::degenerate};
        triangles_.push_back(triangle);
        return {triangles_, PolygonShape::simple};
    }

    best_.clear();
    positions_.clear();
    for (const VertexIndex corner : corners) positions_.push_back(vertices[corner]);
    PolygonShape shape = PolygonShape::crossing;
    if (scale_for_orient2d(positions_)) {
        const Vec3 normal =
            area_vector(std::span(positions_).subspan(contour_begin[0], contour_begin[1] - contour_begin[0]));
        for (const int axis : axes_by_closeness(normal)) {
            // Seen on edge, a plane polygon always looks flat: other views count only when they are proper.
            const PolygonShape seen = clip_along(axis, normal[axis], corners, contour_begin);
            if (best_.empty() || seen == PolygonShape::simple) shape = seen, best_.swap(triangles_);
            if (shape == PolygonShape::simple) break;
        }
    } else {
        // Not finite: no view makes sense, but the edges must be used.
        for (std::uint32_t i = 1; one_contour && i + 1 < corners.size(); ++i) best_.push_back({0, i, i + 1});
    }
    triangles_.clear();
    for (const Triangle& t : best_) {
        const Triangle triangle{corners[t[0]], corners[t[1]], corners[t[2]]};
        if (!names_a_vertex_twice(triangle)) triangles_.push_back(triangle);
    }
    if (triangles_.empty()) shape = PolygonShape::degenerate;
    return {triangles_, shape};
}

void Triangulator::project(int axis, double normal_component) {
    // Seen from the tip of the normal the outer contour runs counter-clockwise.
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal_component < 0) std::swap(u, v);
    projected_.clear();
    for (const Vec3& p : positions_) projected_.push_back({p[u], p[v]});
}

/// Leaves the triangulation seen along the axis, as corner numbers, in triangles_.
PolygonShape Triangulator::clip_along(int axis, double normal_component, std::span<const VertexIndex> corners,
                                      std::span<const std::uint32_t> contour_begin) {
    project(axis, normal_component);
    const std::vector<Point2>& p = projected_;
    if (p.size() == 4 && contour_begin.size() == 2) {
        const auto left = [&](int a, int b, int c) { return orient2d(p[a], p[b], p[c]) > 0; };
        if (left(0, 1, 2) && left(0, 2, 3)) {
            triangles_ = {{0, 1, 2}, {0, 2, 3}};
            return PolygonShape::simple;
        }
        if (left(0, 1, 3) && left(1, 2, 3)) {
            triangles_ = {{0, 1, 3}, {1, 2, 3}};
            return PolygonShape::simple;
        }
    }
    build_ring(projected_, contour_begin, ring_);
    static const Context never_cancelled;
    const EarClippingResult result = ears_.clip(ring_, context_ ? *context_ : never_cancelled);
    triangles_.assign(ears_.triangles().begin(), ears_.triangles().end());
    if (result.forced_triangles > 0) return PolygonShape::crossing;
    if (result.flat_triangles == 0) return PolygonShape::simple;
    // Flat triangles that name a vertex twice will be left out: outlines pinched in a vertex are proper.
    for (const auto& [a, b, c] : triangles_)
        if (orient2d(p[a], p[b], p[c]) == 0 && !names_a_vertex_twice({corners[a], corners[b], corners[c]}))
            return PolygonShape::degenerate;
    return PolygonShape::simple;
}

TriangulatedMesh triangulate(const PolygonMesh& polygons, const Context& context) {
    TriangulatedMesh result;
    result.mesh.vertices = polygons.vertices;
    Triangulator triangulator(context);
    std::vector<std::uint32_t> contour_begin;
    for (FaceIndex face = 0; face + 1 < polygons.face_begin.size() && !context.cancelled(); ++face) {
        const std::uint32_t first = polygons.face_begin[face], last = polygons.face_begin[face + 1];
        OCTAVO_CHECK(first <= last && last < polygons.contour_begin.size(), "contour offsets must ascend");
        const std::uint32_t begin = polygons.contour_begin[first], end = polygons.contour_begin[last];
        contour_begin.clear();
        for (std::uint32_t c = first; c <= last; ++c)
            contour_begin.push_back(polygons.contour_begin[c] - begin);
        const Triangulation triangulation = triangulator(
            polygons.vertices, std::span(polygons.corners).subspan(begin, end - begin), contour_begin);
        for (const Triangle& triangle : triangulation.triangles) {
            result.mesh.triangles.push_back(triangle);
            result.mesh.sources.push_back({0, face});
        }
        if (triangulation.shape == PolygonShape::degenerate) result.degenerate.push_back(face);
        if (triangulation.shape == PolygonShape::crossing) result.crossing.push_back(face);
    }
    return result;
}

}  // namespace octavo::mesh
