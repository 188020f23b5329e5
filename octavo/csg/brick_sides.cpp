// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <bit>
#include <cstring>

#include <octavo/csg/brick_sides.hpp>
#include <octavo/csg/float_lanes.hpp>
#include <octavo/csg/surface_steps.hpp>

namespace octavo::csg {
namespace {

// Lane k of a register is layer k.
constexpr Floats corner_z{0, 1, 2, 3, 4, 0, 0, 0};
constexpr std::uint32_t row_bits = 5;  // from one row of corners or cells to the next

Layers layers_of(Flags flags) { return {std::bit_cast<Layers::Lanes>(flags)}; }

bool all_known(const LayerPair& corners) { return (corners.out | corners.in) == Layers::corners(); }

/// The corners one by one, in quarters of the brick, for the slow ways.
template <class Value>
LayerPair corners_one_by_one(const Value& value, decltype(value(0, 0, 0)) error) {
    LayerPair corners;
    for (int k = 0; k < 5; ++k)
        for (int j = 0; j < 5; ++j)
            for (int i = 0; i < 5; ++i) {
                const auto at = value(i, j, k);
                const int bit = i + static_cast<int>(row_bits) * j;
                corners.in.layer[static_cast<std::size_t>(k)] |= static_cast<std::uint32_t>(at < -error)
                                                                 << bit;
                corners.out.layer[static_cast<std::size_t>(k)] |= static_cast<std::uint32_t>(at > error)
                                                                  << bit;
            }
    return corners;
}

/// A quadric at all corners.
struct QuadricCorners {
    Layers inside;   ///< all others are outside, unless some value is within the error
    Layers far_off;  ///< where the quadric is larger than `bend`
    bool all_known;
};

/// The corners of a layer, 25 in four registers, in the order of signs(); the last lanes repeat the last corner.
struct SquareOfCorners {
    alignas(32) std::array<std::array<float, 8>, 4> x{}, y{};
};
constexpr SquareOfCorners square_of_corners = [] {
    SquareOfCorners square;
    for (std::size_t n = 0; n < 32; ++n) {
        const std::size_t corner = n < 25 ? n : 24, lane = n % 4 + n / 16 * 4;
        square.x[n / 4 % 4][lane] = static_cast<float>(corner % 5);
        square.y[n / 4 % 4][lane] = static_cast<float>(corner / 5);
    }
    return square;
}();
Floats in_register(const std::array<float, 8>& numbers) {
    Floats result;
    std::memcpy(&result, numbers.data(), sizeof result);
    return result;
}

/// Layer by layer, of which only the constant and the linear term change.
QuadricCorners corners_of(const QuadricSteps& q, float error, float bend) {
    std::array<Floats, 4> floor, rise;
    for (std::size_t r = 0; r < 4; ++r) {
        const Floats x = in_register(square_of_corners.x[r]), y = in_register(square_of_corners.y[r]);
        const Floats along_x = multiply_add(x, q.xx, multiply_add(y, q.xy, Floats{} + q.x)),
                     along_y = multiply_add(y, q.yy, Floats{} + q.y);
        floor[r] = multiply_add(x, along_x, multiply_add(y, along_y, Floats{} + q.low));
        rise[r] = multiply_add(x, q.xz, multiply_add(y, q.yz, Floats{} + q.z));
    }
    Floats nearest = Floats{} + 0x1p120F;
    std::array<std::uint32_t, 5> inside, far_off;
    for (std::size_t k = 0; k < 5; ++k) {
        const auto z = static_cast<float>(k);
        std::array<Floats, 4> value, above;
        for (std::size_t r = 0; r < 4; ++r) {
            value[r] = multiply_add(rise[r], z, floor[r] + z * z * q.zz);
            above[r] = std::bit_cast<Floats>(value[r] > bend);
            nearest = smaller(absolute(value[r]), nearest);
        }
        inside[k] = signs(value[0], value[1], value[2], value[3]);
        far_off[k] = signs(above[0], above[1], above[2], above[3]);
    }
    const auto layers = [](const std::array<std::uint32_t, 5>& bits) {
        return Layers{Layers::Lanes{bits[0], bits[1], bits[2], bits[3], bits[4], 0, 0, 0}} &
               Layers::corners();
    };
    return {layers(inside), layers(far_off), !layers_of(~(nearest > error)).any()};
}

/// Two to the n, less one, in a float: a count of corners as their bits. For counts of five corners in three rows.
class RowBits {
  public:
    /// The lowest corners of row j, as many as the integer part of a number from 0 to 5.
    void add(std::uint32_t j, Floats count) {
        const std::int32_t shift = 127 + static_cast<std::int32_t>(row_bits * (j < 3 ? j : j - 3));
        const Flags power = (__builtin_convertvector(count, Flags) + shift) << 23;
        (j < 3 ? low_ : high_) += std::bit_cast<Floats>(power);
    }
    Layers layers() const {
        constexpr std::int32_t ones_of_two = 1 + (1 << row_bits),
                               ones_of_three = ones_of_two + (1 << 2 * row_bits);
        const Flags bits = (__builtin_convertvector(low_, Flags) - ones_of_three) +
                           ((__builtin_convertvector(high_, Flags) - ones_of_two) << (3 * row_bits));
        return layers_of(bits) & Layers::corners();
    }

  private:
    Floats low_{}, high_{};
};

/// Along a row of corners a plane changes sides once, so where it does is all there is to know: a division for the
/// plane instead of two comparisons for each of 125 corners. A place passes through at most twelve roundings of values
/// in the brick, taken in steps; the error has room for 32.
LayerPair corners_of(const PlaneSteps& p) {
    const float turn = p.sx < 0 ? -1.0F : 1.0F;
    // Steps are whole numbers; one in place of none changes values by less than the error, which is 2^14 at least.
    const float scale = turn / std::max(turn * p.sx, 1.0F), error = p.error(4) * std::fabs(scale);
    const Floats column = 1.0F - scale * (p.at_low + corner_z * p.sz);
    RowBits inside, not_outside;
    const Floats step = Floats{} - scale * p.sy;
    for (std::uint32_t j = 0; j < 5; ++j) {
        const Floats row = multiply_add(step, static_cast<float>(j), column);
        const auto clamped = [](Floats v) { return smaller(larger(v, Floats{}), Floats{} + 5); };
        inside.add(j, clamped(row - error));
        not_outside.add(j, clamped(row + error));
    }
    const Layers in = inside.layers(), out = without(Layers::corners(), not_outside.layers());
    return turn > 0 ? LayerPair{out, in} : LayerPair{in, out};
}

/// How far a quadric can be below the least of its values at a cell's corners: along each axis it falls short of what
/// lies linearly between the ends by at most a quarter of the square term, and mixed terms are linear along each axis.
float bend_between_corners(const QuadricSteps& q) {
    return 0.25F * (std::max(q.xx, 0.0F) + std::max(q.yy, 0.0F) + std::max(q.zz, 0.0F));
}

void leave_other_nappe(const NappeSteps& nappe, LayerPair& corners, Layers& missed) {
    const auto value = [&](int i, int j, int k) { return nappe.at(i, j, k); };
    const Layers negative = corners_one_by_one(value, 0.0).in;
    corners.out = corners.out | (corners.in & negative);
    corners.in = without(corners.in, negative);
    for (std::uint32_t k = 0; k < 4; ++k)
        for (std::uint32_t j = 0; j < 4; ++j)
            for (std::uint32_t i = 0; i < 4; ++i)
                if (nappe.at(i + 0.5, j + 0.5, k + 0.5) + nappe.reach < -nappe.error)
                    BrickCell{i, j, k}.add_to(missed);
}

/// Numbers along the three axes, of the low sides of a box and then of its high sides.
using BoxCounts = std::int32_t __attribute__((vector_size(32)));

/// Bits of the numbers 0 to `limit` − 1 that are below the first of two counts, or not below the second, by axis.
std::array<std::uint32_t, 3> not_between(BoxCounts counts, std::int32_t limit) {
    counts = counts > 0 ? counts : BoxCounts{};
    counts = counts < limit ? counts : BoxCounts{} + limit;
    const auto all = static_cast<std::uint32_t>((1 << limit) - 1);
    std::array<std::uint32_t, 3> bits;
    for (std::size_t a = 0; a < 3; ++a) bits[a] = (all >> (limit - counts[a])) | (all & all << counts[a + 4]);
    return bits;
}

/// Rows of five bits by the bits of a number, one a row.
constexpr std::array<std::uint32_t, 32> rows_of_bits = [] {
    std::array<std::uint32_t, 32> rows{};
    for (std::uint32_t bits = 0; bits < 32; ++bits)
        for (std::uint32_t j = 0; j < 5; ++j)
            if (bits >> j & 1) rows[bits] |= std::uint32_t{31} << (row_bits * j);
    return rows;
}();

/// Bits along x, y and z as layers: all that have any of them.
Layers any_axis(const std::array<std::uint32_t, 3>& bits) {
    constexpr Flags bit_of_layer{1, 2, 4, 8, 16, 0, 0, 0};
    constexpr std::uint32_t one_a_row = rows_of_bits[31] / 31;
    const std::uint32_t square = bits[0] * one_a_row | rows_of_bits[bits[1]];
    const Flags full = (static_cast<std::int32_t>(bits[2]) & bit_of_layer) != 0;
    return Layers{layers_of(full).layer | square};
}

// Weights of tangents are products of components, so coefficients are brought to a size whose squares single precision
// holds: those of quadrics are about one or less, those of planes up to 2^63.
constexpr float plane_scale = 0x1p-48F;

void see(const PlaneSteps& p, BrickSurface& s) {
    s.xx = s.yy = s.zz = s.xy = s.xz = s.yz = s.bend = 0;
    s.curved = false;
    s.plain = true;
    s.low = p.at_low * plane_scale;
    s.x = p.sx * plane_scale, s.y = p.sy * plane_scale, s.z = p.sz * plane_scale;
    s.error = p.error(4) * plane_scale + underflow;
    s.slope = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
}

void see(const QuadricSteps& q, float error, BrickSurface& s) {
    s.low = q.low, s.x = q.x, s.y = q.y, s.z = q.z;
    s.xx = q.xx, s.yy = q.yy, s.zz = q.zz, s.xy = q.xy, s.xz = q.xz, s.yz = q.yz;
    s.error = error;
    s.curved = s.plain = true;
    const float x = q.x + 4 * q.xx + 2 * (q.xy + q.xz), y = q.y + 4 * q.yy + 2 * (q.xy + q.yz),
                z = q.z + 4 * q.zz + 2 * (q.xz + q.yz);
    s.slope = std::sqrt(x * x + y * y + z * z);
}

/// Whether a brick lies in the interior of a leaf's box. That takes less than counting quarters and is so for a third
/// of the leaves.
bool holds(const Leaf& leaf, const octree::Cell& brick) {
    bool result = true;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        result &= leaf.low[a] < brick.low[axis];
        result &= leaf.high[a] > brick.low[axis] + brick.side();
    }
    return result;
}

}  // namespace

BrickSides brick_sides(const LatticePlane& plane, const octree::Cell& brick, BrickSurface& surface) {
    const PlaneSteps p(plane, brick, brick.side() / 4);
    see(p, surface);
    LayerPair corners = corners_of(p);
    if (!all_known(corners))
        corners = corners_one_by_one(
            [&](int i, int j, int k) { return -p.low - i * p.x - j * p.y - k * p.z; }, std::int64_t{0});
    return {corners, without(Layers::cells(), cells_with_corner(corners.in)),
            without(Layers::cells(), cells_with_corner(corners.out))};
}

BrickSides brick_sides(const Quadric& quadric, const octree::Cell& brick, BrickSurface& surface) {
    const Offset offset(quadric.origin, brick);
    const double quarter = 0.25 * brick.side(), error = quadric.error(offset.farthest);
    const QuadricAtCorner corner(quadric, offset.low);
    const QuadricSteps q(quadric, corner, quarter, 4);
    const float rounding = single_error * q.size + (static_cast<float>(error) * 1.0001F + underflow);
    see(q, rounding, surface);
    // The error of the values and of the bend, each with as much to spare.
    const QuadricCorners seen = corners_of(q, rounding, 4 * rounding + bend_between_corners(q));
    LayerPair corners{without(Layers::corners(), seen.inside), seen.inside};
    if (!seen.all_known)
        corners = corners_one_by_one(
            [&](int i, int j, int k) { return corner.at(quadric, i * quarter, j * quarter, k * quarter); },
            error);
    Layers white = without(Layers::cells(), cells_with_corner(without(Layers::corners(), seen.far_off)));
    const auto drop = static_cast<float>(0.5 * quarter * quadric.axis_reach);
    surface.bend = 4 * drop * drop * 1.0001F;
    if (quadric.axis_reach != 0) {
        const NappeSteps nappe(quadric, offset, quarter);
        surface.plain = nappe.all_positive(4);
        if (!surface.plain) leave_other_nappe(nappe, corners, white);
    }
    return {corners, white,
            without(Layers::cells(), cells_with_corner(without(Layers::corners(), corners.in)))};
}

BrickSides brick_sides(const LatticeTorus& torus, const octree::Cell& brick) {
    const Offset offset(torus.origin, brick);
    const double quarter = 0.25 * brick.side();
    BrickSides result;
    result.corners = corners_one_by_one(
        [&](int i, int j, int k) {
            return torus.distance(offset.low[0] + i * quarter, offset.low[1] + j * quarter,
                                  offset.low[2] + k * quarter);
        },
        torus.error(offset.farthest));
    return result;
}

BrickSides brick_sides_of_box(const Leaf& leaf, const octree::Cell& brick) {
    if (holds(leaf, brick))
        return leaf.kind == LeafKind::box ? BrickSides{{{}, Layers::corners()}, {}, Layers::cells()}
                                          : BrickSides{};
    const int shift = std::countr_zero(static_cast<std::uint32_t>(brick.side())) - 2;
    constexpr BoxCounts on_low{-1, -1, -1, 0, 0, 0, 0, 0}, on_high{0, 0, 0, 0, -1, -1, -1, 0};
    const BoxCounts sides{leaf.low[0],  leaf.low[1],  leaf.low[2],  0,
                          leaf.high[0], leaf.high[1], leaf.high[2], 0};
    const BoxCounts corner{brick.low.x, brick.low.y, brick.low.z, 0,
                           brick.low.x, brick.low.y, brick.low.z, 0};
    // How many quarters the sides are from the low corner, rounded down and up.
    const BoxCounts down = (sides - corner) >> shift, up = (sides - corner + ((1 << shift) - 1)) >> shift;
    const Layers out = any_axis(not_between((up & on_low) | ((down + 1) & on_high), 5)) & Layers::corners();
    const Layers white = any_axis(not_between((down & on_low) | (up & on_high), 4)) & Layers::cells();
    if (leaf.kind != LeafKind::box) return {{out, {}}, white, {}};
    return {
        {out, without(Layers::corners(), any_axis(not_between(((down + 1) & on_low) | (up & on_high), 5)))},
        white,
        without(Layers::cells(), any_axis(not_between((up & on_low) | (down & on_high), 4)))};
}

}  // namespace octavo::csg
