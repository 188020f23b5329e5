// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <octavo/bsp/plane_table.hpp>

namespace octavo::bsp {
namespace {

/// The normal's first component that is not zero is negative.
bool looks_down(const exact::Plane& plane) {
    return plane.a() != 0 ? plane.a() < 0 : plane.b() != 0 ? plane.b() < 0 : plane.c() < 0;
}

std::uint64_t hash(const exact::Plane& plane) {
    const auto part = [](std::int64_t number, std::uint64_t factor) {
        return static_cast<std::uint64_t>(number) * factor;
    };
    const std::uint64_t mixed = part(plane.a(), 0x9E3779B97F4A7C15ull) ^
                                (part(plane.b(), 0xC2B2AE3D27D4EB4Full) >> 7) ^
                                part(plane.c(), 0x165667B19E3779F9ull) ^
                                (part(static_cast<std::int64_t>(plane.d()), 0xD6E8FEB86659FD93ull) >> 11);
    return (mixed * 0x9E3779B97F4A7C15ull) >> 20;
}

}  // namespace

Facing PlaneTable::add(exact::Point p, exact::Point q, exact::Point r) {
    exact::Plane plane = exact::primitive(exact::Plane::through(p, q, r));
    OCTAVO_CHECK(!plane.degenerate(), "three collinear points span no plane");
    const bool reversed = looks_down(plane);
    if (reversed) plane = plane.reversed();
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = hash(plane) & mask;
    for (; slots_[slot] != none; slot = (slot + 1) & mask)
        if (planes_[slots_[slot]] == plane) return Facing::of(slots_[slot], reversed);

    OCTAVO_CHECK(planes_.size() < most, "too many planes for one table");
    const auto id = static_cast<PlaneId>(planes_.size());
    slots_[slot] = id;
    planes_.push_back(plane);
    points_.push_back(reversed ? Points{p, r, q} : Points{p, q, r});
    if (2 * planes_.size() > slots_.size()) grow();
    return Facing::of(id, reversed);
}

void PlaneTable::grow() {
    slots_.assign(2 * slots_.size(), none);
    const std::size_t mask = slots_.size() - 1;
    for (PlaneId id = 0; id < planes_.size(); ++id) {
        std::size_t slot = hash(planes_[id]) & mask;
        while (slots_[slot] != none) slot = (slot + 1) & mask;
        slots_[slot] = id;
    }
}

}  // namespace octavo::bsp
