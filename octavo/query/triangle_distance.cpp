// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <octavo/query/triangle_distance.hpp>

namespace octavo::query {
namespace {

using exact::int128;
using exact::wide;
using exact::WideInt;
using Difference = std::array<std::int64_t, 3>;

Difference difference(const FixedPoint& q, exact::Point a) {
    return {q.x[0] - (std::int64_t{a.x} << q.shift), q.x[1] - (std::int64_t{a.y} << q.shift),
            q.x[2] - (std::int64_t{a.z} << q.shift)};
}
Difference edge(exact::Point a, exact::Point b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }

int128 dot(const Difference& u, const Difference& v) {
    static_assert(63 + 26 + 2 < 127);
    return wide(u[0]) * v[0] + wide(u[1]) * v[1] + wide(u[2]) * v[2];
}

/// Of edges; below 2^53.
Difference normal(const Difference& u, const Difference& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

std::array<int128, 3> cross(const Difference& e, const Difference& q) {
    static_assert(63 + 26 + 1 < 127);
    return {wide(e[1]) * q[2] - wide(e[2]) * q[1], wide(e[2]) * q[0] - wide(e[0]) * q[2],
            wide(e[0]) * q[1] - wide(e[1]) * q[0]};
}

/// n · (u × v), for a normal, an edge and a difference, in either order of these.
WideInt<3> determinant(const Difference& n, const Difference& u, const Difference& v) {
    static_assert(54 + 63 + 26 + 1 + 2 < 191);
    const std::array<int128, 3> w{wide(u[1]) * v[2] - wide(u[2]) * v[1],
                                  wide(u[2]) * v[0] - wide(u[0]) * v[2],
                                  wide(u[0]) * v[1] - wide(u[1]) * v[0]};
    WideInt<3> sum;
    for (std::size_t axis = 0; axis < 3; ++axis)
        sum += exact::multiply<3>(WideInt<2>(w[axis]), WideInt<2>(n[axis]));
    return sum;
}

/// Whether a b − c d > 0; the factors are below 2^92.
bool product_exceeds(int128 a, int128 b, int128 c, int128 d) {
    const double first = static_cast<double>(a) * static_cast<double>(b);
    const double second = static_cast<double>(c) * static_cast<double>(d);
    // Three roundings a product and one of the difference: 2^-50 of the sum is more than their error.
    const double error = 0x1p-50 * (std::fabs(first) + std::fabs(second));
    if (first - second > error) return true;
    if (first - second < -error) return false;
    static_assert(92 + 92 + 1 < 191);
    using Wide = WideInt<2>;
    return exact::multiply<3>(Wide(a), Wide(b)) > exact::multiply<3>(Wide(c), Wide(d));
}

double square(double x) { return x * x; }

Vec3 rounded(const Difference& d) {
    return {static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
}
double sum_of_magnitudes(Vec3 v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

/// The sign of a number that is known to within an error; 0 when it is not known.
int sign(double value, double error) { return (value > error) - (value < -error); }

/// The part of a triangle a, b, c that is nearest.
enum class Region : std::uint8_t { a, b, c, ab, ac, bc, face };

/// The region, when doubles can tell. Points on borders of regions are left to the exact tests, whose order this
/// follows.
///
/// With A the magnitudes of both edges and Q those of q − a, summed: all scalar products are below A (Q + A one) and
/// err by less than 2^-49 of that (each factor is rounded once, each of three products and two sums too, and
/// differences of three of them), products of two by 2^-46 of its square.
std::optional<Region> region_by_filter(const Difference& edge_b, const Difference& edge_c,
                                       const Difference& from_a, double one) {
    const Vec3 ab = rounded(edge_b), ac = rounded(edge_c), qa = rounded(from_a);
    const double edges = sum_of_magnitudes(ab) + sum_of_magnitudes(ac);
    const double size = edges * (sum_of_magnitudes(qa) + edges * one);
    const double error = 0x1p-49 * size, product_error = 0x1p-46 * size * size;
    const double ab_ac = octavo::dot(ab, ac) * one;
    const double d1 = octavo::dot(ab, qa), d2 = octavo::dot(ac, qa);
    const double d3 = d1 - octavo::dot(ab, ab) * one, d4 = d2 - ab_ac, d5 = d1 - ab_ac,
                 d6 = d2 - octavo::dot(ac, ac) * one;
    const int s1 = sign(d1, error), s2 = sign(d2, error), s3 = sign(d3, error), s6 = sign(d6, error),
              s43 = sign(d4 - d3, error), s56 = sign(d5 - d6, error);
    if (s1 == 0 || s2 == 0 || s3 == 0 || s6 == 0 || s43 == 0 || s56 == 0) return std::nullopt;
    if (s1 < 0 && s2 < 0) return Region::a;
    if (s3 > 0 && s43 < 0) return Region::b;
    if (s6 > 0 && s56 < 0) return Region::c;
    if (s1 > 0 && s3 < 0) {
        const int beyond = sign(d1 * d4 - d3 * d2, product_error);
        if (beyond == 0) return std::nullopt;
        if (beyond < 0) return Region::ab;
    }
    if (s2 > 0 && s6 < 0) {
        const int beyond = sign(d5 * d2 - d1 * d6, product_error);
        if (beyond == 0) return std::nullopt;
        if (beyond < 0) return Region::ac;
    }
    if (s43 > 0 && s56 > 0) {
        const int beyond = sign(d3 * d6 - d5 * d4, product_error);
        if (beyond == 0) return std::nullopt;
        if (beyond < 0) return Region::bc;
    }
    return Region::face;
}

/// The same for every point; degenerate triangles have no face.
Region region_exactly(const Difference& ab, const Difference& ac, const Difference& qa, int shift) {
    const int128 unit = int128{1} << shift;
    const int128 ab_ac = dot(ab, ac) * unit, ab_ab = dot(ab, ab) * unit, ac_ac = dot(ac, ac) * unit;
    const int128 d1 = dot(ab, qa), d2 = dot(ac, qa);
    if (d1 <= 0 && d2 <= 0) return Region::a;
    const int128 d3 = d1 - ab_ab, d4 = d2 - ab_ac;
    if (d3 >= 0 && d4 <= d3) return Region::b;
    const int128 d5 = d1 - ab_ac, d6 = d2 - ac_ac;
    if (d6 >= 0 && d5 <= d6) return Region::c;
    // Strict signs along the edges keep edges without length out; for others they change nothing.
    if (d1 > 0 && d3 < 0 && !product_exceeds(d1, d4, d3, d2)) return Region::ab;
    if (d2 > 0 && d6 < 0 && !product_exceeds(d5, d2, d1, d6)) return Region::ac;
    if (d4 > d3 && d5 > d6 && !product_exceeds(d3, d6, d5, d4)) return Region::bc;
    return Region::face;
}

struct Fraction {
    WideInt<4> numerator;
    WideInt<2> denominator;
};

/// The squared distance times 4^shift.
Fraction exact_square(const FixedPoint& q, const NearestFeature& nearest) {
    const exact::Point a = nearest.corners[0];
    const Difference qa = difference(q, a);
    Fraction result;
    const auto squared = [](int128 v) { return exact::multiply<4>(WideInt<2>(v), WideInt<2>(v)); };
    if (nearest.feature == Feature::vertex) {
        for (const std::int64_t x : qa) result.numerator += squared(x);
        result.denominator = WideInt<2>(1);
        return result;
    }
    const Difference ab = edge(a, nearest.corners[1]);
    if (nearest.feature == Feature::edge) {
        for (const int128 x : cross(ab, qa)) result.numerator += squared(x);
        result.denominator = WideInt<2>(dot(ab, ab));
        return result;
    }
    const Difference n = normal(ab, edge(a, nearest.corners[2]));
    static_assert(53 + 63 + 2 < 127);
    result.numerator = squared(dot(n, qa));
    result.denominator = WideInt<2>(dot(n, n));
    return result;
}

}  // namespace

FixedPoint FixedPoint::of(Vec3 world, const exact::Lattice& lattice) {
    // Scaling by a power of two is exact but for underflow, which is far below the resolution, and overflow.
    const Vec3 scaled = (1 / lattice.unit()) * world;
    const double farthest = std::max({std::fabs(scaled.x), std::fabs(scaled.y), std::fabs(scaled.z)});
    FixedPoint fixed;
    if (farthest <= 0x1p61) {
        std::array<std::int64_t, 3> whole{};
        std::uint64_t most = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            whole[i] = static_cast<std::int64_t>(std::floor(scaled[axis])) - lattice.origin()[i];
            most = std::max(most, static_cast<std::uint64_t>(whole[i] < 0 ? -whole[i] : whole[i]));
        }
        fixed.shift = std::min(36, 62 - static_cast<int>(std::bit_width(most)));
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double part = scaled[axis] - std::floor(scaled[axis]);
            const std::int64_t one = std::int64_t{1} << fixed.shift;
            fixed.x[i] = whole[i] * one + static_cast<std::int64_t>(part * static_cast<double>(one) + 0.5);
        }
        return fixed;
    }
    // From the lattice's origin, in quarters, which no difference of doubles overflows.
    fixed.shift = 0;
    fixed.scaled_down = true;
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
        const auto origin = static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]);
        place[axis] = 0.25 * world[axis] - 0.25 * (origin * lattice.unit());
    }
    const int reach = std::ilogb(std::max({std::fabs(place.x), std::fabs(place.y), std::fabs(place.z)}));
    for (int axis = 0; axis < 3; ++axis)
        fixed.x[static_cast<std::size_t>(axis)] = std::llround(std::scalbn(place[axis], 61 - reach));
    return fixed;
}

Vec3 FixedPoint::approximation() const {
    const double step = 1 / static_cast<double>(std::int64_t{1} << shift);
    return {step * static_cast<double>(x[0]), step * static_cast<double>(x[1]),
            step * static_cast<double>(x[2])};
}

NearestFeature nearest_feature(const FixedPoint& q, const Corners& triangle) {
    const auto& [a, b, c] = triangle;
    const double step = 1 / static_cast<double>(std::int64_t{1} << q.shift), scale = step * step;
    const auto at_vertex = [&](exact::Point vertex) {
        const Difference d = difference(q, vertex);
        const double sum = square(static_cast<double>(d[0])) + square(static_cast<double>(d[1])) +
                           square(static_cast<double>(d[2]));
        return NearestFeature{Feature::vertex, {vertex, vertex, vertex}, sum * scale};
    };
    const auto on_edge = [&](exact::Point from, exact::Point to) {
        if (from > to) std::swap(from, to);
        const Difference e = edge(from, to);
        const std::array<int128, 3> w = cross(e, difference(q, from));
        const double sum = square(static_cast<double>(w[0])) + square(static_cast<double>(w[1])) +
                           square(static_cast<double>(w[2]));
        return NearestFeature{Feature::edge, {from, to, to}, sum / static_cast<double>(dot(e, e)) * scale};
    };

    const Difference ab = edge(a, b), ac = edge(a, c), qa = difference(q, a);
    const std::optional<Region> known =
        region_by_filter(ab, ac, qa, static_cast<double>(std::int64_t{1} << q.shift));
    switch (known ? *known : region_exactly(ab, ac, qa, q.shift)) {
        case Region::a:
            return at_vertex(a);
        case Region::b:
            return at_vertex(b);
        case Region::c:
            return at_vertex(c);
        case Region::ab:
            return on_edge(a, b);
        case Region::ac:
            return on_edge(a, c);
        case Region::bc:
            return on_edge(b, c);
        case Region::face:
            break;
    }
    const Difference n = normal(ab, ac);
    const double along = static_cast<double>(dot(n, qa));
    const double length2 = square(static_cast<double>(n[0])) + square(static_cast<double>(n[1])) +
                           square(static_cast<double>(n[2]));
    return {Feature::face, triangle, along * along / length2 * scale};
}

std::strong_ordering compare_distance(const FixedPoint& q, const NearestFeature& a, const NearestFeature& b) {
    const double error = 0x1p-46 * (a.squared_distance + b.squared_distance);
    if (a.squared_distance < b.squared_distance - error) return std::strong_ordering::less;
    if (a.squared_distance > b.squared_distance + error) return std::strong_ordering::greater;
    if (a.feature == b.feature && a.corners == b.corners) return std::strong_ordering::equal;
    const Fraction first = exact_square(q, a), second = exact_square(q, b);
    static_assert(236 + 108 < 64 * 6 - 1);
    return exact::multiply<6>(first.numerator, second.denominator) <=>
           exact::multiply<6>(second.numerator, first.denominator);
}

Vec3 nearest_point(const FixedPoint& q, const NearestFeature& feature) {
    const exact::Point a = feature.corners[0];
    const Vec3 base{static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)};
    if (feature.feature == Feature::vertex) return base;
    const auto to_vector = [](const Difference& d) {
        return Vec3{static_cast<double>(d[0]), static_cast<double>(d[1]), static_cast<double>(d[2])};
    };
    const Difference ab = edge(a, feature.corners[1]), qa = difference(q, a);
    const double step = 1 / static_cast<double>(std::int64_t{1} << q.shift);
    if (feature.feature == Feature::edge) {
        const double t = static_cast<double>(dot(ab, qa)) / static_cast<double>(dot(ab, ab)) * step;
        return base + t * to_vector(ab);
    }
    const Difference ac = edge(a, feature.corners[2]), n = normal(ab, ac);
    const double length2 = static_cast<double>(dot(n, n));
    if (std::fabs(static_cast<double>(qa[0])) + std::fabs(static_cast<double>(qa[1])) +
            std::fabs(static_cast<double>(qa[2])) <
        0x1p28 / step) {
        const double t = static_cast<double>(dot(n, qa)) / length2 * step;
        return q.approximation() - t * to_vector(n);
    }
    // From afar the foot would be lost in the difference of the point and the way to it, so it is found in the
    // triangle.
    const double beta = to_double(determinant(n, qa, ac)) / length2 * step,
                 gamma = to_double(determinant(n, ab, qa)) / length2 * step;
    return base + beta * to_vector(ab) + gamma * to_vector(ac);
}

}  // namespace octavo::query
