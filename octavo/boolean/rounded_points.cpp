// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/exact/bit_budget.hpp>
#include <octavo/exact/wide_int.hpp>

namespace octavo::boolean {

using exact::int128;
using exact::Sign;

namespace {

constexpr int fraction_bits = RoundedPoints::fraction_bits;
constexpr int fixed_bits = exact::coordinate_bits + fraction_bits;
static_assert(fixed_bits == 62 && exact::budget::sum(2, fixed_bits + fixed_bits) < 127);
static_assert(exact::budget::sum(3, exact::budget::sum(2, 2 * fixed_bits) + fixed_bits) < 191);

constexpr std::int64_t fixed(std::int32_t coordinate) { return std::int64_t{coordinate} << fraction_bits; }

/// How many of the fraction bits a double lacks in the unit cell from `cell` on, counted from the world's origin.
/// Whole units are doubles all over the lattice.
int lacking_bits(std::int64_t cell) {
    const auto magnitude = static_cast<std::uint64_t>(cell >= 0 ? cell : -cell - 1);
    return std::clamp(static_cast<int>(std::bit_width(magnitude)) + fraction_bits - 53, 0, fraction_bits);
}

double rounding_at(int lacking) {
    // Half a step, and the 4u by which the fraction of the cell may be off before.
    return std::ldexp(0.5, lacking - fraction_bits) + 0x1p-51;
}

}  // namespace

RoundedPoints::RoundedPoints(const Soup& soup, const PointTable& points, const Context& context)
    : vertices_(soup.points),
      lattice_(soup.lattice),
      fixed_(points.size() - soup.points.size()),
      moved_(fixed_.size(), 0) {
    constexpr std::size_t grain = 1 << 12;
    std::vector<double> largest(fixed_.size() / grain + 1, 0);
    parallel_chunks(context, fixed_.size(), grain, [&](std::size_t begin, std::size_t end) {
        double& here = largest[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            const auto id = static_cast<PointId>(vertices_.size() + i);
            if (const exact::Point* const at = points.lattice_point(id)) {
                fixed_[i] = {fixed(at->x), fixed(at->y), fixed(at->z)};
                continue;
            }
            points.with(id, [&](const auto& point) {
                here = std::max(here, round(exact::homogeneous(point), points.cell(id), i));
            });
        }
    });
    largest_rounding_ = *std::max_element(largest.begin(), largest.end()) * lattice_.unit();
}

template <class P>
double RoundedPoints::round(const P& point, exact::Point cell, std::size_t number) {
    double farthest = 0;
    const double weight = to_double(point.weight());
    for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(axis);
        // The rest in the cell, 0 <= rest < weight; no wider than the numerator.
        using Numerator = typename P::Numerator;
        const Numerator rest = point.numerator(axis) - exact::multiply<Numerator::bits / 64>(
                                                           point.weight(), exact::WideInt<1>(cell[axis]));
        const int lacking = lacking_bits(lattice_.origin()[index] + cell[axis]);
        const auto scale = static_cast<double>(std::int64_t{1} << (fraction_bits - lacking));
        const double scaled = to_double(rest) / weight * scale;
        const std::int64_t steps = std::llrint(scaled);
        fixed_[number][index] = fixed(cell[axis]) + (steps << lacking);
        const auto is_exact = [&] {
            constexpr int limbs = Numerator::bits / 64 + 1;
            return exact::WideInt<limbs>(rest) << (fraction_bits - lacking) ==
                   exact::multiply<limbs>(point.weight(), exact::WideInt<1>(steps));
        };
        if (static_cast<double>(steps) == scaled && is_exact()) continue;
        moved_[number] = 1;
        farthest = std::max(farthest, rounding_at(lacking));
    }
    return farthest;
}

Vec3 RoundedPoints::world(PointId id) const {
    const Point at = (*this)[id];
    const auto coordinate = [&](std::size_t axis) {
        // The sum is a double, so neither term loses anything.
        const std::int64_t whole = at[axis] >> fraction_bits, part = at[axis] - (whole << fraction_bits);
        return (static_cast<double>(lattice_.origin()[axis] + whole) +
                std::ldexp(static_cast<double>(part), -fraction_bits)) *
               lattice_.unit();
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

std::int64_t RoundedPoints::spacing(int axis, PointId id) const {
    const auto index = static_cast<std::size_t>(axis);
    // At a power of two doubles are finer on one side: the coarser of both.
    const std::int64_t cell = lattice_.origin()[index] + ((*this)[id][index] >> fraction_bits);
    return std::int64_t{1} << std::max(lacking_bits(cell), lacking_bits(cell - 1));
}

void RoundedPoints::move(PointId id, Point to) {
    OCTAVO_DCHECK(is_moved(id), "this point has a place of its own");
    fixed_[id - vertices_.size()] = to;
}

double rounding_bound(const exact::Lattice& lattice) {
    int lacking = 0;
    for (const std::int64_t origin : lattice.origin())
        lacking = std::max({lacking, lacking_bits(origin), lacking_bits(origin + exact::universe_side)});
    return rounding_at(lacking);
}

Sign orient2d(int axis, const RoundedPoints::Point& p, const RoundedPoints::Point& q,
              const RoundedPoints::Point& r) {
    const auto i = static_cast<std::size_t>((axis + 1) % 3), j = static_cast<std::size_t>((axis + 2) % 3);
    return exact::sign_of(int128{q[i] - p[i]} * (r[j] - p[j]) - int128{q[j] - p[j]} * (r[i] - p[i]));
}

Sign orient3d(const RoundedPoints::Point& p, const RoundedPoints::Point& q, const RoundedPoints::Point& r,
              const RoundedPoints::Point& s) {
    // In doubles differences round once, products and sums of them once more each: off by less than 16u times the sum
    // of the magnitudes of all six products.
    double value = 0, magnitude = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const auto edge = [&](const RoundedPoints::Point& to, std::size_t axis) {
            return static_cast<double>(to[axis] - p[axis]);
        };
        const double first = edge(q, i) * edge(r, j), second = edge(q, j) * edge(r, i), height = edge(s, k);
        value += (first - second) * height;
        magnitude += (std::fabs(first) + std::fabs(second)) * std::fabs(height);
    }
    if (std::fabs(value) > 0x1p-49 * magnitude) return exact::sign_of(value);
    exact::Int192 sum;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const int128 minor = int128{q[i] - p[i]} * (r[j] - p[j]) - int128{q[j] - p[j]} * (r[i] - p[i]);
        sum += exact::multiply<3>(exact::WideInt<2>(minor), exact::WideInt<1>(s[k] - p[k]));
    }
    return sum.sign();
}

}  // namespace octavo::boolean
