// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/exact/lattice.hpp>

namespace octavo::exact {
namespace {

constexpr int least_exponent = -1000;  // keeps unit and every world coordinate a normal double
constexpr int greatest_exponent = 900;
constexpr double greatest_origin = 4503599627370496.0;  // 2^52: origin + point still has an exact double

}  // namespace

Result<Lattice> Lattice::fit(const Box3& content) {
    if (content.empty() || !is_finite(content.low) || !is_finite(content.high))
        return Error{ErrorCode::bad_input, "the bounds of the content are empty or not finite", {}};

    // Rounding may move each end by half a unit, and one unit stays free on either side.
    const double extent = std::max(
        {content.high.x - content.low.x, content.high.y - content.low.y, content.high.z - content.low.z});
    int exponent = least_exponent;
    if (extent > 0) {
        if (!std::isfinite(extent))
            return Error{ErrorCode::limit, "the content is larger than a double can tell", {}};
        exponent = std::clamp(std::ilogb(extent) - coordinate_bits, least_exponent, greatest_exponent);
    } else {
        // A single point: any unit does; take one that represents it exactly where possible.
        double magnitude = 0;
        for (int axis = 0; axis < 3; ++axis) magnitude = std::max(magnitude, std::fabs(content.low[axis]));
        if (magnitude > 0) exponent = std::max(least_exponent, std::ilogb(magnitude) - 51);
    }
    for (; exponent <= greatest_exponent; ++exponent) {
        const double unit = std::ldexp(1.0, exponent);
        Lattice lattice;
        lattice.unit_ = unit;
        lattice.exponent_ = exponent;
        bool fits = true, far = false;
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::nearbyint(content.low[axis] / unit);
            const double high = std::nearbyint(content.high[axis] / unit);
            if (high - low > universe_side - 3) {
                fits = false;
                break;
            }
            // The content is centred, so that its surroundings are alike on every side.
            const double slack = static_cast<double>(universe_side) - 1 - (high - low);
            const double origin = low - std::floor(slack / 2);
            if (std::fabs(origin) > greatest_origin) {
                far = true;
                break;
            }
            lattice.origin_[axis] = static_cast<std::int64_t>(origin);
        }
        if (!fits) continue;
        if (far)
            return Error{
                ErrorCode::limit,
                "the content lies too far from the origin for its size; move it nearer before reading",
                {}};
        return lattice;
    }
    return Error{ErrorCode::limit, "the content is larger than the lattice can hold", {}};
}

Result<Lattice> Lattice::from_parts(int exponent, std::array<std::int64_t, 3> origin) {
    if (exponent < least_exponent || exponent > greatest_exponent)
        return Error{ErrorCode::bad_input, "the lattice's exponent is out of range", {}};
    for (const std::int64_t coordinate : origin)
        if (coordinate > static_cast<std::int64_t>(greatest_origin) ||
            coordinate < -static_cast<std::int64_t>(greatest_origin))
            return Error{ErrorCode::bad_input, "the lattice's origin is out of range", {}};
    Lattice lattice;
    lattice.exponent_ = exponent;
    lattice.unit_ = std::ldexp(1.0, exponent);
    lattice.origin_ = origin;
    return lattice;
}

Point Lattice::snap(Vec3 p) const {
    const auto coordinate = [&](double world, int axis) {
        // Division by a power of two is exact; nearbyint is the one rounding in the life of a vertex.
        const double local = std::nearbyint(world / unit_) - static_cast<double>(origin_[axis]);
        OCTAVO_CHECK(local >= 0 && local < universe_side,
                     "a point outside the lattice's universe was snapped");
        return static_cast<std::int32_t>(local);
    };
    return {coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
}

}  // namespace octavo::exact
