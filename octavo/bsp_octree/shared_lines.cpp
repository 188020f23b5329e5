// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/bsp_octree/shared_lines.hpp>

namespace octavo::bsp_octree {
namespace {

/// Sums below hold a few products of numbers that were rounded once or twice: they are off by less than 2^-48 of the
/// sum of the products' sizes.
constexpr double slack = 0x1p-48;

Vec3 size_of(const Vec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// The cross product with sums instead of differences.
Vec3 cross_of_sizes(const Vec3& a, const Vec3& b) {
    return {a.y * b.z + a.z * b.y, a.z * b.x + a.x * b.z, a.x * b.y + a.y * b.x};
}

Vec3 normal_of(const exact::Plane& plane) {
    return {static_cast<double>(plane.a()), static_cast<double>(plane.b()), static_cast<double>(plane.c())};
}

/// Whether the line in which a plane meets a wall, and a point of which is given, may lie in another wall: it is
/// parallel to an axis, and in the last coordinate it lies between lattice points.
bool may_lie_in_two_walls(const Vec3& normal, int wall_axis, const Vec3& point) {
    for (int along = 0; along < 3; ++along) {
        if (along == wall_axis || normal[along] != 0) continue;
        const double twice = 2 * point[3 - wall_axis - along], nearest = std::nearbyint(twice);
        if (std::fabs(twice - nearest) < 0x1p-20 && std::fmod(nearest, 2) != 0) return true;
    }
    return false;
}

}  // namespace

void SharedLines::begin(const bsp::PlaneTable& planes, std::span<const bsp::Fragment> fragments) {
    table_ = &planes;
    ids_.clear(), planes_.clear();
    for (const bsp::Fragment& fragment : fragments) ids_.push_back(fragment.facing.plane());
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    if (ids_.size() > most_planes) return;
    for (const bsp::PlaneId id : ids_)
        planes_.push_back({id, normal_of(planes[id]), planes[id].d_approximation()});
}

bool SharedLines::may_be_shared(bsp::PlaneId plane, bsp::Bound bound, const Vec3& start) const {
    if (ids_.size() > most_planes) return true;
    const Vec3 first = normal_of((*table_)[plane]);
    Vec3 second;
    if (bound.is_wall()) {
        if (may_lie_in_two_walls(first, bound.axis(), start)) return true;
        second[bound.axis()] = 1;
    } else {
        second = normal_of((*table_)[bound.plane_id()]);
    }
    const Vec3 along = cross(first, second), along_size = cross_of_sizes(size_of(first), size_of(second));
    return std::any_of(planes_.begin(), planes_.end(), [&](const Approximate& other) {
        if (other.id == plane || (bound.is_plane() && other.id == bound.plane_id())) return false;
        const Vec3 size = size_of(other.normal);
        if (std::fabs(dot(along, other.normal)) > slack * dot(along_size, size)) return false;
        return std::fabs(dot(start, other.normal) + other.d) <=
               slack * (dot(size_of(start), size) + std::fabs(other.d));
    });
}

}  // namespace octavo::bsp_octree
