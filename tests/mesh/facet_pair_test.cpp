// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/mesh/facet_octree.hpp>
#include <octavo/mesh/facet_pair.hpp>

#include "effort.hpp"
#include "unlimited.hpp"

namespace octavo::mesh {
namespace {

using octavo::tests::Rational;
using Vector = std::array<Rational, 3>;
using exact::Point;

// The oracle: constructs the common points with rationals and looks at them. Nothing in it compares orientations.

Vector vector_of(Point p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }
Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector outer(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector between(const Vector& a, const Vector& b, const Rational& t) {
    return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

struct Tri {
    std::array<Vector, 3> p;
    Vector normal;
    explicit Tri(const Facet& f) : p{vector_of(f.points[0]), vector_of(f.points[1]), vector_of(f.points[2])} {
        normal = outer(minus(p[1], p[0]), minus(p[2], p[0]));
    }
    bool flat() const { return normal == Vector{0, 0, 0}; }
    Rational height(const Vector& x) const { return inner(normal, minus(x, p[0])); }
    /// Barycentric coordinates, up to a positive factor, of a point of the plane.
    std::array<Rational, 3> weights(const Vector& x) const {
        return {inner(normal, outer(minus(p[2], p[1]), minus(x, p[1]))),
                inner(normal, outer(minus(p[0], p[2]), minus(x, p[2]))),
                inner(normal, outer(minus(p[1], p[0]), minus(x, p[0])))};
    }
};

bool edge_through_interior(const Tri& a, const Tri& b) {
    if (b.flat()) return false;
    for (int i = 0; i < 3; ++i) {
        const Vector &p = a.p[i], &q = a.p[(i + 1) % 3];
        const Rational hp = b.height(p), hq = b.height(q);
        if (hp * hq >= 0) continue;
        const auto w = b.weights(between(p, q, hp / (hp - hq)));
        if (w[0] > 0 && w[1] > 0 && w[2] > 0) return true;
    }
    return false;
}

/// The points in which the outline of a meets the plane of b, extreme ones along `direction`.
struct Interval {
    Rational low, high;
    Vector at_low, at_high;
};
std::optional<Interval> cut(const Tri& a, const Tri& b, const Vector& direction) {
    std::optional<Interval> result;
    const auto add = [&](const Vector& x) {
        const Rational t = inner(direction, x);
        if (!result) result = Interval{t, t, x, x};
        if (t < result->low) result->low = t, result->at_low = x;
        if (t > result->high) result->high = t, result->at_high = x;
    };
    for (int i = 0; i < 3; ++i) {
        const Vector &p = a.p[i], &q = a.p[(i + 1) % 3];
        const Rational hp = b.height(p), hq = b.height(q);
        if (hp == 0) add(p);
        if (hp * hq < 0) add(between(p, q, hp / (hp - hq)));
    }
    return result;
}

bool straddles(const Tri& a, const Tri& b) {
    bool above = false, below = false;
    for (const Vector& p : a.p) above = above || b.height(p) > 0, below = below || b.height(p) < 0;
    return above && below;
}

/// Sutherland–Hodgman in the common plane.
std::vector<Vector> clipped(const Tri& a, const Tri& b) {
    std::vector<Vector> polygon(a.p.begin(), a.p.end());
    for (int i = 0; i < 3; ++i) {
        const auto side = [&](const Vector& x) {
            return inner(b.normal, outer(minus(b.p[(i + 1) % 3], b.p[i]), minus(x, b.p[i])));
        };
        std::vector<Vector> next;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vector &x = polygon[k], &y = polygon[(k + 1) % polygon.size()];
            const Rational sx = side(x), sy = side(y);
            if (sx >= 0) next.push_back(x);
            if (sx * sy < 0) next.push_back(between(x, y, sx / (sx - sy)));
        }
        polygon = next;
    }
    return polygon;
}

/// Is x in the simplex of the shared vertices?
bool in_shared(const Vector& x, const std::vector<Vector>& shared) {
    if (shared.empty()) return false;
    if (shared.size() == 1) return x == shared[0];
    const Vector along = minus(shared[1], shared[0]), to = minus(x, shared[0]);
    const Rational t = inner(along, to);
    return outer(along, to) == Vector{0, 0, 0} && t >= 0 && t <= inner(along, along);
}

FacetContact oracle(const Facet& fa, const Facet& fb) {
    const Tri a(fa), b(fb);
    std::vector<Vector> shared;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (fa.vertices[i] == fb.vertices[j]) shared.push_back(a.p[i]);
    if (shared.size() == 3) return FacetContact::none;
    if (edge_through_interior(a, b) || edge_through_interior(b, a)) return FacetContact::crossing;
    if (a.flat() || b.flat()) return FacetContact::none;
    const Vector direction = outer(a.normal, b.normal);
    if (direction == Vector{0, 0, 0}) {
        if (a.height(b.p[0]) != 0) return FacetContact::none;
        const std::vector<Vector> polygon = clipped(a, b);
        Rational area = 0;
        for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
            area += inner(a.normal, outer(minus(polygon[k], polygon[0]), minus(polygon[k + 1], polygon[0])));
        if (area != 0) return FacetContact::overlapping;
        const bool beyond = std::any_of(polygon.begin(), polygon.end(),
                                        [&](const Vector& x) { return !in_shared(x, shared); });
        return beyond ? FacetContact::touching : FacetContact::none;
    }
    const auto ia = cut(a, b, direction), ib = cut(b, a, direction);
    if (!ia || !ib) return FacetContact::none;
    const Interval& low = ia->low > ib->low ? *ia : *ib;
    const Interval& high = ia->high < ib->high ? *ia : *ib;
    if (low.low > high.high) return FacetContact::none;
    if (low.low < high.high && straddles(a, b) && straddles(b, a)) return FacetContact::penetrating;
    return in_shared(low.at_low, shared) && in_shared(high.at_high, shared) ? FacetContact::none
                                                                            : FacetContact::touching;
}

TEST(FacetContact, AgreesWithConstructedIntersections) {
    // On a tiny grid nearly everything is degenerate; on larger ones general. Every number of shared vertices.
    std::mt19937 random(21);
    std::array<std::array<int, 5>, 3> seen{};
    const int rounds = 24000 * tests::effort();
    for (int round = 0; round < rounds; ++round) {
        const int span = std::array{1, 2, 3, 6, 40}[static_cast<std::size_t>(round) % 5];
        std::uniform_int_distribution<int> coordinate(0, span);
        const int shared = round / 5 % 3;
        std::vector<Point> points;
        while (points.size() < 6) {
            // Every seventh pair lies in one plane.
            const int z = round % 7 == 0 && span > 1 ? 0 : coordinate(random);
            const Point p{coordinate(random) + 7, coordinate(random) + 9, z + 1};
            if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
        }
        Triangle ta{0, 1, 2}, tb{3, 4, 5};
        if (shared >= 1) tb[0] = 1;
        if (shared == 2) tb[2] = 2;
        std::shuffle(ta.begin(), ta.end(), random);
        std::shuffle(tb.begin(), tb.end(), random);
        const Facet a(ta, points.data()), b(tb, points.data());
        const FacetContact expected = oracle(a, b);
        ASSERT_EQ(contact(a, b), expected) << "round " << round << " shared " << shared;
        ASSERT_EQ(contact(b, a), expected) << "round " << round << " shared " << shared;
        ++seen[static_cast<std::size_t>(shared)][static_cast<std::size_t>(expected)];
    }
    for (std::size_t kind = 0; kind < 5; ++kind) EXPECT_GT(seen[0][kind], 50) << kind;
    for (std::size_t kind = 0; kind < 5; ++kind) EXPECT_GT(seen[1][kind], 40) << kind;
    EXPECT_GT(seen[2][0], 1000);
    EXPECT_GT(seen[2][4], 100);
}

TEST(FacetContact, IsExactWhereDoublesAreNot) {
    // A huge triangle, and an edge whose ends lie one unit above and below its plane or on it.
    const std::int32_t far = exact::universe_side - 1;
    const std::vector<Point> points{{0, 1, 2}, {far, 3, far - 7}, {5, far, far}, {far / 3, far / 3, 0},
                                    {0, 0, 0}, {1, 0, 0}};
    const Facet big(Triangle{0, 1, 2}, points.data());
    std::mt19937 random(22);
    for (int round = 0; round < 2000; ++round) {
        std::uniform_int_distribution<std::int32_t> coordinate(0, far);
        const std::int32_t x = coordinate(random), y = coordinate(random);
        // The z at which the plane passes x, y, rounded down.
        const auto& n = big.plane;
        const exact::int128 top = -(n.d() + exact::wide(n.a()) * x + exact::wide(n.b()) * y);
        const auto z = static_cast<std::int64_t>(top / n.c());
        if (z < 2 || z > far - 2) continue;
        const auto at = [&](int dz) { return Point{x, y, static_cast<std::int32_t>(z + dz)}; };
        for (const int dz : {-1, 0, 1, 2}) {
            std::vector<Point> all = points;
            all[3] = at(dz), all[4] = at(dz - 1), all[5] = Point{x > 9 ? x - 9 : x + 9, y, at(0).z};
            const Facet small(Triangle{3, 4, 5}, all.data());
            ASSERT_EQ(contact(big, small), oracle(big, small));
        }
    }
}

TEST(MayEnter, NeverLosesAFacetAndIsTightForFatOnes) {
    std::mt19937 random(23);
    int kept = 0, truly = 0;
    for (int round = 0; round < 10000; ++round) {
        std::uniform_int_distribution<std::int32_t> coordinate(0, 24);
        std::array<Point, 3> f;
        for (Point& p : f) p = {coordinate(random), coordinate(random), coordinate(random)};
        const std::array<std::int32_t, 3> low{8, 8, 8};
        const std::int32_t side = 8;
        // Clips the facet by the six planes of the cube.
        std::vector<Vector> polygon{vector_of(f[0]), vector_of(f[1]), vector_of(f[2])};
        for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
            const std::size_t axis = static_cast<std::size_t>(plane / 2);
            const auto depth = [&](const Vector& x) -> Rational {
                return plane % 2 ? Rational(low[axis] + side - x[axis]) : Rational(x[axis] - low[axis]);
            };
            std::vector<Vector> next;
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                const Vector &x = polygon[k], &y = polygon[(k + 1) % polygon.size()];
                const Rational dx = depth(x), dy = depth(y);
                if (dx >= 0) next.push_back(x);
                if (dx * dy < 0) next.push_back(between(x, y, dx / (dx - dy)));
            }
            polygon = next;
        }
        const bool expected = !polygon.empty(), found = may_enter(f, low, side);
        ASSERT_TRUE(found || !expected);
        kept += found, truly += expected;
        // A segment is a facet that repeats a corner.
        const bool enters_segment = enters(f[0], f[1], low, side);
        const std::array<Point, 3> flat{f[0], f[1], f[1]};
        ASSERT_EQ(enters_segment, may_enter(flat, low, side));
    }
    EXPECT_EQ(kept, truly);
}

}  // namespace
}  // namespace octavo::mesh
