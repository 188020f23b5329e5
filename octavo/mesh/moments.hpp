// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include <octavo/base/vec3.hpp>

// Volume, area, centroid and inertia of the solid within facets that come one by one, in any order, on any threads.
//
// Each facet spans a signed tetrahedron with the centre of the bounds, whose polynomial moments are closed formulas;
// their sum over a closed, outward surface is the moment of the solid (B. Mirtich, "Fast and accurate computation of
// polyhedral mass properties", 1996, has the same sums by another road). The sums are reproducible (J. Demmel, H. D.
// Nguyen, "Fast reproducible floating-point summation", 2013): every term is cut into slices on fixed grids, so that
// adding is exact and neither the order of the facets, nor who added them, nor the corner that a facet starts from
// shows in the last digit. Cost: about 40 ns a facet.

namespace octavo::mesh {

struct Moments {
    double volume = 0;  ///< signed; positive when facets point outwards. Meaningless when the surface is open
    double area = 0;
    Vec3 centroid;  ///< of the volume; of the bounds when the volume is 0
    /// Inertia tensor about the centroid at density 1, row-major, symmetric.
    std::array<std::array<double, 3>, 3> inertia{};
};

class MomentSum {
  public:
    /// Of at most so many facets with corners in `bounds`, which are not empty.
    MomentSum(const Box3& bounds, std::size_t most_facets);

    void add(Vec3 a, Vec3 b, Vec3 c);
    /// What another sum of the same bounds and number has added, less than `most_facets` together.
    void add(const MomentSum& other);

    Moments moments() const;

  private:
    enum Term { six_volume, twice_area, m_x, m_y, m_z, m_xx, m_yy, m_zz, m_xy, m_yz, m_zx, term_count };
    using Terms = std::array<double, term_count>;
    static constexpr int slices = 3;

    static Terms terms_of(Vec3 a, Vec3 b, Vec3 c);
    double total(Term term) const { return (sums_[2][term] + sums_[1][term]) + sums_[0][term]; }

    Vec3 centre_;
    int exponent_;  ///< sums are about `centre_`, in units of 2^exponent
    double scale_;
    std::array<double, slices> shifts_{};
    std::array<Terms, slices> sums_{};
};

}  // namespace octavo::mesh
