// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include <octavo/mesh/moments.hpp>

namespace octavo::mesh {
namespace {

bool lexicographically_less(Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

}  // namespace

MomentSum::MomentSum(const Box3& bounds, std::size_t most_facets)
    : centre_(0.5 * bounds.low + 0.5 * bounds.high) {
    const Vec3 half = 0.5 * bounds.high - 0.5 * bounds.low;
    const double extent = std::max({half.x, half.y, half.z, std::ldexp(1.0, -1000)});
    exponent_ = std::ilogb(extent) + 1;
    scale_ = std::ldexp(1.0, -exponent_);
    // (t + s) − s with s = 1.5 · 2^(52 + g) rounds t to a multiple of 2^g exactly, and t minus that is exact. If g
    // leaves room for the terms below 2^53 · 2^g, adding the slices is exact too. The third slice is
    // 3 · 53 − 2 log2(facets) − … bits below the largest term: more than a double can show of the total.
    constexpr int term_exponent = 6;  // terms do not exceed 2^6
    const int room = std::bit_width(most_facets);
    int largest = term_exponent;
    for (double& shift : shifts_) {
        const int grid = largest + room - 53;
        shift = std::ldexp(1.5, 52 + grid);
        largest = grid;  // what is left of a term is at most half of this
    }
}

void MomentSum::add(Vec3 a, Vec3 b, Vec3 c) {
    const Terms terms = terms_of(scale_ * (a - centre_), scale_ * (b - centre_), scale_ * (c - centre_));
    for (std::size_t i = 0; i < term_count; ++i) {
        double rest = terms[i];
        for (std::size_t slice = 0; slice < slices; ++slice) {
            const double part = (rest + shifts_[slice]) - shifts_[slice];
            sums_[slice][i] += part;
            rest -= part;
        }
    }
}

void MomentSum::add(const MomentSum& other) {
    for (std::size_t slice = 0; slice < slices; ++slice)
        for (std::size_t i = 0; i < term_count; ++i) sums_[slice][i] += other.sums_[slice][i];
}

/// The moments of the tetrahedron (0, a, b, c), each up to the constant that `measures_of` divides by. All
/// coordinates lie in [−1, 1], so that |det| ≤ 6 and no term exceeds 2^6.
MomentSum::Terms MomentSum::terms_of(Vec3 a, Vec3 b, Vec3 c) {
    // Start at the least corner: the same facet gives the same bits whichever corner it is stored from.
    if (lexicographically_less(b, a) && !lexicographically_less(c, b))
        std::tie(a, b, c) = std::tuple(b, c, a);
    else if (lexicographically_less(c, a))
        std::tie(a, b, c) = std::tuple(c, a, b);
    const Vec3 normal = cross(b - a, c - a);
    const double det = dot(a, normal);
    const Vec3 s = a + b + c;
    const auto product = [&](int i, int j) {
        // 120 times the integral of x_i x_j over the unit-determinant tetrahedron with one corner at 0; a
        // sixteenth of it, which keeps the term in bounds and costs no digit.
        return det * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) * 0.0625;
    };
    return {det,           length(normal), det * s.x,     det * s.y,     det * s.z,    product(0, 0),
            product(1, 1), product(2, 2),  product(0, 1), product(1, 2), product(2, 0)};
}

Moments MomentSum::moments() const {
    const auto scaled = [&](double value, int power) { return std::ldexp(value, power * exponent_); };
    Moments moments;
    moments.volume = scaled(total(six_volume) / 6, 3);
    moments.area = scaled(total(twice_area) / 2, 2);
    moments.centroid = centre_;
    if (total(six_volume) == 0) return moments;
    const double volume = total(six_volume) / 6;
    const Vec3 c{total(m_x) / 24 / volume, total(m_y) / 24 / volume, total(m_z) / 24 / volume};
    moments.centroid = centre_ + Vec3{scaled(c.x, 1), scaled(c.y, 1), scaled(c.z, 1)};
    const double xx = total(m_xx) * 16 / 120 - volume * c.x * c.x;
    const double yy = total(m_yy) * 16 / 120 - volume * c.y * c.y;
    const double zz = total(m_zz) * 16 / 120 - volume * c.z * c.z;
    const double xy = -scaled(total(m_xy) * 16 / 120 - volume * c.x * c.y, 5);
    const double yz = -scaled(total(m_yz) * 16 / 120 - volume * c.y * c.z, 5);
    const double zx = -scaled(total(m_zx) * 16 / 120 - volume * c.z * c.x, 5);
    moments.inertia[0] = {scaled(yy + zz, 5), xy, zx};
    moments.inertia[1] = {xy, scaled(zz + xx, 5), yz};
    moments.inertia[2] = {zx, yz, scaled(xx + yy, 5)};
    return moments;
}

}  // namespace octavo::mesh
