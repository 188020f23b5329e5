// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <octavo/base/any_scale.hpp>
#include <octavo/base/grouped.hpp>
#include <octavo/csg/convex_hull.hpp>
#include <octavo/csg/convex_pieces.hpp>
#include <octavo/csg/extrude.hpp>
#include <octavo/csg/revolve.hpp>
#include <octavo/csg/solid_mesh.hpp>
#include <octavo/io/openscad_csg_geometry.hpp>

namespace octavo::io::openscad {
namespace {

using Children = std::vector<Geometry>;

std::vector<csg::Region> regions(Children children) {
    std::vector<csg::Region> result;
    for (Geometry& child : children) result.push_back(std::move(child.region));
    return result;
}

std::vector<csg::Expr> solids(Children children) {
    std::vector<csg::Expr> result;
    for (Geometry& child : children) result.push_back(std::move(child.solid));
    return result;
}

/// Leaves children of one kind, that of the first that is not empty, and the empty ones.
Geometry::Kind settle_kind(const Node& node, Children& children, const Scope& scope) {
    Geometry::Kind kind = Geometry::Kind::empty;
    for (const Geometry& child : children)
        if (kind == Geometry::Kind::empty) kind = child.kind;
    const auto other = [&](const Geometry& child) {
        return child.kind != kind && child.kind != Geometry::Kind::empty;
    };
    if (std::any_of(children.begin(), children.end(), other)) {
        scope.warn(node, std::string(node.name) +
                             "(…) mixes flat and solid parts; those unlike the first are left out");
        children.erase(std::remove_if(children.begin(), children.end(), other), children.end());
    }
    return kind;
}

void drop_empty(Children& children) {
    children.erase(std::remove_if(children.begin(), children.end(),
                                  [](const Geometry& child) { return child.kind == Geometry::Kind::empty; }),
                   children.end());
}

Result<Geometry> difference(const Node& node, Children children, const Scope& scope) {
    if (children.empty() || children.front().kind == Geometry::Kind::empty) return Geometry::none();
    const Geometry::Kind kind = settle_kind(node, children, scope);
    drop_empty(children);
    if (kind == Geometry::Kind::flat) return Geometry::of(csg::subtract(regions(std::move(children))));
    if (children.size() == 1) return std::move(children.front());
    return Geometry::of(csg::subtract(solids(std::move(children))));
}

Result<Geometry> intersection(const Node& node, Children children, const Scope& scope) {
    const Geometry::Kind kind = settle_kind(node, children, scope);
    for (const Geometry& child : children)
        if (child.kind == Geometry::Kind::empty) return Geometry::none();
    if (children.empty()) return Geometry::none();
    if (kind == Geometry::Kind::flat) return Geometry::of(csg::intersect(regions(std::move(children))));
    if (children.size() == 1) return std::move(children.front());
    return Geometry::of(csg::intersect(solids(std::move(children))));
}

/// A solid's places are looked at when it is put on a lattice; a flat shape is worked on before.
Result<Geometry> transformed_region(const Node& node, const Affine& map, const csg::Region& region,
                                    const Scope& scope) {
    csg::Region image = csg::transform(map, region);
    for (const csg::Contour& contour : image.contours)
        for (const csg::Vec2& p : contour)
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                return scope.syntax.error_at(
                    node.place, std::string(node.name) + "(…) takes a shape beyond what a double can hold",
                    ErrorCode::limit);
    return Geometry::of(std::move(image));
}

Result<Geometry> transformed(const Node& node, const Affine& map, Children children, const Scope& scope) {
    Geometry geometry = unite(node, std::move(children), scope);
    if (geometry.is_flat()) return transformed_region(node, map, geometry.region, scope);
    if (!geometry.is_solid()) return geometry;
    if (csg::is_singular(map)) {
        scope.warn(node, std::string(node.name) + "(…) squeezes a solid flat; it is left out");
        return Geometry::none();
    }
    return Geometry::of(csg::transform(map, std::move(geometry.solid)));
}

Result<Geometry> multmatrix(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"m"});
    Affine map;
    const std::vector<std::vector<double>> rows = p.rows("m");
    for (std::size_t r = 0; r < std::min<std::size_t>(rows.size(), 3); ++r)
        for (std::size_t c = 0; c < std::min<std::size_t>(rows[r].size(), 4); ++c) map.m[r][c] = rows[r][c];
    if (rows.size() > 3 && rows[3].size() > 3 && rows[3][3] != 1 && rows[3][3] != 0)
        for (auto& row : map.m)
            for (double& entry : row) entry /= rows[3][3];
    if (p.error()) return *p.error();
    return transformed(node, map, std::move(children), scope);
}

Affine rotation(Vec3 axis, double degrees) {
    if (axis == Vec3{}) return {};
    axis = scaled_near_one(axis);
    const Vec3 u = (1 / length(axis)) * axis;
    const double c = csg::cos_degrees(degrees), s = csg::sin_degrees(degrees);
    Affine map;
    for (int r = 0; r < 3; ++r)
        for (int k = 0; k < 3; ++k)
            map.m[static_cast<std::size_t>(r)][static_cast<std::size_t>(k)] =
                (r == k ? c : 0) + (1 - c) * u[r] * u[k];
    map.m[0][1] -= s * u.z, map.m[0][2] += s * u.y;
    map.m[1][0] += s * u.z, map.m[1][2] -= s * u.x;
    map.m[2][0] -= s * u.y, map.m[2][1] += s * u.x;
    return map;
}

/// translate, scale, rotate and mirror do not occur in dumps but are part of the language.
Result<Geometry> named_map(const Node& node, Children children, const Scope& scope) {
    Affine map;
    Parameters p(scope.syntax, node,
                 node.name == "rotate" ? std::initializer_list<std::string_view>{"a", "v"}
                                       : std::initializer_list<std::string_view>{"v"});
    if (node.name == "translate") {
        const std::array<double, 3> v = p.vector<3>("v", {0, 0, 0});
        for (std::size_t i = 0; i < 3; ++i) map.m[i][3] = v[i];
    } else if (node.name == "scale") {
        const std::array<double, 3> v = p.vector<3>("v", {1, 1, 1});
        for (std::size_t i = 0; i < 3; ++i) map.m[i][i] = v[i];
    } else if (node.name == "mirror") {
        const std::array<double, 3> v = p.vector<3>("v", {1, 0, 0});
        const Vec3 across = scaled_near_one({v[0], v[1], v[2]});
        const double square = dot(across, across);
        for (int r = 0; r < 3 && square > 0; ++r)
            for (int c = 0; c < 3; ++c)
                map.m[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] -=
                    2 * across[r] * across[c] / square;
    } else if (p.has("v")) {
        const std::array<double, 3> v = p.vector<3>("v", {0, 0, 1});
        map = rotation({v[0], v[1], v[2]}, p.number("a", 0));
    } else {
        const std::array<double, 3> a = p.vector<3>("a", {0, 0, 0});
        const bool about_z = scope.syntax.values.size() > 0 && node.argument_count > 0 &&
                             scope.syntax.values[scope.syntax.arguments[node.first_argument].value].kind() ==
                                 Value::Kind::number;
        map = rotation({0, 0, 1}, a[2]);
        if (!about_z) map = compose(map, compose(rotation({0, 1, 0}, a[1]), rotation({1, 0, 0}, a[0])));
    }
    if (p.error()) return *p.error();
    return transformed(node, map, std::move(children), scope);
}

Result<Geometry> hull(const Node& node, Children children, const Scope& scope) {
    const Geometry::Kind kind = settle_kind(node, children, scope);
    drop_empty(children);
    if (kind == Geometry::Kind::flat) {
        std::vector<csg::Vec2> points;
        for (const Geometry& child : children)
            for (const csg::Contour& contour : child.region.contours)
                points.insert(points.end(), contour.begin(), contour.end());
        return Geometry::of(csg::convex_hull(std::move(points)));
    }
    std::vector<Vec3> corners;
    for (const Geometry& child : children) {
        Result<std::vector<Vec3>> more = csg::corners_of(child.solid, scope.context);
        if (!more) return more.error();
        corners.insert(corners.end(), more->begin(), more->end());
    }
    std::optional<mesh::Mesh> mesh = csg::convex_hull(corners);
    if (!mesh) return Geometry::none();
    return Geometry::of(csg::Expr(
        csg::Polyhedron{std::make_shared<const mesh::Mesh>(std::move(*mesh)), csg::Convexity::convex}));
}

Result<Geometry> minkowski(const Node& node, Children children, const Scope& scope) {
    const Geometry::Kind kind = settle_kind(node, children, scope);
    drop_empty(children);
    if (children.empty()) return Geometry::none();
    if (kind == Geometry::Kind::flat) {
        csg::Region sum = std::move(children.front().region);
        for (std::size_t i = 1; i < children.size(); ++i) sum = csg::minkowski_sum(sum, children[i].region);
        return Geometry::of(std::move(sum));
    }
    csg::Expr sum = std::move(children.front().solid);
    for (std::size_t i = 1; i < children.size(); ++i) {
        Result<csg::Expr> next = csg::minkowski_sum(sum, children[i].solid, scope.context);
        if (!next) return next.error();
        sum = std::move(*next);
    }
    return Geometry::of(std::move(sum));
}

Result<Geometry> resize(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"newsize", "auto"});
    const std::array<double, 3> size = p.vector<3>("newsize", {0, 0, 0});
    std::array<bool, 3> automatic{};
    if (p.has("auto")) {
        const Value& value = [&]() -> const Value& {
            const Argument* found = nullptr;
            for (std::uint32_t i = 0; i < node.argument_count; ++i) {
                const Argument& argument = scope.syntax.arguments[node.first_argument + i];
                if (argument.name == "auto" || (argument.name.empty() && i == 1)) found = &argument;
            }
            return scope.syntax.values[found->value];
        }();
        if (value.kind() == Value::Kind::vector)
            for (std::uint32_t i = 0; i < std::min(value.count, 3U); ++i)
                automatic[i] = (&value)[i + 1].number != 0;
        else
            automatic.fill(value.number != 0);
    }
    if (p.error()) return *p.error();
    Geometry geometry = unite(node, std::move(children), scope);
    Box3 box;
    if (geometry.is_flat()) {
        box = csg::bounds(geometry.region);
    } else if (geometry.is_solid()) {
        Result<Box3> tight = csg::tight_bounds(geometry.solid, scope.context);
        if (!tight) return tight.error();
        box = *tight;
    }
    if (box.empty()) return Geometry::none();
    const Vec3 extents = box.extents();
    int largest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (size[static_cast<std::size_t>(axis)] > size[static_cast<std::size_t>(largest)]) largest = axis;
    const double common = size[static_cast<std::size_t>(largest)] > 0 && extents[largest] > 0
                              ? size[static_cast<std::size_t>(largest)] / extents[largest]
                              : 1;
    Affine map;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (size[a] > 0 && extents[axis] > 0)
            map.m[a][a] = size[a] / extents[axis];
        else if (automatic[a])
            map.m[a][a] = common;
    }
    if (geometry.is_flat()) return transformed_region(node, map, geometry.region, scope);
    return Geometry::of(csg::transform(map, std::move(geometry.solid)));
}

Result<Geometry> projection(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"cut"});
    const bool cut = p.boolean("cut", false);
    if (p.error()) return *p.error();
    const Geometry geometry = unite(node, std::move(children), scope);
    if (!geometry.is_solid()) return Geometry::none();
    Result<csg::Region> region =
        cut ? csg::section(geometry.solid, scope.context) : csg::shadow(geometry.solid, scope.context);
    if (!region) return region.error();
    return Geometry::of(std::move(*region));
}

Result<Geometry> offset(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"r"});
    csg::OffsetOptions options;
    double distance = p.number("r", 1);
    if (!p.has("r") && p.has("delta")) {
        distance = p.number("delta", 1);
        options.join =
            p.boolean("chamfer", false) ? csg::OffsetOptions::Join::chamfer : csg::OffsetOptions::Join::miter;
    }
    options.segments = csg::segments_of(std::fabs(distance), p.roundness());
    if (p.error()) return *p.error();
    if (std::optional<Error> error = scope.too_fine(node, options.segments)) return *error;
    const Geometry geometry = unite(node, std::move(children), scope);
    if (!geometry.is_flat()) return Geometry::none();
    return Geometry::of(csg::offset(geometry.region, distance, options));
}

double corners_in(const csg::Region& region) {
    double count = 0;
    for (const csg::Contour& contour : region.contours) count += static_cast<double>(contour.size());
    return count;
}

Result<Geometry> linear_extrude(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"height"});
    if (p.has("file")) return scope.unsupported(node, "files of flat shapes are not read");
    csg::LinearExtrude options;
    options.height = p.number("height", p.has("h") ? p.number("h", 100) : 100);
    options.centered = p.boolean("center", false);
    options.twist = p.number("twist", 0);
    const std::array<double, 2> scale = p.vector<2>("scale", {1, 1});
    options.scale = {std::max(scale[0], 0.0), std::max(scale[1], 0.0)};
    const Geometry geometry = unite(node, std::move(children), scope);
    const csg::Roundness roundness = p.roundness();
    const std::optional<double> slices = p.number("slices");
    if (p.error()) return *p.error();
    if (!geometry.is_flat()) {
        if (geometry.is_solid()) scope.warn(node, "linear_extrude(…) of a solid is left out");
        return Geometry::none();
    }
    const double layers =
        slices ? std::max(std::floor(*slices), 1.0) : csg::slices_of(geometry.region, options, roundness);
    if (std::optional<Error> error = scope.too_large(node, corners_in(geometry.region) * (layers + 1)))
        return *error;
    options.slices = static_cast<int>(layers);  // a region has corners, and these were counted
    mesh::Mesh mesh = csg::linear_extrude(geometry.region, options);
    if (mesh.triangles.empty()) return Geometry::none();
    return Geometry::of(csg::Expr(csg::as_polyhedron(std::move(mesh))));
}

Result<Geometry> rotate_extrude(const Node& node, Children children, const Scope& scope) {
    Parameters p(scope.syntax, node, {"angle"});
    if (p.has("file")) return scope.unsupported(node, "files of flat shapes are not read");
    double angle = p.number("angle", 360);
    if (angle <= -360 || angle > 360) angle = 360;
    const csg::Roundness roundness = p.roundness();
    if (p.error()) return *p.error();
    const Geometry geometry = unite(node, std::move(children), scope);
    if (!geometry.is_flat()) return Geometry::none();
    const auto place = [&](Error error) {
        return scope.syntax.error_at(node.place, "rotate_extrude(…): " + error.sentence, error.code);
    };
    if (!scope.faceted) {
        Result<csg::Expr> round = csg::revolve(geometry.region, angle);
        if (!round) return place(round.error());
        return Geometry::of(std::move(*round));
    }
    const Box3 box = csg::bounds(geometry.region);
    const double radius = std::max(std::fabs(box.low.x), std::fabs(box.high.x));
    csg::RotateExtrude options;
    options.angle = angle;
    options.segments =
        std::max(static_cast<int>(csg::segments_of(radius, roundness) * std::fabs(angle) / 360), 1);
    if (std::optional<Error> error = scope.too_fine(node, options.segments)) return *error;
    if (std::optional<Error> error =
            scope.too_large(node, corners_in(geometry.region) * (options.segments + 1)))
        return *error;
    Result<mesh::Mesh> mesh = csg::rotate_extrude(geometry.region, options);
    if (!mesh) return place(mesh.error());
    if (mesh->triangles.empty()) return Geometry::none();
    return Geometry::of(csg::Expr(csg::as_polyhedron(std::move(*mesh))));
}

bool is_any_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void Scope::warn(const Node& node, const std::string& sentence) const {
    // A warning counts the lines before it: a file with millions of them gets the first hundred.
    constexpr std::size_t most = 100;
    if (warnings.size() < most) warnings.push_back(syntax.place_text(node.place) + ": " + sentence);
    if (warnings.size() == most) warnings.push_back("further warnings are left out");
}

std::optional<Error> Scope::too_large(const Node& node, double vertices) const {
    if (vertices <= static_cast<double>(options.most_vertices)) return {};
    return syntax.error_at(node.place,
                           std::string(node.name) + "(…) would have more than " +
                               std::to_string(options.most_vertices) + " vertices",
                           ErrorCode::limit);
}

std::optional<Error> Scope::too_fine(const Node& node, int segments) const {
    if (segments <= options.most_segments) return {};
    return syntax.error_at(node.place,
                           std::string(node.name) + "(…) would have more than " +
                               grouped(static_cast<std::uint64_t>(options.most_segments)) +
                               " corners all round; give it a smaller $fn",
                           ErrorCode::limit);
}

Result<Geometry> Scope::unsupported(const Node& node, const std::string& why) const {
    const std::string sentence = std::string(node.name) + "(…) cannot be read: " + why;
    if (!options.skip_unsupported) return syntax.error_at(node.place, sentence, ErrorCode::unsupported);
    warn(node, sentence);
    return Geometry::none();
}

bool needs_facets(std::string_view name) {
    return is_any_of(name, {"hull", "minkowski", "projection", "resize"});
}

Geometry unite(const Node& node, std::vector<Geometry> children, const Scope& scope) {
    const Geometry::Kind kind = settle_kind(node, children, scope);
    drop_empty(children);
    if (children.empty()) return Geometry::none();
    if (children.size() == 1) return std::move(children.front());
    if (kind == Geometry::Kind::flat) return Geometry::of(csg::unite(regions(std::move(children))));
    return Geometry::of(csg::unite(solids(std::move(children))));
}

Result<Geometry> make_inner(const Node& node, std::vector<Geometry> children, const Scope& scope) {
    const std::string_view name = node.name;
    if (is_any_of(name, {"union", "group", "color", "render", "assign", "intersection_for", "for"})) {
        if (name == "intersection_for") return intersection(node, std::move(children), scope);
        return unite(node, std::move(children), scope);
    }
    if (name == "multmatrix") return multmatrix(node, std::move(children), scope);
    if (name == "difference") return difference(node, std::move(children), scope);
    if (name == "intersection") return intersection(node, std::move(children), scope);
    if (name == "hull") return hull(node, std::move(children), scope);
    if (name == "minkowski") return minkowski(node, std::move(children), scope);
    if (name == "linear_extrude") return linear_extrude(node, std::move(children), scope);
    if (name == "rotate_extrude") return rotate_extrude(node, std::move(children), scope);
    if (name == "offset") return offset(node, std::move(children), scope);
    if (name == "projection") return projection(node, std::move(children), scope);
    if (name == "resize") return resize(node, std::move(children), scope);
    if (is_any_of(name, {"translate", "scale", "rotate", "mirror"}))
        return named_map(node, std::move(children), scope);
    if (name == "fill") {
        // The outlines without their holes.
        Geometry geometry = unite(node, std::move(children), scope);
        if (!geometry.is_flat()) return Geometry::none();
        return Geometry::of(csg::make_region(geometry.region.contours, csg::FillRule::non_zero));
    }
    if (name == "roof") return scope.unsupported(node, "roofs are not built");
    return scope.syntax.error_at(node.place,
                                 "'" + std::string(name.substr(0, 60)) + "' is no node of a .csg file");
}

}  // namespace octavo::io::openscad
