// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include <octavo/boolean/rounded_points.hpp>
#include <octavo/exact/bit_budget.hpp>
#include <octavo/exact/wide_int.hpp>

namespace octavo::boolean {

using exact::int128;
using exact::Sign;

namespace {

constexpr int most_fraction_bits = 26;
constexpr int fixed_bits = exact::coordinate_bits + most_fraction_bits;  // 52
static_assert(exact::budget::sum(2, fixed_bits + fixed_bits) < 127);
static_assert(exact::budget::sum(3, exact::budget::sum(2, 2 * fixed_bits) + fixed_bits) < 191);

}  // namespace

RoundedPoints::RoundedPoints(const Soup& soup, const PointTable& points)
    : fixed_(points.size()), moved_(points.size(), 0) {
    std::uint64_t farthest = 1;
    for (const std::int64_t origin : soup.lattice.origin())
        farthest = std::max({farthest, static_cast<std::uint64_t>(std::abs(origin)),
                             static_cast<std::uint64_t>(std::abs(origin + exact::universe_side))});
    fraction_bits_ = std::clamp(53 - static_cast<int>(std::bit_width(farthest)), 0, most_fraction_bits);
    const double scale = std::ldexp(1.0, fraction_bits_);
    for (int axis = 0; axis < 3; ++axis)
        origin_[static_cast<std::size_t>(axis)] =
            soup.lattice.origin()[static_cast<std::size_t>(axis)] * (std::int64_t{1} << fraction_bits_);
    unit_ = soup.lattice.unit() / scale;
    for (PointId id = 0; id < fixed_.size(); ++id) {
        if (const exact::Point* const at = points.lattice_point(id)) {
            for (int axis = 0; axis < 3; ++axis)
                fixed_[id][static_cast<std::size_t>(axis)] = std::int64_t{(*at)[axis]} << fraction_bits_;
            continue;
        }
        const Vec3 at = points.approximation(id);
        for (int axis = 0; axis < 3; ++axis)
            fixed_[id][static_cast<std::size_t>(axis)] = std::llrint(at[axis] * scale);
        moved_[id] = 1;
        // Half a unit of the finer lattice, and 4u of the coordinate.
        largest_rounding_ = (0.5 + exact::universe_side * 0x1p-51 * scale) * unit_;
    }
}

Vec3 RoundedPoints::world(PointId id) const {
    const Point& at = fixed_[id];
    return {static_cast<double>(origin_[0] + at[0]) * unit_, static_cast<double>(origin_[1] + at[1]) * unit_,
            static_cast<double>(origin_[2] + at[2]) * unit_};
}

exact::Point RoundedPoints::nearest(PointId id) const {
    const auto at = [&](std::size_t axis) {
        const std::int64_t half = fraction_bits_ == 0 ? 0 : std::int64_t{1} << (fraction_bits_ - 1);
        return static_cast<std::int32_t>((fixed_[id][axis] + half) >> fraction_bits_);
    };
    return {at(0), at(1), at(2)};
}

Sign orient2d(int axis, const RoundedPoints::Point& p, const RoundedPoints::Point& q,
              const RoundedPoints::Point& r) {
    const auto i = static_cast<std::size_t>((axis + 1) % 3), j = static_cast<std::size_t>((axis + 2) % 3);
    return exact::sign_of(int128{q[i] - p[i]} * (r[j] - p[j]) - int128{q[j] - p[j]} * (r[i] - p[i]));
}

Sign orient3d(const RoundedPoints::Point& p, const RoundedPoints::Point& q, const RoundedPoints::Point& r,
              const RoundedPoints::Point& s) {
    const auto minor = [&](std::size_t i, std::size_t j) {
        return int128{q[i] - p[i]} * (r[j] - p[j]) - int128{q[j] - p[j]} * (r[i] - p[i]);
    };
    const int128 minors[3] = {minor(1, 2), minor(2, 0), minor(0, 1)};
    // Minors and differences convert with one rounding each, products and sums round once more.
    double value = 0, magnitude = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double term = static_cast<double>(minors[k]) * static_cast<double>(s[k] - p[k]);
        value += term;
        magnitude += std::fabs(term);
    }
    if (std::fabs(value) > 0x1p-49 * magnitude) return exact::sign_of(value);
    exact::Int192 sum;
    for (std::size_t k = 0; k < 3; ++k)
        sum += exact::multiply<3>(exact::WideInt<2>(minors[k]), exact::WideInt<1>(s[k] - p[k]));
    return sum.sign();
}

}  // namespace octavo::boolean
