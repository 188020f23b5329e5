// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>

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
// Floats may take a point past the lattice, by one and a half of their greatest distance, 2^-14 of its size. So the
// product of three differences is less than twice that of three coordinates.
constexpr int coarsest = 12;
static_assert(fixed_bits == 62 && exact::budget::sum(2, 2 * fixed_bits + 1) <= 127);
static_assert(exact::budget::sum(3, exact::budget::sum(2, 3 * fixed_bits + 1)) <= 191);

constexpr std::int64_t fixed(std::int64_t coordinate) {
    return coordinate * (std::int64_t{1} << fraction_bits);
}

/// How many of the fraction bits, and of those of whole units, a number lacks in the unit cell from `cell` on, counted
/// from the world's origin. Whole units are doubles all over the lattice.
int lacking_bits(std::int64_t cell, Numbers numbers) {
    const auto magnitude = static_cast<std::uint64_t>(cell >= 0 ? cell : -cell - 1);
    const bool are_floats = numbers == Numbers::floats;
    return std::clamp(static_cast<int>(std::bit_width(magnitude)) + fraction_bits - (are_floats ? 24 : 53), 0,
                      fraction_bits + (are_floats ? coarsest : 0));
}

double rounding_at(int lacking) {
    // Half a step, and the 4u by which the fraction of the step may be off before.
    return std::ldexp(0.5, lacking - fraction_bits) +
           std::ldexp(0x1p-51, std::max(0, lacking - fraction_bits));
}

/// A coordinate as multiples of the distance of numbers about it.
struct Steps {
    int lacking;          ///< the distance, as a power of two of RoundedPoints::Point's unit
    int coarse;           ///< the same of lattice units, where it is as much as one; else 0
    std::int64_t base;    ///< the multiple at or below the coordinate's cell, in lattice units
    std::int64_t beyond;  ///< from there to the cell

    Steps(std::int64_t origin, std::int64_t cell, Numbers numbers)
        : lacking(lacking_bits(origin + cell, numbers)), coarse(std::max(0, lacking - fraction_bits)) {
        beyond = (origin + cell) & ((std::int64_t{1} << coarse) - 1);
        base = cell - beyond;
    }
    /// Steps in a lattice unit.
    double per_unit() const {
        return coarse > 0 ? 1.0 / static_cast<double>(std::int64_t{1} << coarse)
                          : static_cast<double>(std::int64_t{1} << (fraction_bits - lacking));
    }
    std::int64_t at(std::int64_t steps) const { return fixed(base) + (steps << lacking); }
};

}  // namespace

RoundedPoints::RoundedPoints(const Soup& soup, const PointTable& points, Numbers numbers,
                             const Context& context)
    : vertices_(soup.points), lattice_(soup.lattice), numbers_(numbers) {
    const bool all_stay =
        numbers == Numbers::doubles ||
        std::all_of(vertices_.begin(), vertices_.end(), [&](exact::Point p) { return is_place(p); });
    first_ = all_stay ? static_cast<PointId>(vertices_.size()) : 0;
    fixed_.resize(points.size() - first_);
    moved_.assign(fixed_.size(), 0);
    constexpr std::size_t grain = 1 << 12;
    std::vector<double> largest(fixed_.size() / grain + 1, 0);
    parallel_chunks(context, fixed_.size(), grain, [&](std::size_t begin, std::size_t end) {
        double& here = largest[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            const auto id = static_cast<PointId>(first_ + i);
            if (const exact::Point* const at = points.lattice_point(id))
                here = std::max(here, round(*at, i));
            else
                points.with(id, [&](const auto& point) {
                    here = std::max(here, round(exact::homogeneous(point), points.cell(id), i));
                });
        }
    });
    largest_rounding_ = *std::max_element(largest.begin(), largest.end()) * lattice_.unit();
}

bool RoundedPoints::is_place(exact::Point point) const {
    for (int axis = 0; axis < 3; ++axis)
        if (Steps(lattice_.origin()[static_cast<std::size_t>(axis)], point[axis], numbers_).beyond != 0)
            return false;
    return true;
}

double RoundedPoints::round(exact::Point point, std::size_t number) {
    double farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto index = static_cast<std::size_t>(axis);
        const Steps grid(lattice_.origin()[index], point[axis], numbers_);
        const std::int64_t steps = std::llrint(static_cast<double>(grid.beyond) * grid.per_unit());
        fixed_[number][index] = grid.beyond == 0 ? fixed(point[axis]) : grid.at(steps);
        if (grid.beyond == 0) continue;
        moved_[number] = 1;
        farthest = std::max(farthest, rounding_at(grid.lacking));
    }
    return farthest;
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
        const Steps grid(lattice_.origin()[index], cell[axis], numbers_);
        const double scaled = (static_cast<double>(grid.beyond) + to_double(rest) / weight) * grid.per_unit();
        const std::int64_t steps = std::llrint(scaled);
        fixed_[number][index] = grid.at(steps);
        const auto is_exact = [&] {
            if (grid.coarse > 0) return rest.sign() == Sign::zero && grid.beyond == steps << grid.coarse;
            constexpr int limbs = Numerator::bits / 64 + 1;
            return exact::WideInt<limbs>(rest) << (fraction_bits - grid.lacking) ==
                   exact::multiply<limbs>(point.weight(), exact::WideInt<1>(steps));
        };
        if (static_cast<double>(steps) == scaled && is_exact()) continue;
        moved_[number] = 1;
        farthest = std::max(farthest, rounding_at(grid.lacking));
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
    // At a power of two numbers are finer on one side: the coarser of both.
    const std::int64_t cell = lattice_.origin()[index] + ((*this)[id][index] >> fraction_bits);
    return std::int64_t{1} << std::max(lacking_bits(cell, numbers_), lacking_bits(cell - 1, numbers_));
}

void RoundedPoints::move(PointId id, Point to) {
    OCTAVO_DCHECK(is_moved(id), "this point has a place of its own");
    fixed_[id - first_] = to;
}

bool hold_shapes(const exact::Lattice& lattice, Numbers numbers) {
    if (numbers == Numbers::doubles) return true;
    const auto holds = [](std::int64_t cell) {
        return std::bit_width(static_cast<std::uint64_t>(std::abs(cell))) <= 24 + coarsest;
    };
    return std::all_of(lattice.origin().begin(), lattice.origin().end(), [&](std::int64_t origin) {
        return holds(origin) && holds(origin + exact::universe_side);
    });
}

double rounding_bound(const exact::Lattice& lattice, Numbers numbers) {
    int lacking = 0;
    for (const std::int64_t origin : lattice.origin())
        lacking = std::max(
            {lacking, lacking_bits(origin, numbers), lacking_bits(origin + exact::universe_side, numbers)});
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
