// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/exact/plane.hpp>

// Numbers by which lines are recognised, however they were cut out.
//
// Problem: pieces of one line come as intersections of different pairs of planes, and must be found to lie on one
// line. Idea: the line's six Plücker coordinates, direction n₁ × n₂ and moment d₁ n₂ − d₂ n₁, are the same for all
// pairs but for a common factor. Modulo a prime, dividing by the first coordinate that is not zero removes the factor,
// and the six residues are mixed into one word. One inverse serves all lines together (Montgomery's trick), so a key
// costs about 60 ns where dividing by greatest common divisors of 135-bit numbers takes 2 µs.
//
// Lines that are equal have equal keys unless the prime divides a factor, lines that differ have different keys but
// for chance. Neither may decide anything: who uses keys checks exactly that members of a group lie on one line, and
// notices lines that were not brought together because they do not cancel; another prime then decides.

namespace octavo::bsp_octree {

struct PlanePair {
    exact::Plane first, second;  ///< not parallel
};

/// The keys of many lines, modulo one of two primes (`attempt` 0 or 1).
std::vector<std::uint64_t> line_keys(std::span<const PlanePair> lines, int attempt = 0);

}  // namespace octavo::bsp_octree
