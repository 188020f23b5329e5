// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>

#include <octavo/io/facet_regions.hpp>
#include <octavo/mesh/area_vector.hpp>
#include <octavo/mesh/collinear.hpp>

namespace octavo::io {
namespace {

using mesh::area_vector;
using mesh::orient2d;
using mesh::Point2;

/// Twice the signed area of a triangle, rounded.
double area_of(Point2 a, Point2 b, Point2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

}  // namespace

FacetRegions::Taken FacetRegions::take(std::span<const Vec3> vertices, const Contours& contours,
                                       std::span<const Vec3> hole_points, FaceList& faces) {
    deviation_ = 0;
    const bool single = contours.size() == 1 && hole_points.empty();
    if (single && contours[0].size() == 3) {
        faces.add(contours[0]);
        return {1, {}};
    }
    if (!project(vertices, contours, hole_points)) return {0, Trouble{"has no area"}};
    for (Region& region : regions_)
        if (!measure(region) || (!single && !find_inside(region)))
            return {0, Trouble{"has a contour without area"}};
    for (Region& region : regions_)
        if (&region != regions_.data()) region.reversed = region.reversed != regions_[0].reversed;
    regions_[0].reversed = false;
    if (!single) {
        if (std::optional<Trouble> trouble = nest()) return {0, std::move(trouble)};
        if (std::optional<Trouble> trouble = open_holes(hole_points.size())) return {0, std::move(trouble)};
    }
    FaceList found;
    for (std::size_t region = 0; region < regions_.size(); ++region) {
        if (regions_[region].is_hole) continue;
        if (std::optional<Trouble> trouble = add_face(vertices, contours, region, found))
            return {0, std::move(trouble)};
    }
    for (std::size_t face = 0; face < found.size(); ++face) {
        contour_begin_.clear();
        for (std::size_t c = 0; c <= found.contours(face); ++c)
            contour_begin_.push_back(static_cast<std::uint32_t>(found.corners_before(face, c)));
        faces.add_with_holes(found.corners(face), contour_begin_);
    }
    return {found.size(), {}};
}

/// Projects everything, scaled so that orient2d is exact; false when all contours are without area.
bool FacetRegions::project(std::span<const Vec3> vertices, const Contours& contours,
                           std::span<const Vec3> hole_points) {
    positions_.clear(), regions_.clear();
    for (const std::vector<mesh::VertexIndex>& contour : contours) {
        regions_.emplace_back().begin = positions_.size();
        for (const mesh::VertexIndex corner : contour) positions_.push_back(vertices[corner]);
        regions_.back().end = positions_.size();
    }
    const std::size_t corners = positions_.size();
    positions_.insert(positions_.end(), hole_points.begin(), hole_points.end());
    const double before = std::accumulate(positions_.begin(), positions_.end(), 0.0, [](double sum, Vec3 p) {
        return std::max({sum, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    });
    if (!mesh::scale_for_orient2d(positions_)) return false;
    const double after = std::accumulate(positions_.begin(), positions_.end(), 0.0, [](double sum, Vec3 p) {
        return std::max({sum, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    });

    Vec3 normal;
    for (const Region& region : regions_) {
        const Vec3 other =
            area_vector(std::span(positions_).subspan(region.begin, region.end - region.begin));
        if (dot(other, other) > dot(normal, normal)) normal = other;
    }
    const double size = length(normal);
    if (!(size > 0)) return false;
    for (std::size_t i = 0; i < corners; ++i)
        deviation_ = std::max(deviation_, std::fabs(dot((1 / size) * normal, positions_[i] - positions_[0])));
    if (after > 0) deviation_ *= before / after;

    int axis = 0;
    for (int other = 1; other < 3; ++other)
        if (std::fabs(normal[other]) > std::fabs(normal[axis])) axis = other;
    points_.clear();
    for (const Vec3& p : positions_) points_.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    return true;
}

/// Box, area and direction of a contour; false when it has no area.
bool FacetRegions::measure(Region& region) {
    const std::span<const Point2> ring =
        std::span<const Point2>(points_).subspan(region.begin, region.end - region.begin);
    region.low = region.high = ring[0];
    std::size_t first = 0;
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point2 p = ring[i];
        region.low = {std::min(region.low.x, p.x), std::min(region.low.y, p.y)};
        region.high = {std::max(region.high.x, p.x), std::max(region.high.y, p.y)};
        if (p.x < ring[first].x || (p.x == ring[first].x && p.y < ring[first].y)) first = i;
        area += area_of(ring[0], p, ring[(i + 1) % ring.size()]);
    }
    region.area = std::fabs(area);
    // At its lowest corner a contour that does not cross itself is convex, or straight where it touches itself.
    const std::size_t count = ring.size();
    std::size_t before = 1, after = 1;
    while (before < count && ring[(first + count - before) % count] == ring[first]) ++before;
    while (after < count && ring[(first + after) % count] == ring[first]) ++after;
    if (before == count || after == count) return false;
    const int turn =
        orient2d(ring[(first + count - before) % count], ring[first], ring[(first + after) % count]);
    region.reversed = turn != 0 ? turn < 0 : area < 0;
    return area != 0;
}

/// A point inside the contour: the middle of its largest triangle.
bool FacetRegions::find_inside(Region& region) {
    std::vector<Vec3> flat;
    for (std::size_t i = region.begin; i < region.end; ++i) flat.push_back({points_[i].x, points_[i].y, 0});
    corners_.resize(flat.size());
    std::iota(corners_.begin(), corners_.end(), mesh::VertexIndex{0});
    double largest = 0;
    for (const mesh::Triangle& t : triangulator_(flat, corners_).triangles) {
        const Point2 a{flat[t[0]].x, flat[t[0]].y}, b{flat[t[1]].x, flat[t[1]].y},
            c{flat[t[2]].x, flat[t[2]].y};
        const double area = std::fabs(area_of(a, b, c));
        if (area <= largest) continue;
        largest = area;
        region.inside = {a.x + ((b.x - a.x) + (c.x - a.x)) / 3, a.y + ((b.y - a.y) + (c.y - a.y)) / 3};
    }
    return largest > 0;
}

int FacetRegions::place(Point2 p, const Region& region) const {
    if (p.x < region.low.x || p.y < region.low.y || p.x > region.high.x || p.y > region.high.y) return -1;
    bool inside = false;
    for (std::size_t i = region.begin; i < region.end; ++i) {
        const Point2 a = points_[i], b = points_[i + 1 == region.end ? region.begin : i + 1];
        const bool upward = a.y <= p.y && p.y < b.y, downward = b.y <= p.y && p.y < a.y;
        const bool near = std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
                          std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
        if (!upward && !downward && !near) continue;
        const int side = orient2d(a, b, p);
        if (side == 0 && near) return 0;
        if ((upward && side > 0) || (downward && side < 0)) inside = !inside;
    }
    return inside ? 1 : -1;
}

/// Contours that do not cross lie in one another or apart, so a point inside the smaller one tells.
std::optional<FacetRegions::Trouble> FacetRegions::nest() {
    for (std::size_t inner = 0; inner < regions_.size(); ++inner)
        for (std::size_t outer = 0; outer < regions_.size(); ++outer) {
            Region& region = regions_[inner];
            const Region& other = regions_[outer];
            if (inner == outer || other.area < region.area || place(region.inside, other) <= 0) continue;
            if (other.area == region.area)
                return Trouble{"has contours " + std::to_string(std::min(inner, outer) + 1) + " and " +
                               std::to_string(std::max(inner, outer) + 1) + " that cover each other"};
            if (region.around == Region::none || regions_[region.around].area > other.area)
                region.around = outer;
        }
    return {};
}

std::optional<FacetRegions::Trouble> FacetRegions::open_holes(std::size_t hole_points) {
    const std::size_t first = points_.size() - hole_points;
    for (std::size_t hole = 0; hole < hole_points; ++hole) {
        std::size_t smallest = Region::none;
        for (std::size_t i = 0; i < regions_.size(); ++i) {
            const int place_here = place(points_[first + hole], regions_[i]);
            if (place_here == 0) return Trouble{"has a hole point on a contour", hole};
            if (place_here > 0 && (smallest == Region::none || regions_[i].area < regions_[smallest].area))
                smallest = i;
        }
        if (smallest == Region::none) return Trouble{"has a hole point in none of its contours", hole};
        regions_[smallest].is_hole = true;
    }
    if (std::all_of(regions_.begin(), regions_.end(), [](const Region& region) { return region.is_hole; }))
        return Trouble{"is all holes"};
    return {};
}

std::optional<FacetRegions::Trouble> FacetRegions::add_face(std::span<const Vec3> vertices,
                                                            const Contours& contours, std::size_t region,
                                                            FaceList& faces) {
    corners_.clear();
    contour_begin_.assign(1, 0);
    const auto add = [&](std::size_t contour, bool reversed) {
        const std::vector<mesh::VertexIndex>& ring = contours[contour];
        if (reversed)
            corners_.insert(corners_.end(), ring.rbegin(), ring.rend());
        else
            corners_.insert(corners_.end(), ring.begin(), ring.end());
        contour_begin_.push_back(static_cast<std::uint32_t>(corners_.size()));
    };
    add(region, regions_[region].reversed);
    for (std::size_t hole = 0; hole < regions_.size(); ++hole)
        if (regions_[hole].around == region) add(hole, !regions_[hole].reversed);
    if (triangulator_(vertices, corners_, contour_begin_).shape == mesh::PolygonShape::crossing)
        return Trouble{contours.size() == 1 ? "crosses itself" : "has contours that cross"};
    faces.add_with_holes(corners_, contour_begin_);
    return {};
}

}  // namespace octavo::io
