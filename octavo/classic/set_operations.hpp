// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/base/result.hpp>
#include <octavo/octree/octree.hpp>

// Set operations on classic octrees, directly on the DF code.
//
// Both codes are walked together. Where one operand is a leaf that decides the operation, the sub-tree of the
// other is stepped over; where it is neutral, that sub-tree is copied; where both are split, their octants are
// combined one by one, and eight octants of one colour become one cell. Nothing is unpacked, so the working
// memory is the result. Cost: linear in the nodes of both.
// Source: H. Samet, Applications of Spatial Data Structures, 1990, §1.4, and table 3.1 of F. Argüelles.

namespace octavo::classic {

enum class SetOperation : std::uint8_t { union_of, intersection, difference, symmetric_difference };

/// The result's colours are right wherever the operands' are; a gray leaf of one meets a gray leaf of the other
/// gray. Depth is the larger one. Errors: bad_input when the two lie on different lattices.
Result<octree::Octree> combine(SetOperation operation, const octree::Octree& a, const octree::Octree& b);

octree::Octree complement(const octree::Octree& a);

/// The same on codes; both must be trees of one universe.
octree::DfCode combine(SetOperation operation, const octree::DfCode& a, const octree::DfCode& b);
octree::DfCode complement(const octree::DfCode& a);

}  // namespace octavo::classic
