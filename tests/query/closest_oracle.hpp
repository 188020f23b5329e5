// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <octavo/query/triangle_distance.hpp>

#include "unlimited.hpp"

// The oracle of distances: all triangles of a mesh, each measured in whole numbers by another road than the
// code under test, as the least of three segments and of the plane where the foot lies in the triangle.
//
// So that a hundred thousand points end in minutes, triangles are passed over whose bounding sphere is farther than
// the whole sphere of another one, by more than doubles could ever err: that changes no answer.

namespace octavo::tests {

class ClosestOracle {
  public:
    using WholePoint = std::array<Integer, 3>;

    /// A squared distance, times 4^shift of the point.
    struct Square {
        Integer numerator, denominator = 1;
        bool operator<(const Square& other) const {
            return numerator * other.denominator < other.numerator * denominator;
        }
    };
    struct Answer {
        mesh::FaceIndex face = 0;  ///< the lowest of equally near ones
        double distance = 0;       ///< lattice units, rounded
    };

    explicit ClosestOracle(const mesh::LatticeMesh& mesh) : mesh_(mesh) {
        for (const mesh::Triangle& t : mesh.triangles) {
            Sphere sphere;
            for (int axis = 0; axis < 3; ++axis) {
                const auto [low, high] =
                    std::minmax({mesh.points[t[0]][axis], mesh.points[t[1]][axis], mesh.points[t[2]][axis]});
                sphere.centre[axis] = 0.5 * low + 0.5 * high;
                sphere.radius += 0.25 * (static_cast<double>(high) - low) * (static_cast<double>(high) - low);
            }
            sphere.radius = std::sqrt(sphere.radius);
            spheres_.push_back(sphere);
        }
    }

    Answer operator()(const query::FixedPoint& q) const {
        const Vec3 place = q.approximation();
        // Doubles err by 2^-50 of these coordinates at most.
        const double slack =
            0x1p-44 * (std::fabs(place.x) + std::fabs(place.y) + std::fabs(place.z) + 0x1p28);
        double least = length(spheres_[0].centre - place) + spheres_[0].radius;
        std::vector<std::pair<double, mesh::FaceIndex>> near;
        for (mesh::FaceIndex face = 0; face < spheres_.size(); ++face) {
            const double centre = length(spheres_[face].centre - place), radius = spheres_[face].radius;
            if (centre - radius > least + slack) continue;
            least = std::min(least, centre + radius);
            near.emplace_back(centre - radius, face);
        }
        std::sort(near.begin(), near.end());

        const double one = std::ldexp(1.0, q.shift);
        Square best = square_to(q, near[0].second);
        Answer answer{near[0].second, root_of(best) / one};
        for (const auto& [at_least, face] : near) {
            if (at_least > answer.distance + slack) break;
            if (face == answer.face) continue;
            const Square square = square_to(q, face);
            if (best < square || (face > answer.face && !(square < best))) continue;
            best = square;
            answer = {face, root_of(best) / one};
        }
        return answer;
    }

  private:
    struct Sphere {
        Vec3 centre;
        double radius = 0;
    };

    static WholePoint minus(const WholePoint& a, const WholePoint& b) {
        return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    }
    static Integer dot(const WholePoint& a, const WholePoint& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    static WholePoint cross(const WholePoint& a, const WholePoint& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static double root_of(const Square& square) {
        return std::sqrt(static_cast<double>(square.numerator) / static_cast<double>(square.denominator));
    }

    static Square to_segment(const WholePoint& q, const WholePoint& a, const WholePoint& b) {
        const WholePoint edge = minus(b, a), w = minus(q, a), beyond = minus(q, b);
        const Integer along = dot(edge, w), edge_square = dot(edge, edge);
        if (along <= 0) return {dot(w, w), 1};
        if (along >= edge_square) return {dot(beyond, beyond), 1};
        return {dot(w, w) * edge_square - along * along, edge_square};
    }

    Square square_to(const query::FixedPoint& q, mesh::FaceIndex face) const {
        const auto corner = [&](std::size_t i) {
            const exact::Point p = mesh_.points[mesh_.triangles[face][i]];
            return WholePoint{Integer(p.x) << q.shift, Integer(p.y) << q.shift, Integer(p.z) << q.shift};
        };
        const WholePoint a = corner(0), b = corner(1), c = corner(2), p{q.x[0], q.x[1], q.x[2]};
        Square least = std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
        const WholePoint n = cross(minus(b, a), minus(c, a));
        const Integer n_square = dot(n, n);
        if (n_square == 0) return least;
        if (dot(n, cross(minus(b, a), minus(p, a))) >= 0 && dot(n, cross(minus(c, b), minus(p, b))) >= 0 &&
            dot(n, cross(minus(a, c), minus(p, c))) >= 0) {
            const Integer height = dot(n, minus(p, a));
            least = std::min(least, Square{height * height, n_square});
        }
        return least;
    }

    const mesh::LatticeMesh& mesh_;
    std::vector<Sphere> spheres_;
};

}  // namespace octavo::tests
