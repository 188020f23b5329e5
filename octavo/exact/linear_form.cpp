// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/exact/linear_form.hpp>
#include <octavo/exact/wide_int.hpp>

namespace octavo::exact {
namespace {

constexpr int offset_bits = 120;

/// value * 2^exponent.
struct Term {
    int128 value = 0;
    int exponent = 0;
};

/// An integer times a double; |value| < 2^117.
Term product(std::int64_t factor, double number) {
    static_assert(64 + 53 < 127);
    int exponent = 0;
    const double fraction = std::frexp(number, &exponent);
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
    return {wide(mantissa) * factor, exponent - 53};
}

}  // namespace

LinearForm::LinearForm(std::int64_t a, std::int64_t b, std::int64_t c, int128 d, int exponent)
    : coefficients_{a, b, c},
      offset_approximation_(std::ldexp(static_cast<double>(d), exponent)),
      offset_(d),
      exponent_(exponent) {
    OCTAVO_CHECK(exponent >= -1074 && exponent <= 900, "a linear form's exponent is out of range");
    constexpr int128 limit = int128{1} << offset_bits;
    OCTAVO_CHECK(-limit < d && d < limit, "a linear form's offset is out of range");
}

LinearForm LinearForm::of(const Lattice& lattice, const Plane& plane) {
    // n.(p / unit - origin) + d, times the unit; |origin| <= 2^53.
    static_assert(budget::sum(4, budget::normal + 54) < offset_bits);
    const auto& origin = lattice.origin();
    const int128 shift =
        wide(plane.a()) * origin[0] + wide(plane.b()) * origin[1] + wide(plane.c()) * origin[2];
    return {plane.a(), plane.b(), plane.c(), plane.d() - shift, lattice.exponent()};
}

Sign LinearForm::exact_at(Vec3 p) const {
    OCTAVO_CHECK(is_finite(p), "a linear form was asked about a point that is not finite");
    std::array<Term, 4> terms{product(coefficients_[0], p.x), product(coefficients_[1], p.y),
                              product(coefficients_[2], p.z), Term{offset_, exponent_}};
    std::sort(terms.begin(), terms.end(),
              [](const Term& first, const Term& second) { return first.exponent > second.exponent; });

    // Horner's rule in powers of two, from the greatest exponent down. Once the next exponent is so far below
    // that the remaining terms, less than 3 * 2^120 of it together, cannot reach one unit of the sum, the sum
    // decides.
    constexpr int far = offset_bits + 2;
    static_assert(offset_bits >= 64 + 53);
    constexpr int width = budget::limbs(offset_bits + 3 * far + 2);
    WideInt<width> sum(terms[0].value);
    for (std::size_t i = 1; i < terms.size(); ++i) {
        const int gap = terms[i - 1].exponent - terms[i].exponent;
        const Sign sign = sum.sign();
        if (sign != Sign::zero) {
            if (gap >= far) return sign;
            sum <<= gap;
        }
        sum += WideInt<width>(terms[i].value);
    }
    return sum.sign();
}

}  // namespace octavo::exact
