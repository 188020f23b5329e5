// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include <octavo/csg/solid_mesh.hpp>
#include <octavo/csg/tessellate.hpp>
#include <octavo/io/openscad_csg_geometry.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::io::openscad {
namespace {

csg::Expr convex(mesh::Mesh mesh) {
    return csg::Expr(
        csg::Polyhedron{std::make_shared<const mesh::Mesh>(std::move(mesh)), csg::Convexity::convex});
}

double radius(Parameters& p, std::string_view name, std::string_view diameter, double fallback) {
    if (const std::optional<double> d = p.number(diameter)) return *d / 2;
    return p.number(name, fallback);
}

Result<Geometry> finish(const Parameters& p, Geometry geometry) {
    if (p.error()) return *p.error();
    return geometry;
}

/// Of a primitive without extent, as OpenSCAD has it: nothing, and a warning.
Result<Geometry> nothing_of(const Node& node, const Scope& scope, const Parameters& p, const char* what) {
    if (p.error()) return *p.error();
    scope.warn(node, std::string(node.name) + "(…) is empty: " + what + " must be positive");
    return Geometry::none();
}

Result<Geometry> cube(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"size", "center"});
    const std::array<double, 3> size = p.vector<3>("size", {1, 1, 1});
    const double shift = p.boolean("center", false) ? -0.5 : 0;
    const csg::Cuboid cuboid{{shift * size[0], shift * size[1], shift * size[2]},
                             {(1 + shift) * size[0], (1 + shift) * size[1], (1 + shift) * size[2]}};
    if (csg::is_degenerate(cuboid)) return nothing_of(node, scope, p, "its sizes");
    return finish(p, Geometry::of(csg::Expr(cuboid)));
}

Result<Geometry> sphere(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"r"});
    const double r = radius(p, "r", "d", 1);
    const int segments = csg::segments_of(r, p.roundness());
    if (p.error() || !(r > 0)) return nothing_of(node, scope, p, "its radius");
    if (!scope.faceted) return Geometry::of(csg::Expr(csg::Ball{r}));
    if (std::optional<Error> error = scope.too_fine(node, segments)) return *error;
    if (std::optional<Error> error = scope.too_large(node, 0.5 * segments * segments)) return *error;
    return Geometry::of(convex(csg::faceted_ball(r, segments)));
}

Result<Geometry> cylinder(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"h", "r1", "r2", "center"});
    const double both = radius(p, "r", "d", 1);
    const double bottom = radius(p, "r1", "d1", both), top = radius(p, "r2", "d2", both);
    const double h = p.number("h", 1);
    const bool centered = p.boolean("center", false);
    const csg::Frustum frustum{centered ? -h / 2 : 0, centered ? h / 2 : h, bottom, top};
    const int segments = csg::segments_of(std::max(bottom, top), p.roundness());
    if (p.error() || csg::is_degenerate(frustum))
        return nothing_of(node, scope, p, "its height and one radius at least");
    if (!scope.faceted) return Geometry::of(csg::Expr(frustum));
    if (std::optional<Error> error = scope.too_fine(node, segments)) return *error;
    return Geometry::of(convex(csg::faceted_frustum(frustum.low, frustum.high, bottom, top, segments)));
}

Result<Geometry> polyhedron(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"points", "faces", "convexity"});
    mesh::PolygonMesh polygons;
    for (const std::vector<double>& row : p.rows("points")) {
        if (row.size() < 3) {
            p.fail("a point has fewer than three coordinates");
            break;
        }
        polygons.vertices.push_back({row[0], row[1], row[2]});
    }
    for (std::vector<std::uint32_t>& face :
         p.index_rows(p.has("faces") ? "faces" : "triangles", polygons.vertices.size())) {
        if (face.size() < 3) continue;
        // OpenSCAD's faces run clockwise seen from outside.
        polygons.corners.insert(polygons.corners.end(), face.rbegin(), face.rend());
        polygons.contour_begin.push_back(static_cast<std::uint32_t>(polygons.corners.size()));
        polygons.face_begin.push_back(static_cast<std::uint32_t>(polygons.contour_begin.size() - 1));
    }
    if (p.error()) return *p.error();
    mesh::Mesh mesh = mesh::triangulate(polygons, scope.context).mesh;
    if (scope.context.cancelled()) return Context::cancelled_error();
    mesh.sources.clear();
    if (mesh.triangles.empty()) return Geometry::none();
    if (!csg::is_closed(mesh)) {
        mesh = csg::weld_near(mesh, 0x1p-20);
        if (!mesh.triangles.empty() && csg::is_closed(mesh))
            scope.warn(node, "polyhedron(…) closes only after vertices nearer than 2^-20 were made one");
    }
    if (!csg::is_closed(mesh))
        return scope.options.skip_unsupported
                   ? scope.unsupported(node, "its faces do not close")
                   : scope.syntax.error_at(node.place, "polyhedron(…): its faces do not close",
                                           ErrorCode::not_a_solid);
    if (csg::volume_sign(mesh) < 0) {
        scope.warn(node, "polyhedron(…) is inside out and was turned");
        for (mesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    }
    return Geometry::of(csg::Expr(csg::as_polyhedron(std::move(mesh))));
}

Result<Geometry> square(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"size", "center"});
    const std::array<double, 2> size = p.vector<2>("size", {1, 1});
    const double x = p.boolean("center", false) ? -size[0] / 2 : 0,
                 y = p.boolean("center", false) ? -size[1] / 2 : 0;
    if (p.error() || !(size[0] > 0) || !(size[1] > 0)) return nothing_of(node, scope, p, "its sizes");
    return Geometry::of(
        csg::Region{{{{x, y}, {x + size[0], y}, {x + size[0], y + size[1]}, {x, y + size[1]}}}});
}

Result<Geometry> circle(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"r"});
    const double r = radius(p, "r", "d", 1);
    const int segments = csg::segments_of(r, p.roundness());
    if (p.error() || !(r > 0)) return nothing_of(node, scope, p, "its radius");
    if (std::optional<Error> error = scope.too_fine(node, segments)) return *error;
    return Geometry::of(csg::Region{{csg::circle(r, segments)}});
}

Result<Geometry> polygon(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"points", "paths", "convexity"});
    csg::Contour points;
    for (const std::vector<double>& row : p.rows("points")) {
        if (row.size() < 2) {
            p.fail("a point has fewer than two coordinates");
            break;
        }
        points.push_back({row[0], row[1]});
    }
    std::vector<csg::Contour> contours;
    if (p.has("paths")) {
        for (const std::vector<std::uint32_t>& path : p.index_rows("paths", points.size())) {
            csg::Contour contour;
            for (const std::uint32_t index : path) contour.push_back(points[index]);
            contours.push_back(std::move(contour));
        }
    } else {
        contours.push_back(points);
    }
    if (p.error()) return *p.error();
    return Geometry::of(csg::make_region(contours, csg::FillRule::even_odd));
}

Result<Geometry> import_mesh(const Node& node, const Scope& scope) {
    Parameters p(scope.syntax, node, {"file", "layer", "convexity"});
    const std::string file = p.string("file");
    if (p.error()) return *p.error();
    if (file.empty()) return scope.unsupported(node, "it names no file");
    const std::filesystem::path path = std::filesystem::path(scope.folder) / file;
    std::error_code trouble;
    if (!std::filesystem::is_regular_file(path, trouble))
        return scope.unsupported(node, "there is no file " + file);
    Result<ReadMesh> read = read_mesh(path.string(), {}, scope.context);
    if (!read) {
        if (read.error().code == ErrorCode::cancelled) return read.error();
        return scope.unsupported(node, file + ": " + read.error().sentence);
    }
    scope.files.push_back(path.string());
    scope.files.insert(scope.files.end(), read->beside.begin(), read->beside.end());
    mesh::Mesh mesh = std::move(read->mesh);
    mesh.sources.clear();
    for (const Vec3& vertex : mesh.vertices)
        if (!is_finite(vertex)) return scope.unsupported(node, file + " has a vertex that is not finite");
    if (!csg::is_closed(mesh)) return scope.unsupported(node, "the mesh in " + file + " is not closed");
    return Geometry::of(csg::Expr(csg::as_polyhedron(std::move(mesh))));
}

}  // namespace

Geometry Geometry::of(csg::Region region) {
    if (region.empty()) return none();
    return {Kind::flat, std::move(region), {}};
}

std::optional<Result<Geometry>> make_leaf(const Node& node, const Scope& scope) {
    using Make = Result<Geometry> (*)(const Node&, const Scope&);
    static constexpr std::pair<std::string_view, Make> makers[] = {
        {"cube", cube},     {"sphere", sphere}, {"cylinder", cylinder}, {"polyhedron", polyhedron},
        {"square", square}, {"circle", circle}, {"polygon", polygon},   {"import", import_mesh}};
    for (const auto& [name, make] : makers)
        if (node.name == name) return make(node, scope);
    if (node.name == "text") return scope.unsupported(node, "it needs fonts");
    if (node.name == "surface") return scope.unsupported(node, "height fields are not read");
    return {};
}

}  // namespace octavo::io::openscad
