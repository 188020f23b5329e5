// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/any_scale.hpp>
#include <octavo/base/expansion.hpp>

namespace octavo {
namespace {

/// The sign where doubles can tell: of six products of three numbers, added, the error is less than 2^-49 of the sum of
/// their absolute values, as none overflows and what vanishes is less than 1e-260. 0 where it stays open.
int likely_sign(const std::array<std::array<double, 4>, 3>& m) {
    double largest = 0, sum = 0, absolute = 0;
    for (const auto& row : m)
        for (std::size_t column = 0; column < 3; ++column)
            largest = std::fmax(largest, std::fabs(row[column]));
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        const double right = m[0][i] * m[1][j] * m[2][k], left = m[0][i] * m[1][k] * m[2][j];
        sum += right - left;
        absolute += std::fabs(right) + std::fabs(left);
    }
    const bool is_in_range = largest > 1e-60 && largest < 1e60 && absolute > 1e-200;
    if (!is_in_range || !(std::fabs(sum) > 0x1p-48 * absolute)) return 0;
    return sum > 0 ? 1 : -1;
}

}  // namespace

Affine balanced(const Affine& map) {
    Affine result = map;
    auto& a = result.m;
    const auto scale = [](double& x, double& y, double& z) {
        const Vec3 scaled = scaled_near_one({x, y, z});
        x = scaled.x, y = scaled.y, z = scaled.z;
    };
    for (auto& row : a) scale(row[0], row[1], row[2]), row[3] = 0;
    for (std::size_t column = 0; column < 3; ++column) scale(a[0][column], a[1][column], a[2][column]);
    return result;
}

int determinant_sign(const Affine& map) {
    if (const int sign = likely_sign(map.m)) return sign;
    const auto a = balanced(map).m;
    Expansion<24> determinant;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        determinant.add_product(a[0][i], a[1][j], a[2][k]);
        determinant.add_product(-a[0][i], a[1][k], a[2][j]);
    }
    return determinant.sign();
}

bool Affine::mirrors() const { return determinant_sign(*this) < 0; }

}  // namespace octavo
