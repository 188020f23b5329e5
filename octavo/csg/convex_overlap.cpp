// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <octavo/csg/convex_overlap.hpp>

namespace octavo::csg {
namespace {

using Wide = __int128;

// Rounds of tangent planes before giving up: a round nearly doubles the digits that are right; cells that took
// more than ten were never seen to be decided later.
constexpr int most_rounds = 14;
constexpr int most_pivots = 80;
constexpr std::size_t box_faces = 7;
constexpr std::size_t capacity = most_constraints + box_faces + 4 * most_rounds;

/// normal · y + offset >= 0 in the cell's own coordinates y in [0, 1]³, the normal of length one.
struct Constraint {
    std::array<double, 3> normal;
    double offset;
    double scale;  // what the integer plane was divided by; 0 for faces of the cell, -1 for tangents
};

/// maximise t subject to normal · y + offset >= t for all constraints, by the simplex method on the dual: four
/// constraints with weights >= 0 that sum to one and whose normals cancel. The seven faces give a start.
class DeepestPoint {
  public:
    DeepestPoint() {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Constraint low{{0, 0, 0}, 0, 0}, high{{0, 0, 0}, 1, 0};
            low.normal[axis] = 1;
            high.normal[axis] = -1;
            add(low);
            add(high);
        }
        const double third = 1 / std::sqrt(3.0);
        add({{-third, -third, -third}, 3 * third, 0});  // around the cell; it makes the first basis
    }

    void add(const Constraint& constraint) { constraints_[count_++] = constraint; }
    bool full() const { return count_ == capacity; }
    std::size_t count() const { return count_; }
    const Constraint& constraint(std::size_t index) const { return constraints_[index]; }

    /// False when it ran out of pivots. Afterwards point, depth and weights are those of the optimum.
    bool solve() {
        for (int pivot = 0; pivot < most_pivots; ++pivot) {
            multiply();
            // The weights bound the depth from above: once that is negative, they tell why.
            if (dual_[3] < -1e-6) return true;
            const std::size_t entering = price(pivot > most_pivots / 2);
            if (entering == capacity) return true;
            if (!exchange(entering)) return false;
        }
        return false;
    }

    std::array<double, 3> point() const { return {-dual_[0], -dual_[1], -dual_[2]}; }
    double depth() const { return dual_[3]; }
    const std::array<std::size_t, 4>& basis() const { return basis_; }
    double weight(std::size_t i) const { return weights_[i]; }

  private:
    /// The weights of the basis and the multipliers of the four equations.
    void multiply() {
        for (std::size_t i = 0; i < 4; ++i) weights_[i] = std::max(0.0, inverse_[i][3]);
        for (std::size_t c = 0; c < 4; ++c) {
            dual_[c] = 0;
            for (std::size_t i = 0; i < 4; ++i) dual_[c] += constraints_[basis_[i]].offset * inverse_[i][c];
        }
    }

    /// The constraint that the present point violates most (the first violated one late, against cycles).
    std::size_t price(bool first) const {
        std::size_t best = capacity;
        double least = -1e-13;
        for (std::size_t k = 0; k < count_; ++k) {
            const Constraint& c = constraints_[k];
            const double slack = c.offset - c.normal[0] * dual_[0] - c.normal[1] * dual_[1] -
                                 c.normal[2] * dual_[2] - dual_[3];
            if (slack < least) {
                least = slack;
                best = k;
                if (first) break;
            }
        }
        return best;
    }

    bool exchange(std::size_t entering) {
        std::array<double, 4> step;
        std::size_t leaving = 4;
        double ratio = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            step[i] = inverse_[i][3];
            for (std::size_t r = 0; r < 3; ++r) step[i] += inverse_[i][r] * constraints_[entering].normal[r];
            if (step[i] <= 1e-12) continue;
            const double candidate = weights_[i] / step[i];
            if (leaving == 4 || candidate < ratio || (candidate == ratio && basis_[i] < basis_[leaving])) {
                leaving = i;
                ratio = candidate;
            }
        }
        if (leaving == 4) return false;
        basis_[leaving] = entering;
        const double pivot = 1 / step[leaving];
        for (double& v : inverse_[leaving]) v *= pivot;
        for (std::size_t i = 0; i < 4; ++i) {
            if (i == leaving) continue;
            for (std::size_t c = 0; c < 4; ++c) inverse_[i][c] -= step[i] * inverse_[leaving][c];
        }
        return true;
    }

    // The three low faces and the seventh: columns (e₁, 1), (e₂, 1), (e₃, 1) and (−(1, 1, 1)/√3, 1).
    static constexpr double last_ = 0.36602540378443865;   // 1 / (1 + √3)
    static constexpr double third_ = 0.21132486540518713;  // 1 / (3 + √3)
    std::array<Constraint, capacity> constraints_;
    std::size_t count_ = 0;
    std::array<std::size_t, 4> basis_{0, 2, 4, 6};
    std::array<std::array<double, 4>, 4> inverse_{{{1 - third_, -third_, -third_, third_},
                                                   {-third_, 1 - third_, -third_, third_},
                                                   {-third_, -third_, 1 - third_, third_},
                                                   {-last_, -last_, -last_, last_}}};
    std::array<double, 4> weights_{}, dual_{};
};

class Question {
  public:
    Question(const octree::Cell& cell, std::span<const LatticePlane> planes,
             std::span<const SecondOrderCone* const> cones)
        : cell_(cell), planes_(planes), cones_(cones), side_(cell.side()) {
        complete_ = planes.size() + cones.size() <= most_constraints;
        if (planes.size() > most_constraints) planes_ = planes.first(most_constraints);
        for (const LatticePlane& plane : planes_) add_plane(plane);
    }

    Overlap answer() {
        for (int round = 0; round <= most_rounds; ++round) {
            if (!deepest_.solve()) return Overlap::unsure;
            if (deepest_.depth() < 1e-9 && is_apart()) return Overlap::apart;
            if (deepest_.depth() <= 0) return Overlap::unsure;
            const std::array<double, 3> y = deepest_.point();
            bool all_inside = true;
            for (const SecondOrderCone* cone : cones_)
                if (!is_inside(*cone, y)) {
                    all_inside = false;
                    if (deepest_.full()) return Overlap::unsure;
                    add_tangent(*cone, y);
                }
            if (all_inside) return complete_ && planes_hold(y) ? Overlap::meets : Overlap::unsure;
        }
        return Overlap::unsure;
    }

  private:
    void add_plane(const LatticePlane& plane) {
        Constraint c{};
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            c.normal[axis] = static_cast<double>(plane.normal[axis]) * side_;
            square += c.normal[axis] * c.normal[axis];
        }
        c.scale = std::sqrt(square);
        for (double& component : c.normal) component /= c.scale;
        c.offset = static_cast<double>(plane.at(cell_.low.x, cell_.low.y, cell_.low.z)) / c.scale;
        deepest_.add(c);
    }

    std::array<double, 3> from_origin(const SecondOrderCone& cone, const std::array<double, 3>& y) const {
        std::array<double, 3> d;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            d[a] = (static_cast<double>(cell_.low[axis]) - cone.origin[a]) + y[a] * side_;
        }
        return d;
    }
    /// Bounds rounding anywhere in the cell, that of the point's own coordinates included.
    double cone_error(const SecondOrderCone& cone) const {
        double distance = 0;
        for (int axis = 0; axis < 3; ++axis)
            distance = std::max(distance, std::fabs(static_cast<double>(cell_.low[axis]) -
                                                    cone.origin[static_cast<std::size_t>(axis)]));
        return 2 * cone.error(distance + side_);
    }

    bool is_inside(const SecondOrderCone& cone, const std::array<double, 3>& y) const {
        const std::array<double, 3> d = from_origin(cone, y);
        return cone.excess(d[0], d[1], d[2]) < -cone_error(cone);
    }

    /// f(p) + g · (x − p) <= f(x) <= 0 inside, loosened by what rounding can do.
    void add_tangent(const SecondOrderCone& cone, const std::array<double, 3>& y) {
        const std::array<double, 3> d = from_origin(cone, y);
        const Vec3 g = cone.gradient(d[0], d[1], d[2]);
        Constraint c{};
        double square = 0, at_point = -cone.excess(d[0], d[1], d[2]) + 4 * cone_error(cone);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            c.normal[axis] = -g[static_cast<int>(axis)] * side_;
            square += c.normal[axis] * c.normal[axis];
            at_point -= c.normal[axis] * y[axis];
        }
        c.scale = -1;
        const double norm = std::sqrt(square);
        if (!(norm > 0)) return;
        for (double& component : c.normal) component /= norm;
        c.offset = at_point / norm;
        deepest_.add(c);
    }

    bool is_apart() const {
        bool only_planes = true;
        for (std::size_t i = 0; i < 4; ++i)
            if (deepest_.weight(i) > 0 && deepest_.constraint(deepest_.basis()[i]).scale < 0)
                only_planes = false;
        return only_planes ? planes_exclude() : weights_exclude();
    }

    /// Weights as integers: the sum of weight · (n · x + d) is at most zero in the whole cell, so no point of its
    /// interior is strictly inside all planes. Bits: weights 40, values 63, four of them: 105.
    bool planes_exclude() const {
        static_assert(40 + 63 + 2 < 127);
        double largest = 0;
        std::array<double, 4> weight{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Constraint& c = deepest_.constraint(deepest_.basis()[i]);
            if (c.scale > 0) weight[i] = deepest_.weight(i) / c.scale;
            largest = std::max(largest, weight[i]);
        }
        if (!(largest > 0)) return false;
        Wide value = 0;
        std::array<Wide, 3> normal{};
        for (std::size_t i = 0; i < 4; ++i) {
            if (weight[i] == 0) continue;
            const auto w = static_cast<std::int64_t>(std::nearbyint(weight[i] / largest * 0x1p40));
            const LatticePlane& plane = planes_[deepest_.basis()[i] - box_faces];
            value += Wide{w} * plane.at(cell_.low.x, cell_.low.y, cell_.low.z);
            for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += Wide{w} * plane.normal[axis];
        }
        for (const Wide component : normal)
            if (component > 0) value += component * cell_.side();
        return value <= 0;
    }

    /// The same in doubles: the largest value in [0, 1]³ of the weighted sum is negative beyond its rounding.
    bool weights_exclude() const {
        double value = 0, size = 0;
        std::array<double, 3> normal{};
        for (std::size_t i = 0; i < 4; ++i) {
            const Constraint& c = deepest_.constraint(deepest_.basis()[i]);
            if (c.scale == 0) continue;
            value += deepest_.weight(i) * c.offset;
            size += deepest_.weight(i) * (std::fabs(c.offset) + 3);
            for (std::size_t axis = 0; axis < 3; ++axis) normal[axis] += deepest_.weight(i) * c.normal[axis];
        }
        for (const double component : normal) value += std::max(0.0, component);
        return value < -32 * 0x1p-53 * size;
    }

    /// The point on a grid of 2^-20 units, exactly: coordinates 46 bits, normals 34, offsets 82.
    bool planes_hold(const std::array<double, 3>& y) const {
        static_assert(exact::coordinate_bits + 20 + LatticePlane::normal_bits + 3 < 127);
        std::array<Wide, 3> p{};
        for (int axis = 0; axis < 3; ++axis) {
            const double local = y[static_cast<std::size_t>(axis)] * side_ * 0x1p20;
            const Wide side = Wide{cell_.side()} << 20;
            const Wide step = static_cast<Wide>(std::nearbyint(local));
            if (step <= 0 || step >= side) return false;
            p[static_cast<std::size_t>(axis)] = (Wide{cell_.low[axis]} << 20) + step;
        }
        for (const LatticePlane& plane : planes_) {
            Wide value = Wide{plane.offset} << 20;
            for (std::size_t axis = 0; axis < 3; ++axis) value += plane.normal[axis] * p[axis];
            if (value <= 0) return false;
        }
        return true;
    }

    const octree::Cell& cell_;
    std::span<const LatticePlane> planes_;
    std::span<const SecondOrderCone* const> cones_;
    double side_;
    bool complete_ = true;
    DeepestPoint deepest_;
};

/// Two half spaces and the cell, exactly. The largest value in the cell of a weighted sum is convex and piecewise
/// linear in the weights, with kinks where a component of the normal vanishes; they are apart when it is at most
/// zero at one of the kinks or ends (Farkas), and meet otherwise. Bits: weights 34, values 63, one sum: 98.
Overlap overlap_of_two(const octree::Cell& cell, const LatticePlane& p, const LatticePlane& q) {
    static_assert(LatticePlane::normal_bits + 63 + 1 < 127);
    const std::int64_t at_p = p.at(cell.low.x, cell.low.y, cell.low.z),
                       at_q = q.at(cell.low.x, cell.low.y, cell.low.z);
    const auto excluded = [&](std::int64_t weight_p, std::int64_t weight_q) {
        Wide value = Wide{weight_p} * at_p + Wide{weight_q} * at_q;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Wide component = Wide{weight_p} * p.normal[axis] + Wide{weight_q} * q.normal[axis];
            if (component > 0) value += component * cell.side();
        }
        return value <= 0;
    };
    if (excluded(1, 0) || excluded(0, 1)) return Overlap::apart;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t a = p.normal[axis], b = q.normal[axis];
        if ((a > 0 && b < 0) || (a < 0 && b > 0))
            if (excluded(std::abs(b), std::abs(a))) return Overlap::apart;
    }
    return Overlap::meets;
}

}  // namespace

Overlap overlap(const octree::Cell& cell, std::span<const LatticePlane> planes,
                std::span<const SecondOrderCone* const> cones) {
    if (planes.size() == 2 && cones.empty()) return overlap_of_two(cell, planes[0], planes[1]);
    return Question(cell, planes, cones).answer();
}

}  // namespace octavo::csg
