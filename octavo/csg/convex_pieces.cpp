// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <octavo/base/any_scale.hpp>
#include <octavo/csg/convex_hull.hpp>
#include <octavo/csg/convex_pieces.hpp>
#include <octavo/csg/form_bounds.hpp>
#include <octavo/csg/normal_form.hpp>
#include <octavo/csg/tessellate.hpp>

namespace octavo::csg {
namespace {

Error unsupported(const char* sentence) { return {ErrorCode::unsupported, sentence, {}}; }

/// A mesh in place, facets counter-clockwise.
mesh::Mesh placed(const mesh::Mesh& mesh, const Affine& place) {
    mesh::Mesh result = mesh;
    for (Vec3& vertex : result.vertices) vertex = place(vertex);
    if (place.mirrors())
        for (mesh::Triangle& triangle : result.triangles) std::swap(triangle[1], triangle[2]);
    return result;
}

/// What a leaf is made of: a mesh, and whether that is convex. No mesh for curved primitives.
struct FlatLeaf {
    mesh::Mesh mesh;
    bool convex = true;
    std::vector<Cut> cuts;  // of a convex one
};

std::optional<FlatLeaf> flat_leaf(const PlacedPrimitive& leaf, std::size_t most_facets) {
    FlatLeaf flat;
    if (const auto* cuboid = std::get_if<Cuboid>(leaf.primitive)) {
        flat.mesh = placed(cuboid_mesh(cuboid->low, cuboid->high), leaf.place);
    } else if (const auto* polyhedron = std::get_if<Polyhedron>(leaf.primitive)) {
        flat.mesh = placed(*polyhedron->mesh, leaf.place);
        flat.convex = polyhedron->convexity == Convexity::convex;
    } else {
        return {};
    }
    if (!flat.convex || flat.mesh.triangles.size() > most_facets) return flat;
    for (const mesh::Triangle& triangle : flat.mesh.triangles) {
        const Vec3 a = flat.mesh.vertices[triangle[0]];
        Vec3 normal =
            cross_direction(flat.mesh.vertices[triangle[1]] - a, flat.mesh.vertices[triangle[2]] - a);
        const double norm = length(normal);
        if (!(norm > 0)) continue;
        normal = (1 / norm) * normal;
        double offset = dot(normal, a);
        for (const Vec3& vertex : flat.mesh.vertices) offset = std::max(offset, dot(normal, vertex));
        const bool known = std::any_of(flat.cuts.begin(), flat.cuts.end(), [&](const Cut& cut) {
            return length(cut.normal - normal) < 1e-9 &&
                   std::fabs(cut.offset - offset) < 1e-9 * std::fabs(offset) + 1e-12;
        });
        if (!known) flat.cuts.push_back({normal, offset});
    }
    return flat;
}

/// How often the mesh winds about p: the sum of the solid angles (A. Van Oosterom and J. Strackee, 1983).
double winding_about(const mesh::Mesh& mesh, Vec3 p) {
    double sum = 0;
    for (const mesh::Triangle& triangle : mesh.triangles) {
        const Vec3 a = mesh.vertices[triangle[0]] - p, b = mesh.vertices[triangle[1]] - p,
                   c = mesh.vertices[triangle[2]] - p;
        const double la = length(a), lb = length(b), lc = length(c);
        sum +=
            std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * std::acos(-1.0));
}

class Decomposer {
  public:
    Decomposer(const NormalForm& form, double tolerance, const ConvexPiecesOptions& options,
               const Context& context)
        : form_(form),
          tolerance_(tolerance),
          options_(options),
          context_(context),
          leaves_(form.leaves.size()) {}

    /// The pieces of the sub-expression at `at` inside a cell. Recursion is as deep as unions alternate with
    /// intersections, which is bounded.
    Status decompose(std::size_t at, const ConvexPiece& cell, std::vector<ConvexPiece>& to, int depth = 0) {
        if (cell.empty()) return Done{};
        if (context_.cancelled()) return Context::cancelled_error();
        if (depth > deepest)
            return Error{ErrorCode::limit, "a hull or sum is of an expression nested too deeply", {}};
        const NormalToken& token = form_.tokens[at];
        switch (token.kind) {
            case NormalKind::constant:
                if (token.complemented) to.push_back(cell);
                return Done{};
            case NormalKind::leaf:
                return add_leaf(token, cell, to);
            case NormalKind::union_of:
                for (std::size_t i = at + 1; i < at + token.size; i += form_.tokens[i].size)
                    if (Status status = decompose(i, cell, to, depth + 1); !status) return status;
                return Done{};
            case NormalKind::intersection:
                return add_intersection(at, cell, to, depth);
            default:
                return unsupported("a hull or sum of a symmetric difference");
        }
    }

  private:
    static constexpr int deepest = 500;

    Status add_intersection(std::size_t at, const ConvexPiece& cell, std::vector<ConvexPiece>& to,
                            int depth) {
        const std::size_t end = at + form_.tokens[at].size;
        std::vector<ConvexPiece> pieces{cell};
        // What is complemented comes last: it cuts only what is left.
        for (const bool complemented : {false, true})
            for (std::size_t i = at + 1; i < end; i += form_.tokens[i].size) {
                if (form_.tokens[i].complemented != complemented) continue;
                std::vector<ConvexPiece> next;
                for (const ConvexPiece& piece : pieces)
                    if (Status status = decompose(i, piece, next, depth + 1); !status) return status;
                pieces = std::move(next);
            }
        for (ConvexPiece& piece : pieces) to.push_back(std::move(piece));
        return within_limit(to);
    }

    Status add_leaf(const NormalToken& token, const ConvexPiece& cell, std::vector<ConvexPiece>& to) {
        std::unique_ptr<FlatLeaf>& leaf = leaves_[token.leaf];
        if (!leaf) {
            std::optional<FlatLeaf> flat = flat_leaf(form_.leaves[token.leaf], options_.most_facets);
            if (!flat) return unsupported("a hull, sum or projection of a curved or unbounded primitive");
            leaf = std::make_unique<FlatLeaf>(std::move(*flat));
        }
        if (leaf->mesh.triangles.size() > options_.most_facets)
            return Error{
                ErrorCode::limit, "a hull, sum or projection of a primitive with too many facets", {}};
        if (!leaf->convex) return add_mesh(*leaf, token.complemented, cell, to);
        ConvexPiece rest = cell;
        for (const Cut& cut : leaf->cuts) {
            if (token.complemented) {
                ConvexPiece outside = above(rest, cut, tolerance_);
                if (!outside.empty()) to.push_back(std::move(outside));
            }
            rest = below(rest, cut, tolerance_);
            if (rest.empty()) return within_limit(to);
        }
        if (!token.complemented) to.push_back(std::move(rest));
        return within_limit(to);
    }

    /// A mesh cuts the cell by its facets' planes until no facet is left inside.
    Status add_mesh(const FlatLeaf& leaf, bool complemented, const ConvexPiece& cell,
                    std::vector<ConvexPiece>& to) {
        if (leaf.mesh.triangles.size() > options_.most_facets)
            return Error{
                ErrorCode::limit, "a hull or sum needs the convex pieces of a mesh with too many facets", {}};
        struct Task {
            ConvexPiece cell;
            std::vector<std::uint32_t> facets;
        };
        std::vector<Task> tasks;
        std::vector<std::uint32_t> all(leaf.mesh.triangles.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        tasks.push_back({cell, std::move(all)});
        while (!tasks.empty()) {
            Task task = std::move(tasks.back());
            tasks.pop_back();
            if (task.cell.empty()) continue;
            const std::vector<std::uint32_t> facets = facets_inside(leaf.mesh, task.facets, task.cell);
            if (facets.empty()) {
                const bool inside = winding_about(leaf.mesh, task.cell.middle()) > 0.5;
                if (inside != complemented) to.push_back(std::move(task.cell));
                if (Status status = within_limit(to); !status) return status;
                continue;
            }
            const Cut cut = cut_of(leaf.mesh, facets[facets.size() / 2]);
            tasks.push_back({below(task.cell, cut, tolerance_), facets});
            tasks.push_back({above(task.cell, cut, tolerance_), facets});
        }
        return Done{};
    }

    static Cut cut_of(const mesh::Mesh& mesh, std::uint32_t facet) {
        const mesh::Triangle& t = mesh.triangles[facet];
        const Vec3 a = mesh.vertices[t[0]];
        Vec3 normal = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
        normal = (1 / length(normal)) * normal;
        return {normal, dot(normal, a)};
    }

    /// Facets that reach into the cell's inside and not only along its faces.
    std::vector<std::uint32_t> facets_inside(const mesh::Mesh& mesh, const std::vector<std::uint32_t>& facets,
                                             const ConvexPiece& cell) const {
        std::vector<Cut> sides;
        for (const std::vector<std::uint32_t>& face : cell.faces) {
            Vec3 normal;  // Newell's sum: right for any convex face, however thin its first corner
            for (std::size_t i = 0; i < face.size(); ++i)
                normal = normal + cross(cell.corners[face[i]] - cell.corners[face[0]],
                                        cell.corners[face[(i + 1) % face.size()]] - cell.corners[face[0]]);
            const double norm = length(normal);
            if (norm > 0)
                sides.push_back({(1 / norm) * normal, dot((1 / norm) * normal, cell.corners[face[0]])});
        }
        std::vector<std::uint32_t> inside;
        for (const std::uint32_t facet : facets) {
            std::vector<Vec3> polygon;
            for (const mesh::VertexIndex vertex : mesh.triangles[facet])
                polygon.push_back(mesh.vertices[vertex]);
            if (!(length(cross(polygon[1] - polygon[0], polygon[2] - polygon[0])) > 0)) continue;
            bool along = false;
            for (const Cut& side : sides) {
                bool on = true;
                for (const Vec3& p : polygon) on = on && std::fabs(side.height(p)) <= 2 * tolerance_;
                along |= on;
                polygon = clipped(polygon, side);
                if (polygon.size() < 3) break;
            }
            if (!along && polygon.size() >= 3) inside.push_back(facet);
        }
        return inside;
    }

    std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const Cut& side) const {
        std::vector<Vec3> kept;
        bool inside = false;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec3 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
            const double hp = side.height(p), hq = side.height(q);
            inside |= hp < -2 * tolerance_;
            if (hp <= 0) kept.push_back(p);
            if (hp * hq < 0) kept.push_back(p + (hp / (hp - hq)) * (q - p));
        }
        return inside ? kept : std::vector<Vec3>{};
    }

    Status within_limit(const std::vector<ConvexPiece>& pieces) const {
        if (pieces.size() <= options_.most_pieces) return Done{};
        return Error{ErrorCode::limit, "a hull, sum or projection needs too many convex pieces", {}};
    }

    const NormalForm& form_;
    double tolerance_;
    const ConvexPiecesOptions& options_;
    const Context& context_;
    std::vector<std::unique_ptr<FlatLeaf>> leaves_;
};

double extent_of(const Box3& box) {
    const Vec3 extents = box.extents();
    return std::max({extents.x, extents.y, extents.z});
}

bool only_unions(const NormalForm& form) {
    return std::all_of(form.tokens.begin(), form.tokens.end(), [](const NormalToken& token) {
        return token.kind == NormalKind::union_of || (!token.complemented && token.kind == NormalKind::leaf);
    });
}

}  // namespace

Result<std::vector<ConvexPiece>> convex_pieces(const Expr& expression, const ConvexPiecesOptions& options,
                                               const Context& context) {
    Result<NormalForm> form = normal_form(expression);
    if (!form) return form.error();
    Box3 box = bounds(*form);
    std::vector<ConvexPiece> pieces;
    if (box.empty()) return pieces;
    const double extent = extent_of(box);
    if (!std::isfinite(extent)) return unsupported("a hull, sum or projection of an unbounded solid");
    const Vec3 margin{0.01 * extent, 0.01 * extent, 0.01 * extent};
    const ConvexPiece cell = ConvexPiece::box({box.low - margin, box.high + margin});
    Decomposer decomposer(*form, 0x1p-36 * extent, options, context);
    if (Status status = decomposer.decompose(0, cell, pieces); !status) return status.error();
    return pieces;
}

Result<std::vector<Vec3>> corners_of(const Expr& expression, const Context& context) {
    Result<NormalForm> form = normal_form(expression);
    if (!form) return form.error();
    std::vector<Vec3> corners;
    if (only_unions(*form)) {
        for (const PlacedPrimitive& leaf : form->leaves) {
            const auto* cuboid = std::get_if<Cuboid>(leaf.primitive);
            const auto* polyhedron = std::get_if<Polyhedron>(leaf.primitive);
            if (!cuboid && !polyhedron) return unsupported("the hull of a curved primitive");
            const mesh::Mesh mesh =
                placed(cuboid ? cuboid_mesh(cuboid->low, cuboid->high) : *polyhedron->mesh, leaf.place);
            for (const mesh::Triangle& triangle : mesh.triangles)
                for (const mesh::VertexIndex vertex : triangle) corners.push_back(mesh.vertices[vertex]);
        }
        return corners;
    }
    Result<std::vector<ConvexPiece>> pieces = convex_pieces(expression, {}, context);
    if (!pieces) return pieces.error();
    for (const ConvexPiece& piece : *pieces)
        corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
    return corners;
}

Result<Region> shadow(const Expr& expression, const Context& context) {
    Result<std::vector<ConvexPiece>> pieces = convex_pieces(expression, {}, context);
    if (!pieces) return pieces.error();
    std::vector<Region> shadows;
    for (const ConvexPiece& piece : *pieces) {
        std::vector<Vec2> points;
        for (const Vec3& corner : piece.corners) points.push_back({corner.x, corner.y});
        shadows.push_back(convex_hull(std::move(points)));
    }
    return unite(shadows);
}

Result<Region> section(const Expr& expression, const Context& context) {
    Result<std::vector<ConvexPiece>> pieces = convex_pieces(expression, {}, context);
    if (!pieces) return pieces.error();
    Box3 box;
    for (const ConvexPiece& piece : *pieces)
        for (const Vec3& corner : piece.corners) box.add(corner);
    const double tolerance = 0x1p-34 * extent_of(box);
    std::vector<Region> sections;
    for (const ConvexPiece& piece : *pieces) {
        std::vector<Vec2> points;
        for (const std::vector<std::uint32_t>& face : piece.faces)
            for (std::size_t i = 0; i < face.size(); ++i) {
                const Vec3 p = piece.corners[face[i]], q = piece.corners[face[(i + 1) % face.size()]];
                if (std::fabs(p.z) <= tolerance) points.push_back({p.x, p.y});
                if ((p.z < -tolerance && q.z > tolerance) || (p.z > tolerance && q.z < -tolerance)) {
                    const double t = p.z / (p.z - q.z);
                    points.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
                }
            }
        sections.push_back(convex_hull(std::move(points)));
    }
    return unite(sections);
}

Result<Expr> minkowski_sum(const Expr& a, const Expr& b, const Context& context) {
    Result<std::vector<ConvexPiece>> pieces_a = convex_pieces(a, {}, context);
    if (!pieces_a) return pieces_a.error();
    Result<std::vector<ConvexPiece>> pieces_b = convex_pieces(b, {}, context);
    if (!pieces_b) return pieces_b.error();
    if (pieces_a->size() * pieces_b->size() > 20'000)
        return Error{ErrorCode::limit, "a Minkowski sum needs too many convex pieces", {}};
    std::vector<Expr> sums;
    for (const ConvexPiece& p : *pieces_a)
        for (const ConvexPiece& q : *pieces_b) {
            if (context.cancelled()) return Context::cancelled_error();
            if (p.corners.size() * q.corners.size() > 20'000'000)
                return Error{ErrorCode::limit, "a Minkowski sum of bodies with too many corners", {}};
            std::vector<Vec3> points;
            points.reserve(p.corners.size() * q.corners.size());
            for (const Vec3& x : p.corners)
                for (const Vec3& y : q.corners) points.push_back(x + y);
            if (std::optional<mesh::Mesh> hull = convex_hull(points))
                sums.push_back(
                    Expr(Polyhedron{std::make_shared<mesh::Mesh>(std::move(*hull)), Convexity::convex}));
        }
    return unite(std::move(sums));
}

Result<Box3> tight_bounds(const Expr& expression, const Context& context) {
    Result<NormalForm> form = normal_form(expression);
    if (!form) return form.error();
    if (only_unions(*form)) return bounds(*form);
    Result<std::vector<ConvexPiece>> pieces = convex_pieces(expression, {}, context);
    if (!pieces) return pieces.error();
    Box3 box;
    for (const ConvexPiece& piece : *pieces)
        for (const Vec3& corner : piece.corners) box.add(corner);
    return box;
}

}  // namespace octavo::csg
