// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/bp_octree/frame.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/morton.hpp>

// Where a BP-octree stops, by the three criteria of the thesis (its section 3.3, tables 3.1 and 3.2). There, all cells
// of the deepest level that the surface meets are made first, and siblings that are all leaves are then joined from
// below:
//
//     count   while the new leaf has at most so many triangles
//     sum     while the siblings have, those in several counted several times
//     mean    until siblings have so many triangles on average
//     none    never
//
// The thesis says count; its tables show sum: its bunny has 11 694 leaves of 12 triangles on level 6, where joining by
// count leaves 2 213. By count the same leaves follow from above, since a cell meets no fewer triangles than its
// octants do. A sum or a mean says nothing of the cells below, so these are looked at first: `split_by_siblings`.
//
// Source: F. J. Melero, BP-Octree, doctoral thesis, Granada 2008. The algorithm printed there (4) never joins anything:
// a flag that says that all octants are leaves is only set by octants that are none.

namespace octavo::bp_octree {

enum class Coalescing : std::uint8_t { count, sum, mean, none };

/// Whether octants that meet triangles are joined: `met` of them, which meet `sum` in all.
struct SiblingCriterion {
    double most_sum;   ///< at most so many in all
    double less_mean;  ///< and fewer than so many on average
    bool joins(std::size_t sum, std::size_t met) const {
        return static_cast<double>(sum) <= most_sum &&
               static_cast<double>(sum) < less_mean * static_cast<double>(met);
    }
    /// True when all below a cell that meets so many is joined, whatever it is.
    bool always_joins(std::size_t triangles) const {
        return 8 * static_cast<double>(triangles) <= most_sum && static_cast<double>(triangles) < less_mean;
    }
};

/// The cells that stay split, ascending: those below `depth` with an octant that stays split, or whose octants are not
/// joined. Errors: cancelled.
Result<std::vector<octree::CellKey>> split_by_siblings(const mesh::LatticeMesh& mesh, const Frame& frame,
                                                       int depth, const SiblingCriterion& criterion,
                                                       const Context& context = {});

}  // namespace octavo::bp_octree
