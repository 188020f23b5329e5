// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/csg/second_order_cone.hpp>

namespace octavo::csg {
namespace {

/// LᵀL − wwᵀ with the constant row as fourth coordinate, about `centre`: ten numbers that name the surface.
std::array<double, 10> quadratic_form(const SecondOrderCone& cone, const std::array<double, 3>& centre) {
    std::array<std::array<double, 4>, 4> moved = cone.row;
    for (auto& row : moved)
        for (std::size_t axis = 0; axis < 3; ++axis) row[3] += row[axis] * (centre[axis] - cone.origin[axis]);
    // A positive factor on all rows is the same cone: it is taken out.
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) square += moved[i][axis] * moved[i][axis];
    for (auto& row : moved)
        for (double& entry : row) entry /= std::sqrt(square);
    std::array<double, 10> form{};
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i; j < 4; ++j, ++next)
            form[next] = moved[0][i] * moved[0][j] + moved[1][i] * moved[1][j] + moved[2][i] * moved[2][j] -
                         moved[3][i] * moved[3][j];
    return form;
}

}  // namespace

bool same_cone(const SecondOrderCone& a, const SecondOrderCone& b) {
    // Coefficients are compared after each coordinate is scaled by the surface's own size there, so that all
    // are about one. Products of a few matrices leave some 2^-49; different surfaces of one job that are this
    // near are nearer than 2^-30 of their size, less than the lattice tells apart.
    constexpr double tolerance = 0x1p-32;
    const std::array<double, 10> p = quadratic_form(a, a.origin), q = quadratic_form(b, a.origin);
    std::array<double, 4> scale{};
    double square = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t r = 0; r < 3; ++r) {
            scale[i] += a.row[r][i] * a.row[r][i];
            square += a.row[r][i] * a.row[r][i];
        }
        scale[i] += a.row[3][i] * a.row[3][i];
    }
    for (std::size_t i = 0; i < 3; ++i) scale[i] = std::sqrt(scale[i] / square);
    scale[3] = a.constant / std::sqrt(square);
    std::size_t next = 0;
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i; j < 4; ++j, ++next)
            if (!(std::fabs(p[next] - q[next]) <= tolerance * scale[i] * scale[j])) return false;
    // The same quadric bounds both nappes of a cone: the axis must point the same way.
    double along = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) along += a.row[3][axis] * b.row[3][axis];
    return along >= 0;
}

}  // namespace octavo::csg
