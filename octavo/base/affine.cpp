// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <vector>

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
            if (const double size = std::fabs(row[column]); size > largest) largest = size;
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

/// The product of three factors and a power of two.
struct Product {
    std::array<double, 3> factor{};  ///< magnitudes in [1/2, 1)
    int exponent = 0;
};

/// Those of the six that are not zero.
std::vector<Product> products_of_determinant(const std::array<std::array<double, 4>, 3>& m) {
    std::vector<Product> products;
    const auto add = [&](double sign, double x, double y, double z) {
        Product product;
        const std::array<double, 3> entries{sign * x, y, z};
        for (std::size_t i = 0; i < 3; ++i) {
            int exponent = 0;
            product.factor[i] = std::frexp(entries[i], &exponent);
            product.exponent += exponent;
            if (entries[i] == 0) return;
        }
        products.push_back(product);
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        add(1, m[0][i], m[1][j], m[2][k]);
        add(-1, m[0][i], m[1][k], m[2][j]);
    }
    return products;
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
    std::vector<Product> products = products_of_determinant(map.m);
    std::sort(products.begin(), products.end(),
              [](const Product& a, const Product& b) { return a.exponent > b.exponent; });
    // From the largest on. What is added is a multiple of 2^-159 of the product's own power of two, so once the next is
    // so far below that six of them are less, the sum decides; if that is nothing, the next begins anew. So no power of
    // two is below that of the first by more than doubles reach.
    constexpr int far = 159 + 3;
    static_assert(5 * far + 159 + 3 < 1022);
    Expansion<24> sum;
    int largest = 0;
    for (std::size_t i = 0; i < products.size(); ++i) {
        const auto& [factor, exponent] = products[i];
        if (i == 0 || products[i - 1].exponent - exponent > far) {
            if (sum.sign() != 0) break;
            largest = exponent;
        }
        sum.add_product(std::ldexp(factor[0], exponent - largest), factor[1], factor[2]);
    }
    return sum.sign();
}

bool Affine::mirrors() const { return determinant_sign(*this) < 0; }

}  // namespace octavo
