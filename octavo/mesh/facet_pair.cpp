// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/exact/orient.hpp>
#include <octavo/mesh/facet_pair.hpp>

namespace octavo::mesh {
namespace {

using exact::orient3d;
using exact::Point;
using exact::Sign;
using exact::sign_of;
using Sides = std::array<Sign, 3>;

Sides sides_of(const exact::Plane& plane, const std::array<Point, 3>& points) {
    return {sign_of(plane.value_at(points[0])), sign_of(plane.value_at(points[1])),
            sign_of(plane.value_at(points[2]))};
}

bool has(const Sides& sides, Sign sign) { return sides[0] == sign || sides[1] == sign || sides[2] == sign; }
bool strictly_apart(const Sides& sides) {
    return sides[0] != Sign::zero && sides[0] == sides[1] && sides[1] == sides[2];
}
bool straddles(const Sides& sides) { return has(sides, Sign::positive) && has(sides, Sign::negative); }
bool in_plane(const Sides& sides) { return !has(sides, Sign::positive) && !has(sides, Sign::negative); }

/// Where the line p q passes the facet: the signs of its turns about the three sides.
Sides turns_about(Point p, Point q, const std::array<Point, 3>& f) {
    return {orient3d(p, q, f[0], f[1]), orient3d(p, q, f[1], f[2]), orient3d(p, q, f[2], f[0])};
}

/// Does an edge of `a`, whose corners lie at `sides` of the plane of `b`, run strictly through `b`?
bool edge_pierces(const Facet& a, const Sides& sides, const Facet& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = i == 2 ? 0 : i + 1;
        if (sides[i] * sides[j] != Sign::negative) continue;
        if (strictly_apart(turns_about(a.points[i], a.points[j], b.points))) return true;
    }
    return false;
}

/// Turns a triangle so that its first corner is strictly on one side and the others are not on that side.
struct Turned {
    Point p, q, r;
    Sign side;  ///< of p
};

Turned turned(const std::array<Point, 3>& points, const Sides& sides) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        if (sides[i] != Sign::zero && sides[j] != sides[i] && sides[k] != sides[i])
            return {points[i], points[j], points[k], sides[i]};
    }
    return {points[0], points[1], points[2], sides[0]};  // not reached: the triangle straddles
}

/// The intervals in which two triangles cut the common line of their planes: apart, touching in a point, or
/// with a segment in common. Both must straddle the other's plane.
FacetContact intervals_on_common_line(const Facet& a, const Sides& a_sides, const Facet& b,
                                      const Sides& b_sides) {
    Turned ta = turned(a.points, a_sides), tb = turned(b.points, b_sides);
    if (ta.side == Sign::negative) std::swap(tb.q, tb.r);
    if (tb.side == Sign::negative) std::swap(ta.q, ta.r);
    const Sign first = orient3d(ta.p, ta.q, tb.p, tb.q);
    if (first == Sign::positive) return FacetContact::none;
    const Sign second = orient3d(ta.p, ta.r, tb.r, tb.p);
    if (second == Sign::positive) return FacetContact::none;
    return first == Sign::zero || second == Sign::zero ? FacetContact::touching : FacetContact::penetrating;
}

/// The turns of `p` about the sides of a facet, seen along `axis`, counted so that inside is positive.
Sides turns_in_plane(int axis, const Facet& facet, Point p) {
    const auto& f = facet.points;
    const Sign way = sign_of(facet.plane.normal(axis));
    return {way * orient2d(axis, f[0], f[1], p), way * orient2d(axis, f[1], f[2], p),
            way * orient2d(axis, f[2], f[0], p)};
}

/// Facets of one plane. Convex sets without common interior are separated by a side of one of them.
FacetContact contact_in_plane(const Facet& a, const Facet& b) {
    const int axis = a.plane.dominant_axis();
    bool overlap = true, meet = true;
    for (const auto& [facet, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
        std::array<Sides, 3> turns;  // by corner of the other
        for (std::size_t i = 0; i < 3; ++i) turns[i] = turns_in_plane(axis, *facet, other->points[i]);
        for (std::size_t side = 0; side < 3; ++side) {
            const Sides across{turns[0][side], turns[1][side], turns[2][side]};
            overlap = overlap && has(across, Sign::positive);
            meet = meet && (has(across, Sign::positive) || has(across, Sign::zero));
        }
    }
    return overlap ? FacetContact::overlapping : meet ? FacetContact::touching : FacetContact::none;
}

/// Is a point of the plane of `facet` in it, boundary included?
bool contains(const Facet& facet, Point p) {
    return !has(turns_in_plane(facet.plane.dominant_axis(), facet, p), Sign::negative);
}

/// Does a corner of `a` lie in `b`, or an edge of it pass through `b` or its boundary?
bool touches(const Facet& a, const Sides& sides, const Facet& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = i == 2 ? 0 : i + 1;
        if (sides[i] == Sign::zero && contains(b, a.points[i])) return true;
        if (sides[i] * sides[j] != Sign::negative) continue;
        const Sides turns = turns_about(a.points[i], a.points[j], b.points);
        if (!straddles(turns)) return true;
    }
    return false;
}

FacetContact contact_sharing_nothing(const Facet& a, const Facet& b) {
    const Sides b_sides = sides_of(a.plane, b.points);
    if (strictly_apart(b_sides)) return FacetContact::none;
    const Sides a_sides = sides_of(b.plane, a.points);
    if (strictly_apart(a_sides)) return FacetContact::none;
    if (in_plane(b_sides)) return contact_in_plane(a, b);
    if (straddles(a_sides) && straddles(b_sides)) {
        const FacetContact found = intervals_on_common_line(a, a_sides, b, b_sides);
        if (found != FacetContact::penetrating) return found;
        const bool pierced = edge_pierces(a, a_sides, b) || edge_pierces(b, b_sides, a);
        return pierced ? FacetContact::crossing : FacetContact::penetrating;
    }
    return touches(a, a_sides, b) || touches(b, b_sides, a) ? FacetContact::touching : FacetContact::none;
}

/// The facet turned so that its first corner is the vertex; the same plane.
Facet started_at(const Facet& facet, VertexIndex vertex) {
    Facet result = facet;
    while (result.vertices[0] != vertex) {
        std::rotate(result.vertices.begin(), result.vertices.begin() + 1, result.vertices.end());
        std::rotate(result.points.begin(), result.points.begin() + 1, result.points.end());
    }
    return result;
}

/// Where the point p of the plane of `facet` lies as seen from the facet's first corner: strictly between the
/// two sides there (positive), on one of their rays (zero), or elsewhere.
Sign in_cone_at_first_corner(const Facet& facet, Point p) {
    const Sides turns = turns_in_plane(facet.plane.dominant_axis(), facet, p);
    if (turns[0] == Sign::negative || turns[2] == Sign::negative) return Sign::negative;
    // On both lines at once only the corner itself lies; on one of them the other tells the ray.
    return turns[0] == Sign::zero || turns[2] == Sign::zero ? Sign::zero : Sign::positive;
}

/// Cones at one vertex in one plane: common area, a common ray, or nothing but the vertex.
FacetContact cones_in_plane(const Facet& a, const Facet& b) {
    const int axis = a.plane.dominant_axis();
    bool touching = false;
    for (const auto& [facet, other] : {std::pair(&a, &b), std::pair(&b, &a)})
        for (const std::size_t corner : {std::size_t{1}, std::size_t{2}}) {
            const Sign place = in_cone_at_first_corner(*facet, other->points[corner]);
            if (place == Sign::positive) return FacetContact::overlapping;
            touching = touching || place == Sign::zero;
        }
    if (!touching) return FacetContact::none;
    // Common boundary rays only: the cones overlap when both are the same cone. Two cones with one common ray
    // lie on either side of it, or one of them had a ray inside the other.
    const auto same_ray = [&](Point p, Point q) {
        return orient2d(axis, a.points[0], p, q) == Sign::zero && in_cone_at_first_corner(a, q) == Sign::zero;
    };
    const auto& [o, p, q] = a.points;
    const auto& [v, r, s] = b.points;
    const bool same_cone = (same_ray(p, r) && same_ray(q, s)) || (same_ray(p, s) && same_ray(q, r));
    return same_cone ? FacetContact::overlapping : FacetContact::touching;
}

/// Facets that share the vertex at the first corner of each, and no other.
FacetContact contact_sharing_first_corner(const Facet& a, const Facet& b) {
    const Sign r = sign_of(a.plane.value_at(b.points[1])), s = sign_of(a.plane.value_at(b.points[2]));
    if (r * s == Sign::positive) return FacetContact::none;
    const Sign p = sign_of(b.plane.value_at(a.points[1])), q = sign_of(b.plane.value_at(a.points[2]));
    if (p * q == Sign::positive) return FacetContact::none;
    if (r == Sign::zero && s == Sign::zero) return cones_in_plane(a, b);
    // An edge from the shared vertex that lies in the other's plane.
    const auto edge_in_cone = [](Sign side, const Facet& facet, Point end) {
        return side == Sign::zero && in_cone_at_first_corner(facet, end) != Sign::negative;
    };
    if (edge_in_cone(r, a, b.points[1]) || edge_in_cone(s, a, b.points[2]) ||
        edge_in_cone(p, b, a.points[1]) || edge_in_cone(q, b, a.points[2]))
        return FacetContact::touching;
    if (r * s != Sign::negative || p * q != Sign::negative) return FacetContact::none;
    // Both straddle: each cuts a ray out of the common line. The ray of b, seen in the plane of a, runs to the
    // point x of the segment r s; it lies in the cone of a when x is left of one side and right of the other.
    const auto& [o, a1, a2] = a.points;
    const auto& [v, b1, b2] = b.points;
    const Sign left = orient3d(b1, b2, o, a1), right = orient3d(b1, b2, a2, o);
    if (left != right || left != -r) return FacetContact::none;
    const Sides a_sides{Sign::zero, p, q}, b_sides{Sign::zero, r, s};
    const bool pierced = edge_pierces(a, a_sides, b) || edge_pierces(b, b_sides, a);
    return pierced ? FacetContact::crossing : FacetContact::penetrating;
}

/// Facets that share an edge have no more in common, unless one is folded onto the other.
FacetContact contact_sharing_edge(const Facet& a, const Facet& b) {
    std::size_t free_a = 0, free_b = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        if (std::find(b.vertices.begin(), b.vertices.end(), a.vertices[i]) == b.vertices.end()) free_a = i;
        if (std::find(a.vertices.begin(), a.vertices.end(), b.vertices[i]) == a.vertices.end()) free_b = i;
    }
    if (sign_of(a.plane.value_at(b.points[free_b])) != Sign::zero) return FacetContact::none;
    const std::size_t side = free_a == 2 ? 0 : free_a + 1;  // the side opposite to the free corner
    const Sides turns = turns_in_plane(a.plane.dominant_axis(), a, b.points[free_b]);
    return turns[side] == Sign::positive ? FacetContact::overlapping : FacetContact::none;
}

/// At least one facet has no area: only its edges can cross the other.
FacetContact contact_without_area(const Facet& a, const Facet& b) {
    if (a.plane.degenerate() && b.plane.degenerate()) return FacetContact::none;
    if (b.plane.degenerate()) return contact_without_area(b, a);
    const Sides sides = sides_of(b.plane, a.points);
    return edge_pierces(a, sides, b) ? FacetContact::crossing : FacetContact::none;
}

}  // namespace

FacetContact contact_at_first_corner(const Facet& a, const Facet& b) {
    if (a.plane.degenerate() || b.plane.degenerate()) return contact_without_area(a, b);
    return contact_sharing_first_corner(a, b);
}

FacetContact contact(const Facet& a, const Facet& b) {
    if (a.plane.degenerate() || b.plane.degenerate()) return contact_without_area(a, b);
    switch (shared_vertices(a.vertices, b.vertices)) {
        case 0:
            return contact_sharing_nothing(a, b);
        case 1: {
            VertexIndex shared = a.vertices[0];
            for (const VertexIndex v : a.vertices)
                if (v == b.vertices[0] || v == b.vertices[1] || v == b.vertices[2]) shared = v;
            return contact_sharing_first_corner(started_at(a, shared), started_at(b, shared));
        }
        case 2:
            return contact_sharing_edge(a, b);
        default:
            return FacetContact::none;
    }
}

}  // namespace octavo::mesh
