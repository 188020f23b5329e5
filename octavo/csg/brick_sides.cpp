// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <bit>

#include <octavo/csg/brick_sides.hpp>
#include <octavo/csg/surface_steps.hpp>

namespace octavo::csg {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Flags = std::int32_t __attribute__((vector_size(32)));

// Lane k of a register is layer k; of cells, the upper four lanes are the layers again, two rows of cells further.
constexpr Floats corner_z{0, 1, 2, 3, 4, 0, 0, 0};
constexpr Flags corner_lanes{-1, -1, -1, -1, -1, 0, 0, 0};
constexpr Floats cell_z{0.5F, 1.5F, 2.5F, 3.5F, 0.5F, 1.5F, 2.5F, 3.5F};
constexpr Floats cell_y{0.5F, 0.5F, 0.5F, 0.5F, 2.5F, 2.5F, 2.5F, 2.5F};
constexpr std::uint32_t row_bits = 5;  // from one row of corners or cells to the next

Layers layers_of(Flags flags) {
    Layers layers;
    static_assert(sizeof flags == sizeof layers.layer);
    std::memcpy(layers.layer.data(), &flags, sizeof flags);
    return layers;
}

/// Corners below −error and above error.
class CornerSides {
  public:
    explicit CornerSides(float error) : error_(error) {}
    void add(std::uint32_t bit, Floats value) {
        const Flags one = corner_lanes & static_cast<std::int32_t>(1U << bit);
        inside_ |= (value < -error_) & one;
        outside_ |= (value > error_) & one;
    }
    LayerPair corners() const { return {layers_of(outside_), layers_of(inside_)}; }

  private:
    float error_;
    Flags inside_{}, outside_{};
};

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

LayerPair corners_of(const QuadricSteps& q, float error) {
    CornerSides sides(error);
    const Floats column = q.low + corner_z * (q.z + corner_z * q.zz);
    const Floats along_x = q.x + corner_z * q.xz, along_y = q.y + corner_z * q.yz;
    for (std::uint32_t j = 0; j < 5; ++j) {
        const auto y = static_cast<float>(j);
        const Floats row = column + y * (along_y + y * q.yy), slope = along_x + y * q.xy;
        for (std::uint32_t i = 0; i < 5; ++i) {
            const auto x = static_cast<float>(i);
            sides.add(i + row_bits * j, row + x * (slope + x * q.xx));
        }
    }
    return sides.corners();
}

/// Cells in which the tangent at the middle, less `bend`, stays positive. For its rounding see point_sides.cpp.
Layers above_tangent(const QuadricSteps& q, float bend) {
    const auto absolute = [](Floats v) { return v < 0 ? -v : v; };
    const Floats column = q.low + cell_z * (q.z + cell_z * q.zz);
    Flags above{};
    for (std::uint32_t j = 0; j < 2; ++j) {
        const Floats y = cell_y + static_cast<float>(j);
        const Floats row = column + y * (q.y + y * q.yy + cell_z * q.yz);
        const Floats slope = q.x + y * q.xy + cell_z * q.xz;
        const Floats gy = q.y + 2 * y * q.yy + cell_z * q.yz, gz = q.z + 2 * cell_z * q.zz + y * q.yz;
        for (std::uint32_t i = 0; i < 4; ++i) {
            const float x = static_cast<float>(i) + 0.5F;
            const Floats change =
                absolute(slope + 2 * x * q.xx) + absolute(gy + x * q.xy) + absolute(gz + x * q.xz);
            const Floats least = row + x * (slope + x * q.xx) - 0.5F * change;
            above |= (least > bend) & static_cast<std::int32_t>(1U << (i + row_bits * j));
        }
    }
    Layers cells = layers_of(above);
    for (std::size_t k = 0; k < 4; ++k) {
        cells.layer[k] |= cells.layer[k + 4] << (2 * row_bits);
        cells.layer[k + 4] = 0;
    }
    return cells;
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

/// Bits of the numbers 0 to `limit` − 1 that are below `count`.
std::uint32_t below(std::int64_t count, std::int64_t limit) {
    return (std::uint32_t{1} << std::clamp<std::int64_t>(count, 0, limit)) - 1;
}

/// Bits along x, y and z as layers: all that have any of them.
Layers any_axis(const std::array<std::uint32_t, 3>& bits, std::uint32_t count) {
    const std::uint32_t row = (std::uint32_t{1} << count) - 1;
    std::uint32_t square = 0, full = 0;
    for (std::uint32_t j = 0; j < count; ++j) {
        square |= (bits[1] >> j & 1 ? row : bits[0]) << (row_bits * j);
        full |= row << (row_bits * j);
    }
    Layers layers;
    for (std::uint32_t k = 0; k < count; ++k) layers.layer[k] = bits[2] >> k & 1 ? full : square;
    return layers;
}

// Weights of tangents are products of components, so coefficients are brought to a size whose squares single precision
// holds: those of quadrics are about one or less, those of planes up to 2^63.
constexpr float plane_scale = 0x1p-48F;

BrickSurface seen_from_brick(const PlaneSteps& p) {
    BrickSurface s;
    s.low = p.at_low * plane_scale;
    s.x = p.sx * plane_scale, s.y = p.sy * plane_scale, s.z = p.sz * plane_scale;
    s.error = p.error(4) * plane_scale + underflow;
    s.slope = std::sqrt(s.x * s.x + s.y * s.y + s.z * s.z);
    return s;
}

BrickSurface seen_from_brick(const QuadricSteps& q, float error) {
    BrickSurface s;
    s.low = q.low, s.x = q.x, s.y = q.y, s.z = q.z;
    s.xx = q.xx, s.yy = q.yy, s.zz = q.zz, s.xy = q.xy, s.xz = q.xz, s.yz = q.yz;
    s.error = error;
    const float x = q.x + 4 * q.xx + 2 * (q.xy + q.xz), y = q.y + 4 * q.yy + 2 * (q.xy + q.yz),
                z = q.z + 4 * q.zz + 2 * (q.xz + q.yz);
    s.slope = std::sqrt(x * x + y * y + z * z);
    return s;
}

}  // namespace

BrickSides brick_sides(const LatticePlane& plane, const octree::Cell& brick, BrickSurface& surface) {
    const PlaneSteps p(plane, brick, brick.side() / 4);
    surface = seen_from_brick(p);
    CornerSides sides(p.error(4));
    const Floats column = p.at_low + corner_z * p.sz;
    for (std::uint32_t j = 0; j < 5; ++j) {
        const Floats row = column + static_cast<float>(j) * p.sy;
        for (std::uint32_t i = 0; i < 5; ++i) sides.add(i + row_bits * j, row + static_cast<float>(i) * p.sx);
    }
    BrickSides result;
    result.corners = sides.corners();
    if (!all_known(result.corners))
        result.corners = corners_one_by_one(
            [&](int i, int j, int k) { return -p.low - i * p.x - j * p.y - k * p.z; }, std::int64_t{0});
    result.white = without(Layers::cells(), cells_with_corner(result.corners.in));
    result.black = without(Layers::cells(), cells_with_corner(result.corners.out));
    return result;
}

BrickSides brick_sides(const Quadric& quadric, const octree::Cell& brick, BrickSurface& surface) {
    const Offset offset(quadric.origin, brick);
    const double quarter = 0.25 * brick.side(), error = quadric.error(offset.farthest);
    const QuadricAtCorner corner(quadric, offset.low);
    const QuadricSteps q(quadric, corner, quarter, 4);
    const float rounding = single_error * q.size + (static_cast<float>(error) * 1.0001F + underflow);
    surface = seen_from_brick(q, rounding);
    BrickSides result;
    result.corners = corners_of(q, rounding);
    if (!all_known(result.corners))
        result.corners = corners_one_by_one(
            [&](int i, int j, int k) { return corner.at(quadric, i * quarter, j * quarter, k * quarter); },
            error);
    const auto drop = static_cast<float>(0.5 * quarter * quadric.axis_reach);
    result.white = above_tangent(q, 4 * rounding + drop * drop * 1.0001F);
    surface.bend = 4 * drop * drop * 1.0001F;
    if (quadric.axis_reach != 0) {
        const NappeSteps nappe(quadric, offset, quarter);
        surface.plain = nappe.all_positive(4);
        if (!surface.plain) leave_other_nappe(nappe, result.corners, result.white);
    }
    result.black = without(Layers::cells(), cells_with_corner(without(Layers::corners(), result.corners.in)));
    return result;
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
    const int shift = std::countr_zero(static_cast<std::uint32_t>(brick.side())) - 2;
    const bool is_box = leaf.kind == LeafKind::box;
    std::array<std::uint32_t, 3> outside{}, not_inside{}, white{}, not_black{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        // How many quarters the box's sides are from the low corner, rounded down and up.
        const std::int64_t low = std::int64_t{leaf.low[a]} - brick.low[axis];
        const std::int64_t high = std::int64_t{leaf.high[a]} - brick.low[axis];
        const std::int64_t up = (std::int64_t{1} << shift) - 1;
        const std::int64_t low_down = low >> shift, low_up = (low + up) >> shift;
        const std::int64_t high_down = high >> shift, high_up = (high + up) >> shift;
        outside[a] = below(low_up, 5) | (below(5, 5) & ~below(high_down + 1, 5));
        white[a] = below(low_down, 4) | (below(4, 4) & ~below(high_up, 4));
        if (!is_box) continue;
        not_inside[a] = below(low_down + 1, 5) | (below(5, 5) & ~below(high_up, 5));
        not_black[a] = below(low_up, 4) | (below(4, 4) & ~below(high_down, 4));
    }
    BrickSides result;
    result.corners.out = any_axis(outside, 5);
    result.white = any_axis(white, 4);
    if (!is_box) return result;
    result.corners.in = without(Layers::corners(), any_axis(not_inside, 5));
    result.black = without(Layers::cells(), any_axis(not_black, 4));
    return result;
}

}  // namespace octavo::csg
