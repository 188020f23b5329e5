// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/classic/moments.hpp>

namespace octavo::classic {
namespace {

using Wide = __int128;

constexpr int unit_bits = exact::coordinate_bits - octree::max_level - 1;  // of a half side of level 21
constexpr int side_bits = octree::max_level + 1;
static_assert(4 + 3 * side_bits + 2 * side_bits < 127, "twelve second moments of the universe fit");

struct Sums {
    Wide volume = 0;
    std::array<Wide, 3> first{};
    std::array<std::array<Wide, 3>, 3> second{};  // times 12; only i <= j

    void add(octree::CellKey key) {
        const std::int64_t side = key.side() >> unit_bits;
        const exact::Point low = key.low();
        std::array<std::int64_t, 3> middle;
        for (int axis = 0; axis < 3; ++axis)
            middle[static_cast<std::size_t>(axis)] = (low[axis] >> unit_bits) + side / 2;
        const Wide cube = Wide{side} * side * side;
        volume += cube;
        for (std::size_t i = 0; i < 3; ++i) {
            first[i] += cube * middle[i];
            for (std::size_t j = i; j < 3; ++j)
                second[i][j] += cube * (12 * Wide{middle[i]} * middle[j] + (i == j ? Wide{side} * side : 0));
        }
    }
};

}  // namespace

Moments moments(const octree::Octree& octree, CountedLeaves counted) {
    Sums sums;
    octree.for_each_leaf([&](octree::CellKey key, octree::Color color) {
        if (color == octree::Color::black ||
            (color == octree::Color::gray && counted == CountedLeaves::black_and_gray))
            sums.add(key);
    });
    Moments result;
    if (sums.volume == 0) return result;
    const double unit = std::ldexp(octree.lattice().unit(), unit_bits);
    const auto volume = static_cast<long double>(sums.volume);
    result.volume = static_cast<double>(volume) * unit * unit * unit;
    std::array<long double, 3> middle;
    for (std::size_t i = 0; i < 3; ++i) {
        middle[i] = static_cast<long double>(sums.first[i]) / volume;
        // The lattice's origin is a whole number of its units.
        const long double origin =
            std::ldexp(static_cast<long double>(octree.lattice().origin()[i]), -unit_bits);
        result.centroid[static_cast<int>(i)] = static_cast<double>((origin + middle[i]) * unit);
    }
    std::array<std::array<double, 3>, 3> central{};
    const double scale = result.volume * unit * unit;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i; j < 3; ++j) {
            const long double mean = static_cast<long double>(sums.second[i][j]) / (12 * volume);
            central[i][j] = central[j][i] = static_cast<double>(mean - middle[i] * middle[j]) * scale;
        }
    const double trace = central[0][0] + central[1][1] + central[2][2];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result.inertia[i][j] = (i == j ? trace : 0) - central[i][j];
    return result;
}

}  // namespace octavo::classic
