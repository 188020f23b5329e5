// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include <octavo/csg/lattice_plane.hpp>
#include <octavo/csg/second_order_cone.hpp>
#include <octavo/octree/cell.hpp>

// Do the interior of a cell and the interiors of some half spaces and convex quadrics have a point in common?
//
// Testing a cell against each of them alone is not tight: near an edge of a box the cell may be outside although
// no single face says so. Idea: find the point deepest in all of them by a small linear program, and replace a
// quadric by tangent planes, added where the deepest point so far violates it (J. Elzinga and T. Moore, A central
// cutting plane algorithm for the convex programming problem, 1975). The program runs in doubles and decides
// nothing: its answer is a certificate that is then checked.
//
//   meets   the point found, rounded to a grid finer than the lattice, lies strictly inside everything: 128-bit
//           integers for the planes, the cone's error bound for the quadrics;
//   apart   a sum of the constraints with non-negative weights (Farkas) is nowhere positive in the cell: integer
//           weights and 128-bit sums when only planes take part, else doubles beyond their error bound;
//   unsure  neither could be shown: they touch, or overlap by less than rounding.
//
// Cost: one to three microseconds; asked only about cells that several constraints leave undecided.

namespace octavo::csg {

enum class Overlap : std::uint8_t { apart, meets, unsure };

/// At most `most_constraints` constraints are looked at; more are ignored, which can turn `apart` into `unsure`
/// and makes `meets` impossible.
inline constexpr std::size_t most_constraints = 24;

Overlap overlap(const octree::Cell& cell, std::span<const LatticePlane> planes,
                std::span<const SecondOrderCone* const> cones = {});

}  // namespace octavo::csg
