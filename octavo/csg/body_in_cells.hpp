// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <octavo/csg/brick_sides.hpp>

// Which cells of a brick does a convex body enter, when their corners do not say?
//
// A cell with all corners outside a body is nearly always missed by it, but no single constraint says so where it
// lies before a bulge or beyond an edge. Idea: eight such cells side by side in the lanes of one register, each with
// the surfaces of its own body, because a body leaves two such cells a brick in the mean. In each a point walks towards
// the body, projected onto the constraints in turn (S. Kaczmarz, 1937; L. Bregman, The method of successive
// projections, 1965). Where it arrives it proves that the body enters the cell; where it cannot, the tangents at the
// place where it stands tell why: one of them is positive in all of the cell, or a weighted sum of two is, with weights
// that cancel a component of their normals, as only those can be best (Farkas; see convex_overlap.hpp). Both answers
// hold beyond the rounding of single precision; cells in which neither could be shown are left to slower ways, one in
// thirty. What is said of a cell does not depend on what lies in the other lanes.
// Cost: about 30 nanoseconds a cell.

namespace octavo::csg {

struct BodyInCells {
    Layers missed;   ///< the body's interior keeps off the cell
    Layers entered;  ///< some point of the closed cell lies strictly inside the body
};

class BodiesInCells {
  public:
    /// Asks about one cell of a brick. The body is the intersection of the surfaces; `matters` are, for each of them,
    /// the cells in which it does not hold the whole cell. The answer is added to `answer`, at the latest by `finish`.
    /// Of more surfaces that matter than `most_at_once`, the rest is ignored and nothing is called entered.
    void ask(std::span<const BrickSurface> surfaces, const Layers* matters, BrickCell cell,
             BodyInCells& answer);
    void finish();

  private:
    static constexpr std::size_t lanes = 8, most_at_once = 8;
    using OneALane = std::array<float, lanes>;

    /// The n-th surface of each lane's body.
    struct alignas(32) Surfaces {
        OneALane low, x, y, z, xx, yy, zz, xy, xz, yz, error, slope, bend;
    };
    struct Question {
        BrickCell cell;
        BodyInCells* answer;
        bool complete;
    };

    void make_room(std::size_t surfaces);
    class Walk;

    std::array<Surfaces, most_at_once> surfaces_;
    std::array<OneALane, 3> low_{};
    std::array<bool, most_at_once> curved_{};
    std::array<Question, lanes> questions_;
    std::size_t count_ = 0, used_ = 0;
};

}  // namespace octavo::csg
