// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

// One coordinate of the world as a whole number of lattice units and a fraction of one.

namespace octavo::query {

/// Rounds down what is below 2^53. Where floor is no instruction, calling it costs more than the rest of finding a
/// place.
inline double floor_of(double x) {
#ifdef __SSE4_1__
    return std::floor(x);
#else
    const auto towards_zero = static_cast<double>(static_cast<std::int64_t>(x));
    return towards_zero > x ? towards_zero - 1 : towards_zero;
#endif
}

struct LatticeCoordinate {
    std::int64_t whole = 0;  ///< from the world's origin
    double part = 0;         ///< in [0, 1]; rounded only where LatticePlace (leaf_test.hpp) says so

    /// False farther than 2^53 units from the world's origin, where no universe lies, and for what is no number.
    bool split(double world, double inverse_unit) {
        // Exact, but for underflow to zero, whose sign must not be lost, and overflow, which is far away anyhow.
        const double scaled = world * inverse_unit;
        if (!(std::fabs(scaled) <= 0x1p53)) return false;
        const double floor = scaled == 0 && world < 0 ? -1.0 : floor_of(scaled);
        whole = static_cast<std::int64_t>(floor);
        part = scaled - floor;
        return true;
    }
};

}  // namespace octavo::query
