// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/exact/lattice.hpp>

namespace octavo::exact {
namespace {

constexpr int least_exponent =
    -1000;  // keeps the unit, its inverse and every world coordinate a normal double
constexpr int greatest_exponent = 900;

// Integers up to 2^53 are exact doubles, and so must origin + point be.
constexpr std::int64_t least_origin = -(std::int64_t{1} << 53);
constexpr std::int64_t greatest_origin = (std::int64_t{1} << 53) - (universe_side - 1);

/// The exponent from which on a lattice may fit; a lower one cannot.
int first_exponent(const Box3& content) {
    const Vec3 extents = content.extents();
    const double extent = std::max({extents.x, extents.y, extents.z});
    if (extent > 0) return std::ilogb(extent) - coordinate_bits + 1;
    // A single point: the unit of its last bit represents it exactly.
    double magnitude = 0;
    for (int axis = 0; axis < 3; ++axis) magnitude = std::max(magnitude, std::fabs(content.low[axis]));
    return magnitude > 0 ? std::max(least_exponent, std::ilogb(magnitude) - 52) : 0;
}

/// Where the universe of unit 2^exponent begins along one axis, in units; none when it is too small for the
/// content, or when the content is so far away that its coordinates in units are not exact.
std::optional<std::int64_t> origin_for(double content_low, double content_high, double unit) {
    const double low = std::nearbyint(content_low / unit), high = std::nearbyint(content_high / unit);
    // The content is centred, so that its surroundings are alike, or as nearly as the range of origins allows.
    const double centred = low - std::floor((static_cast<double>(universe_side) - 1 - (high - low)) / 2);
    const double origin =
        std::clamp(centred, static_cast<double>(least_origin), static_cast<double>(greatest_origin));
    // One unit stays free on either side.
    if (!(low - origin >= 1 && high - origin <= universe_side - 2)) return std::nullopt;
    return static_cast<std::int64_t>(origin);
}

}  // namespace

Result<Lattice> Lattice::fit(const Box3& content) {
    if (content.empty() || !is_finite(content.low) || !is_finite(content.high))
        return Error{ErrorCode::bad_input, "the bounds of the content are empty or not finite", {}};
    if (!is_finite(content.extents()))
        return Error{ErrorCode::limit, "the content is larger than a double can hold", {}};
    int exponent = first_exponent(content);
    if (exponent < least_exponent)
        return Error{ErrorCode::limit,
                     "the content is too small for a lattice: its longest side must be 0 or at least 2^-975, "
                     "or 3e-294; scale it up",
                     {}};

    // A few steps, unless the content lies far from the world's origin for its size: then the unit grows to the
    // spacing of doubles there, so that nothing that the input could express is lost.
    for (; exponent <= greatest_exponent; ++exponent) {
        const double unit = std::ldexp(1.0, exponent);
        const auto x = origin_for(content.low.x, content.high.x, unit);
        const auto y = origin_for(content.low.y, content.high.y, unit);
        const auto z = origin_for(content.low.z, content.high.z, unit);
        if (x && y && z) return from_parts(exponent, {*x, *y, *z});
    }
    return Error{
        ErrorCode::limit,
        "the content is larger than a lattice can hold: its longest side must stay below 2^926, or 5e278",
        {}};
}

Result<Lattice> Lattice::from_parts(int exponent, std::array<std::int64_t, 3> origin) {
    if (exponent < least_exponent || exponent > greatest_exponent)
        return Error{ErrorCode::bad_input, "the lattice's exponent is out of range", {}};
    for (const std::int64_t coordinate : origin)
        if (coordinate < least_origin || coordinate > greatest_origin)
            return Error{ErrorCode::bad_input, "the lattice's origin is out of range", {}};
    Lattice lattice;
    lattice.exponent_ = exponent;
    lattice.unit_ = std::ldexp(1.0, exponent);
    lattice.origin_ = origin;
    return lattice;
}

Point Lattice::snap(Vec3 p) const {
    const auto coordinate = [&](double world, int axis) {
        // Division by a power of two is exact unless it underflows, and then the quotient rounds to 0 all the
        // same; nearbyint is the one rounding in the life of a vertex.
        const double local = std::nearbyint(world / unit_) - static_cast<double>(origin_[axis]);
        OCTAVO_CHECK(local >= 0 && local < universe_side,
                     "a point outside the lattice's universe was snapped");
        return static_cast<std::int32_t>(local);
    };
    return {coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
}

std::optional<Point> Lattice::cell_at(Vec3 p) const {
    std::array<std::int32_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
        const double scaled = p[axis] / unit_;
        // A quotient that underflows to zero must still fall on its own side of zero.
        const double floor = scaled == 0 && p[axis] < 0 ? -1 : std::floor(scaled);
        const double local = floor - static_cast<double>(origin_[axis]);
        if (!(local >= 0 && local < universe_side)) return std::nullopt;
        cell[axis] = static_cast<std::int32_t>(local);
    }
    return Point{cell[0], cell[1], cell[2]};
}

}  // namespace octavo::exact
