// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <octavo/csg/convex_piece.hpp>

namespace octavo::csg {

ConvexPiece ConvexPiece::box(const Box3& box) {
    ConvexPiece piece;
    for (int corner = 0; corner < 8; ++corner)
        piece.corners.push_back({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                                 corner & 4 ? box.high.z : box.low.z});
    piece.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return piece;
}

Vec3 ConvexPiece::middle() const {
    Vec3 sum;
    for (const Vec3& corner : corners) sum = sum + corner;
    return (1 / static_cast<double>(corners.size())) * sum;
}

namespace {

/// The face that closes a cut: corners on the plane, in order around their middle.
std::vector<std::uint32_t> cap_of(const std::vector<Vec3>& corners, std::vector<std::uint32_t> on_plane,
                                  Vec3 normal) {
    Vec3 middle;
    for (const std::uint32_t corner : on_plane)
        middle = middle + (1 / static_cast<double>(on_plane.size())) * corners[corner];
    const Vec3 axis = std::fabs(normal.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 u = cross(axis, normal), v = cross(normal, u);
    const auto angle = [&](std::uint32_t corner) {
        const Vec3 d = corners[corner] - middle;
        return std::atan2(dot(v, d), dot(u, d));
    };
    std::sort(on_plane.begin(), on_plane.end(),
              [&](std::uint32_t a, std::uint32_t b) { return angle(a) < angle(b); });
    return on_plane;
}

}  // namespace

ConvexPiece below(const ConvexPiece& piece, const Cut& cut, double tolerance) {
    std::vector<double> height(piece.corners.size());
    bool any_above = false, any_below = false;
    for (std::size_t i = 0; i < height.size(); ++i) {
        height[i] = cut.height(piece.corners[i]);
        if (std::fabs(height[i]) <= tolerance) height[i] = 0;
        any_above |= height[i] > 0;
        any_below |= height[i] < 0;
    }
    if (!any_above) return any_below ? piece : ConvexPiece{};
    if (!any_below) return {};

    ConvexPiece kept;
    constexpr auto none = ~std::uint32_t{0};
    std::vector<std::uint32_t> index(height.size(), none);
    std::vector<std::uint32_t> on_plane;
    const auto keep = [&](std::uint32_t corner) {
        if (index[corner] == none) {
            index[corner] = static_cast<std::uint32_t>(kept.corners.size());
            kept.corners.push_back(piece.corners[corner]);
            if (height[corner] == 0) on_plane.push_back(index[corner]);
        }
        return index[corner];
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> crossings;
    const auto cross_edge = [&](std::uint32_t a, std::uint32_t b) {
        if (a > b) std::swap(a, b);
        const auto [place, fresh] =
            crossings.try_emplace({a, b}, static_cast<std::uint32_t>(kept.corners.size()));
        if (fresh) {
            const double t = height[a] / (height[a] - height[b]);
            kept.corners.push_back(piece.corners[a] + t * (piece.corners[b] - piece.corners[a]));
            on_plane.push_back(place->second);
        }
        return place->second;
    };
    for (const std::vector<std::uint32_t>& face : piece.faces) {
        std::vector<std::uint32_t> part;
        bool inside = false;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
            if (height[a] <= 0) part.push_back(keep(a));
            inside |= height[a] < 0;
            if (height[a] * height[b] < 0) part.push_back(cross_edge(a, b));
        }
        if (inside && part.size() >= 3) kept.faces.push_back(std::move(part));
    }
    if (on_plane.size() >= 3) kept.faces.push_back(cap_of(kept.corners, std::move(on_plane), cut.normal));
    return kept;
}

}  // namespace octavo::csg
