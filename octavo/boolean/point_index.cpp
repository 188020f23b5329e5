// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include <octavo/boolean/point_index.hpp>
#include <octavo/boolean/soup.hpp>
#include <octavo/boolean/weld.hpp>

namespace octavo::boolean {

std::uint32_t PointIndex::find(exact::Point point, std::span<const exact::Point> points) const {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t slot = hash(point) & mask; slots_[slot] != no_index; slot = (slot + 1) & mask)
        if (points[slots_[slot]] == point) return slots_[slot];
    return no_index;
}

void PointIndex::prepare(std::span<const exact::Point> points) {
    if (!slots_.empty()) return;
    slots_.assign(std::bit_ceil(2 * points.size() + 1), no_index);
    const std::size_t mask = slots_.size() - 1;
    for (std::uint32_t id = 0; id < points.size(); ++id) {
        std::size_t slot = hash(points[id]) & mask;
        while (slots_[slot] != no_index) slot = (slot + 1) & mask;
        slots_[slot] = id;
    }
}

}  // namespace octavo::boolean
