// SPDX-License-Identifier: Apache-2.0
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors do not leave this file

#include <cstdint>
#include <cstring>

#include <octavo/csg/body_in_cells.hpp>
#include <octavo/csg/float_lanes.hpp>

namespace octavo::csg {
namespace {

// How deep in a constraint the walk aims to arrive, in parts of a cell, by round. Less every time: thin bodies leave no
// more room.
constexpr std::array<float, 5> aims{0.08F, 0.05F, 0.02F, 0.006F, 0.002F};

bool any(Flags flags) {
    std::array<std::uint64_t, 4> words;
    static_assert(sizeof words == sizeof flags);
    std::memcpy(words.data(), &flags, sizeof words);
    return (words[0] | words[1] | words[2] | words[3]) != 0;
}
Floats in_register(const std::array<float, 8>& numbers) {
    Floats result;
    static_assert(sizeof result == sizeof numbers);
    std::memcpy(&result, numbers.data(), sizeof result);
    return result;
}

using Point = std::array<Floats, 3>;

/// A surface at a point of each lane.
struct Tangent {
    Floats value;
    Point gradient;
};

}  // namespace

class BodiesInCells::Walk {
  public:
    explicit Walk(const BodiesInCells& asked)
        : surfaces_(asked.surfaces_.data()), curved_(asked.curved_.data()), count_(asked.used_) {
        for (std::size_t a = 0; a < 3; ++a) {
            low_[a] = in_register(asked.low_[a]);
            point_[a] = low_[a] + 0.5F;
        }
    }

    Flags entered() const { return entered_; }
    Flags missed() const { return missed_; }

    void run() {
        look<true>();
        for (const float aim : aims) {
            if (!any(~(entered_ | missed_))) return;
            move(aim);
            look<false>();
        }
    }

  private:
    /// What the surfaces at the point tell. What only planes say is the same at every point.
    template <bool first>
    void look() {
        Flags inside = ~Flags{};
        for (std::size_t i = 0; i < count_; ++i) {
            const Floats error = in_register(surfaces_[i].error);
            if (!curved_[i]) {
                look_at_plane<first>(i);
            } else {
                look_at_quadric(i);
                // The tangent has 40 roundings of parts of the surface's size: less than eight errors, which are 256.
                const Tangent& tangent = tangents_[i];
                missed_ |= tangent.value + fall(tangent.gradient[0], 0) + fall(tangent.gradient[1], 1) +
                               fall(tangent.gradient[2], 2) >
                           8 * error + in_register(surfaces_[i].bend);
            }
            inside &= tangents_[i].value < -error;
        }
        entered_ |= inside;
        for (std::size_t i = 0; i < count_; ++i)
            for (std::size_t j = i + 1; j < count_; ++j)
                if (first || curved_[i] || curved_[j]) compare(i, j);
    }

    template <bool first>
    void look_at_plane(std::size_t i) {
        const Surfaces& s = surfaces_[i];
        Tangent& tangent = tangents_[i];
        if (first) tangent.gradient = {in_register(s.x), in_register(s.y), in_register(s.z)};
        tangent.value =
            multiply_add(point_[0], tangent.gradient[0],
                         multiply_add(point_[1], tangent.gradient[1],
                                      multiply_add(point_[2], tangent.gradient[2], in_register(s.low))));
    }
    void look_at_quadric(std::size_t i) {
        const Surfaces& s = surfaces_[i];
        const Floats x = point_[0], y = point_[1], z = point_[2], xx = in_register(s.xx),
                     yy = in_register(s.yy), zz = in_register(s.zz), xy = in_register(s.xy),
                     xz = in_register(s.xz), yz = in_register(s.yz);
        const Floats along_x =
                         multiply_add(x, xx, multiply_add(y, xy, multiply_add(z, xz, in_register(s.x)))),
                     along_y = multiply_add(y, yy, multiply_add(z, yz, in_register(s.y))),
                     along_z = multiply_add(z, zz, in_register(s.z));
        tangents_[i] = {
            multiply_add(x, along_x, multiply_add(y, along_y, multiply_add(z, along_z, in_register(s.low)))),
            {multiply_add(x, xx, along_x), multiply_add(y, yy, multiply_add(x, xy, along_y)),
             multiply_add(z, zz, multiply_add(x, xz, multiply_add(y, yz, along_z)))}};
    }

    /// What a component of a gradient adds to a linear function at the point on the way to where it is least in the
    /// cell.
    Floats fall(Floats component, std::size_t axis) const {
        const Floats down = low_[axis] - point_[axis];
        return smaller(component * down, component * (down + 1));
    }

    /// Whether a weighted sum of two tangents is positive in all of the cell.
    void compare(std::size_t i, std::size_t j) {
        const Tangent &first = tangents_[i], &second = tangents_[j];
        const Floats first_room = 16 * in_register(surfaces_[i].error) + in_register(surfaces_[i].bend),
                     second_room = 16 * in_register(surfaces_[j].error) + in_register(surfaces_[j].bend);
        for (std::size_t a = 0; a < 3; ++a) {
            const Floats f = first.gradient[a], g = second.gradient[a], p = absolute(g), q = absolute(f);
            const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
            const auto sum = [&](Floats of_first, Floats of_second) {
                return multiply_add(p, of_first, q * of_second);
            };
            const Floats least = sum(first.value, second.value) +
                                 fall(sum(first.gradient[b], second.gradient[b]), b) +
                                 fall(sum(first.gradient[c], second.gradient[c]), c);
            // Infinite where a product overflows, which proves nothing.
            missed_ |= (f * g < 0) & (least > sum(first_room, second_room)) & (least < 0x1p120F);
        }
    }

    /// Moves the point on to the insides of all surfaces that it is outside of.
    void move(float aim) {
        Point step{};
        for (std::size_t i = 0; i < count_; ++i) {
            const Tangent& tangent = tangents_[i];
            Floats square{};
            for (std::size_t a = 0; a < 3; ++a) {
                // A point on a side of the cell slides along it.
                const Floats g = tangent.gradient[a];
                const Flags free = g > 0 ? point_[a] > low_[a] : point_[a] < low_[a] + 1;
                square += free ? g * g : Floats{};
            }
            const Floats excess = larger(tangent.value + aim * in_register(surfaces_[i].slope), Floats{});
            const Floats factor = excess / larger(square, Floats{} + 0x1p-100F);
            for (std::size_t a = 0; a < 3; ++a) step[a] += factor * tangent.gradient[a];
        }
        for (std::size_t a = 0; a < 3; ++a)
            point_[a] = smaller(larger(point_[a] - step[a], low_[a]), low_[a] + 1);
    }

    const Surfaces* surfaces_;
    const bool* curved_;
    std::size_t count_;
    Point low_, point_;
    std::array<Tangent, most_at_once> tangents_;
    Flags entered_{}, missed_{};
};

/// Room for so many surfaces a lane; those of lanes that have fewer say nothing.
void BodiesInCells::make_room(std::size_t surfaces) {
    for (; used_ < surfaces; ++used_) {
        surfaces_[used_] = {};
        surfaces_[used_].low.fill(-1);
        curved_[used_] = false;
    }
}

void BodiesInCells::ask(std::span<const BrickSurface> surfaces, const Layers* matters, BrickCell cell,
                        BodyInCells& answer) {
    const std::size_t lane = count_++;
    questions_[lane] = {cell, &answer, true};
    low_[0][lane] = static_cast<float>(cell.x);
    low_[1][lane] = static_cast<float>(cell.y);
    low_[2][lane] = static_cast<float>(cell.z);
    std::size_t count = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (!cell.in(matters[i])) continue;
        if (count == most_at_once) {
            questions_[lane].complete = false;
            break;
        }
        const BrickSurface& s = surfaces[i];
        make_room(count + 1);
        Surfaces& to = surfaces_[count];
        to.low[lane] = s.low, to.x[lane] = s.x, to.y[lane] = s.y, to.z[lane] = s.z;
        to.error[lane] = s.error, to.slope[lane] = s.slope;
        if (s.curved) {
            curved_[count] = true;
            to.xx[lane] = s.xx, to.yy[lane] = s.yy, to.zz[lane] = s.zz;
            to.xy[lane] = s.xy, to.xz[lane] = s.xz, to.yz[lane] = s.yz;
            to.bend[lane] = s.bend;
        }
        ++count;
    }
    if (count_ == lanes) finish();
}

void BodiesInCells::finish() {
    if (count_ == 0) return;
    make_room(1);
    Walk walk(*this);
    walk.run();
    for (std::size_t lane = 0; lane < count_; ++lane) {
        const Question& question = questions_[lane];
        if (walk.missed()[lane]) question.cell.add_to(question.answer->missed);
        if (question.complete && walk.entered()[lane]) question.cell.add_to(question.answer->entered);
    }
    count_ = used_ = 0;
}

}  // namespace octavo::csg
