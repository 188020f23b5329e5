// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <octavo/mesh/mesh.hpp>

// A thin box round a patch of surface: along the patch's mean normal, and along those directions in its plane that make
// the box small; along the coordinate axes where that is smaller.
//
// Axes are whole numbers, so that a few bytes hold a box and its sides are those of the axes that are stored, not of
// those that were meant. They are at right angles and of unit length but for 3 · 0.5 / 32767 < 5e-5 in all, so a point
// is at least 1 − 5e-5 times as far from the box as its coordinates along the axes say.

namespace octavo::query {

struct TurnedBox {
    static constexpr int unit = 32767;  ///< stands for 1 in `axes`
    /// Corners of patches may have coordinates so large in steps: turned and rounded they still fit into 16 bits.
    static constexpr double reach = 16384;
    /// By so many steps boxes are larger than they need to be: roundings of those who compare.
    static constexpr double slack = 0.5;

    std::array<std::array<std::int16_t, 3>, 3> axes{};
    std::array<std::int16_t, 3> low{}, high{};  ///< steps

    /// Round some faces, relative to `origin`. Precondition: their corners lie within `reach` steps of it along each
    /// coordinate axis.
    static TurnedBox round(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> faces,
                           const std::array<std::int32_t, 3>& origin, double step);
};

}  // namespace octavo::query
