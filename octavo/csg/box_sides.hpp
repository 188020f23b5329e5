// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#include <octavo/csg/point_colors.hpp>
#include <octavo/csg/program.hpp>

// The box of a leaf, the octants of a cell, and their 35 points.
//
// The three axes lie side by side in one register. A comparison of all three gives three bits, and a table of eight
// says which points or octants they stand for; no branches, because which of them are taken changes with every leaf.
// For use inside a source file only, like all vector types.

namespace octavo::csg {

/// What three bits stand for, one an axis, given what each does.
using AxisTable = std::array<std::uint32_t, 8>;
constexpr AxisTable axis_table(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    AxisTable result{};
    for (std::size_t axes = 0; axes < 8; ++axes)
        result[axes] = (axes & 1 ? x : 0) | (axes & 2 ? y : 0) | (axes & 4 ? z : 0);
    return result;
}

class BoxSides {
  public:
    BoxSides(const Leaf& leaf, const octree::Cell& parent) {
        // Each reads one word more than its three, which the leaf has.
        static_assert(offsetof(Leaf, high) + sizeof(Ints) <= sizeof(Leaf));
        std::memcpy(&low_, leaf.low.data(), sizeof low_);
        std::memcpy(&high_, leaf.high.data(), sizeof high_);
        corner_[0] = Ints{parent.low.x, parent.low.y, parent.low.z, 0};
        const std::int32_t half = parent.side() / 2;
        corner_[1] = corner_[0] + half;
        corner_[2] = corner_[1] + half;
        middle_[0] = corner_[0] + half / 2;
        middle_[1] = corner_[1] + half / 2;
    }

    /// Octants whose interior keeps off the box, and those that lie in it.
    std::uint8_t white() const {
        return static_cast<std::uint8_t>(halves[0][bits((corner_[1] <= low_) | (corner_[0] >= high_))] |
                                         halves[1][bits((corner_[2] <= low_) | (corner_[1] >= high_))]);
    }
    std::uint8_t black() const {
        return static_cast<std::uint8_t>(~(halves[0][bits((corner_[0] < low_) | (corner_[1] > high_))] |
                                           halves[1][bits((corner_[1] < low_) | (corner_[2] > high_))]));
    }
    /// Points strictly off the box, and strictly in it.
    std::uint64_t outside() const {
        return points([this](Ints at) { return (at < low_) | (at > high_); });
    }
    std::uint64_t inside() const {
        return PointColors::all & ~points([this](Ints at) { return (at <= low_) | (at >= high_); });
    }

  private:
    using Ints = std::int32_t __attribute__((vector_size(16)));
    static constexpr std::uint32_t x0 = 0x1249249, y0 = 0x01C0E07, z0 = 0x00001FF;  // corners with no step
    static constexpr std::array<AxisTable, 3> layers{axis_table(x0, y0, z0),
                                                     axis_table(x0 << 1, y0 << 3, z0 << 9),
                                                     axis_table(x0 << 2, y0 << 6, z0 << 18)};
    static constexpr std::array<AxisTable, 2> halves{axis_table(0x55, 0x33, 0x0F),
                                                     axis_table(0xAA, 0xCC, 0xF0)};

    template <class Test>
    std::uint64_t points(const Test& test) const {
        const std::uint32_t corners = layers[0][bits(test(corner_[0]))] | layers[1][bits(test(corner_[1]))] |
                                      layers[2][bits(test(corner_[2]))];
        const std::uint32_t middles = halves[0][bits(test(middle_[0]))] | halves[1][bits(test(middle_[1]))];
        return corners | std::uint64_t{middles} << PointColors::corners;
    }

    static unsigned bits(Ints flags) {
#ifdef __SSE2__
        __m128 lanes;
        std::memcpy(&lanes, &flags, sizeof lanes);
        return static_cast<unsigned>(_mm_movemask_ps(lanes)) & 7;
#else
        return (static_cast<unsigned>(flags[0]) & 1) | (static_cast<unsigned>(flags[1]) & 2) |
               (static_cast<unsigned>(flags[2]) & 4);
#endif
    }

    Ints low_, high_;
    std::array<Ints, 3> corner_;
    std::array<Ints, 2> middle_;
};

}  // namespace octavo::csg
