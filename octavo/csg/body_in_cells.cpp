// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <algorithm>
#include <bit>
#include <cstring>

#include <octavo/csg/body_in_cells.hpp>

namespace octavo::csg {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Flags = std::int32_t __attribute__((vector_size(32)));
constexpr std::size_t lanes = 8, most_at_once = 8;

// How deep in a constraint the walk aims to arrive, in parts of a cell, by round. Less every time: thin bodies leave no
// more room.
constexpr std::array<float, 5> aims{0.08F, 0.05F, 0.02F, 0.006F, 0.002F};

Floats absolute(Floats v) { return v < 0 ? -v : v; }
Floats larger(Floats a, Floats b) { return a > b ? a : b; }
Floats smaller(Floats a, Floats b) { return a < b ? a : b; }
bool any(Flags flags) {
    std::array<std::uint64_t, 4> words;
    static_assert(sizeof words == sizeof flags);
    std::memcpy(words.data(), &flags, sizeof words);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}

using Point = std::array<Floats, 3>;

/// A surface at a point of each lane.
struct Tangent {
    Floats value;
    Point gradient;

    Tangent() = default;
    Tangent(const BrickSurface& s, const Point& p) {
        const Floats x = p[0], y = p[1], z = p[2];
        const Floats along_x = s.x + x * s.xx + (y * s.xy + z * s.xz), along_y = s.y + y * s.yy + z * s.yz,
                     along_z = s.z + z * s.zz;
        value = s.low + (x * along_x + y * along_y + z * along_z);
        gradient = {along_x + x * s.xx, along_y + (y * s.yy + x * s.xy),
                    along_z + (z * s.zz + (x * s.xz + y * s.yz))};
    }
};

/// Up to eight cells, one a lane.
class CellLanes {
  public:
    CellLanes(std::span<const BrickSurface> surfaces, const Point& low) : surfaces_(surfaces), low_(low) {
        for (std::size_t a = 0; a < 3; ++a) point_[a] = low_[a] + 0.5F;
    }

    Flags entered() const { return entered_; }
    Flags missed() const { return missed_; }

    void walk() {
        for (const float aim : aims) {
            look();
            if (!any(~(entered_ | missed_))) return;
            move(aim);
        }
        look();
    }

  private:
    /// The sum of what each axis adds to a linear function at the point on the way to where it is least in the cell.
    Floats fall(const Point& gradient) const {
        Floats sum{};
        for (std::size_t a = 0; a < 3; ++a) {
            const Floats down = low_[a] - point_[a];
            sum += smaller(gradient[a] * down, gradient[a] * (down + 1));
        }
        return sum;
    }

    /// What the surfaces at the point tell.
    void look() {
        Flags inside = ~Flags{};
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const BrickSurface& surface = surfaces_[i];
            const Tangent& tangent = tangents_[i] = Tangent(surface, point_);
            inside &= tangent.value < -surface.error;
            // The tangent has 40 roundings of parts of the surface's size: less than eight errors, which are 256.
            missed_ |= tangent.value + fall(tangent.gradient) > 8 * surface.error + surface.bend;
        }
        entered_ |= inside;
        for (std::size_t i = 0; i < surfaces_.size(); ++i)
            for (std::size_t j = i + 1; j < surfaces_.size(); ++j) compare(i, j);
    }

    /// Whether a weighted sum of two tangents is positive in all of the cell.
    void compare(std::size_t i, std::size_t j) {
        const Tangent &first = tangents_[i], &second = tangents_[j];
        for (std::size_t a = 0; a < 3; ++a) {
            const Floats p = first.gradient[a], q = second.gradient[a];
            missed_ |= (p * q < 0) &
                       is_positive(absolute(q), first, surfaces_[i], absolute(p), second, surfaces_[j]);
        }
    }

    /// Moves the point on to the insides of all surfaces that it is outside of.
    void move(float aim) {
        Point step{};
        for (std::size_t i = 0; i < surfaces_.size(); ++i) {
            const Tangent& tangent = tangents_[i];
            Floats square{};
            for (std::size_t a = 0; a < 3; ++a) {
                // A point on a side of the cell slides along it.
                const Floats g = tangent.gradient[a];
                const Flags free = g > 0 ? point_[a] > low_[a] : point_[a] < low_[a] + 1;
                square += free ? g * g : Floats{};
            }
            const Floats excess = larger(tangent.value + aim * surfaces_[i].slope, Floats{});
            const Floats factor = excess / larger(square, Floats{} + 0x1p-100F);
            for (std::size_t a = 0; a < 3; ++a) step[a] += factor * tangent.gradient[a];
        }
        for (std::size_t a = 0; a < 3; ++a)
            point_[a] = smaller(larger(point_[a] - step[a], low_[a]), low_[a] + 1);
    }

    Flags is_positive(Floats p, const Tangent& first, const BrickSurface& a, Floats q, const Tangent& second,
                      const BrickSurface& b) const {
        Point gradient;
        for (std::size_t i = 0; i < 3; ++i) gradient[i] = p * first.gradient[i] + q * second.gradient[i];
        const Floats least = p * first.value + q * second.value + fall(gradient);
        // Infinite where a product overflows, which proves nothing.
        return (least > p * (16 * a.error + a.bend) + q * (16 * b.error + b.bend)) & (least < 0x1p120F);
    }

    std::span<const BrickSurface> surfaces_;
    Point low_, point_;
    std::array<Tangent, most_at_once> tangents_;
    Flags entered_{}, missed_{};
};

}  // namespace

BodyInCells body_in_cells(std::span<const BrickSurface> surfaces, const Layers& asked) {
    const bool complete = surfaces.size() <= most_at_once;
    if (!complete) surfaces = surfaces.first(most_at_once);
    BodyInCells result;
    Layers left = asked;
    for (;;) {
        std::array<BrickCell, lanes> cells{};
        std::size_t count = 0;
        for (; count < lanes; ++count) {
            const std::optional<BrickCell> next = take_first(left);
            if (!next) break;
            cells[count] = *next;
        }
        if (count == 0) return result;
        std::array<std::array<float, lanes>, 3> low{};
        for (std::size_t i = 0; i < lanes; ++i) {
            const BrickCell& cell = cells[i < count ? i : 0];
            low[0][i] = static_cast<float>(cell.x);
            low[1][i] = static_cast<float>(cell.y);
            low[2][i] = static_cast<float>(cell.z);
        }
        Point corner;
        static_assert(sizeof corner == sizeof low);
        std::memcpy(corner.data(), low.data(), sizeof corner);
        CellLanes walked(surfaces, corner);
        walked.walk();
        for (std::size_t i = 0; i < count; ++i) {
            if (walked.missed()[i]) cells[i].add_to(result.missed);
            if (complete && walked.entered()[i]) cells[i].add_to(result.entered);
        }
    }
}

}  // namespace octavo::csg
