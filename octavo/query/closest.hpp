// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/query/closest_search.hpp>
#include <octavo/query/closest_tree.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/triangle_distance.hpp>

// Signed distance, nearest point, triangle and normal, exact and everywhere.
//
// A walk over boxes of eight (closest_search.hpp) finds the few triangles that floats cannot exclude; those are
// compared exactly (triangle_distance.hpp). The sign is that of InsideQuery: negative inside (winding number > 0).
//
// Exact means: for the lattice mesh and the point to 62 bits (FixedPoint), the triangle is a nearest one; the distance
// is its true distance rounded, to a few units in the last place of a double. The sign is that of the point itself, to
// the last bit; nearer to the surface than 2^-35 lattice units the distance may come out as 0.
//
// Batches sort their points by Morton key, and the distance of one bounds that of the next.

namespace octavo::query {

struct Closest {
    double distance =
        std::numeric_limits<double>::quiet_NaN();  ///< world units; negative inside, 0 on the surface
    Vec3 point;                                    ///< of the surface, world
    Vec3 normal;  ///< of the triangle, unit length; zero when it is degenerate
    mesh::FaceIndex triangle = no_triangle;
    Feature feature = Feature::vertex;  ///< what of the triangle is nearest
    static constexpr mesh::FaceIndex no_triangle = 0xffffffff;
};

struct ClosestOptions {
    /// Without a sign distances are positive everywhere, the mesh may be open, and half of the memory is saved.
    enum class Sign : std::uint8_t { inside_negative, none };
    Sign sign = Sign::inside_negative;
    /// The sign costs a fifth of the distance at most, so it may take a little longer for two thirds of the memory.
    /// Where OpenPolicy::winding closes an open surface, the sign is that of the closed solid; distances are to the
    /// facets of the mesh alone, and positive on what closes it.
    InsideOptions inside{.leaf_facets = 8};
};

class ClosestQuery {
  public:
    /// Errors: bad_input for a mesh without facets, and those of classic::check_places; those of InsideQuery when signs
    /// are wanted.
    static Result<ClosestQuery> build(const mesh::LatticeMesh& mesh, const ClosestOptions& options = {},
                                      const Context& context = {});
    static Result<ClosestQuery> build(const mesh::Mesh& mesh, const ClosestOptions& options = {},
                                      const Context& context = {});

    /// A point with a coordinate that is not a number has distance NaN, one with an infinite coordinate has distance
    /// infinity, and both have no triangle.
    Closest operator()(Vec3 point) const;

    /// The same for many points, in their order; parallel, and faster a point. Cancelled: the rest is NaN.
    std::vector<Closest> operator()(std::span<const Vec3> points, const Context& context = {}) const;

    std::size_t memory_bytes() const;

  private:
    ClosestQuery() = default;
    Closest answer(Vec3 world, const FixedPoint& q, const NearestTriangle& nearest, Side side) const;

    exact::Lattice lattice_;
    ClosestTree tree_;
    std::shared_ptr<const InsideQuery> inside_;
};

}  // namespace octavo::query
