// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/expansion.hpp>
#include <octavo/base/vec3.hpp>

namespace octavo {
namespace {

using Rows = std::array<std::array<double, 3>, 3>;

/// Multiplies each row by the power of two that brings its largest number to [1/2, 1): signs stay, products do not
/// underflow.
void scale_rows(Rows& rows) {
    for (std::array<double, 3>& row : rows) {
        int exponent = 0;
        std::frexp(std::max({std::fabs(row[0]), std::fabs(row[1]), std::fabs(row[2])}), &exponent);
        for (double& number : row) number = std::ldexp(number, -exponent);
    }
}

}  // namespace

bool Affine::mirrors() const {
    Rows a;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) a[row][column] = m[row][column];
    scale_rows(a);
    Expansion<24> determinant;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        determinant.add_product(a[0][i], a[1][j], a[2][k]);
        determinant.add_product(-a[0][i], a[1][k], a[2][j]);
    }
    return determinant.sign() < 0;
}

}  // namespace octavo
