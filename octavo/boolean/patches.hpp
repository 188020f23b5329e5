// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/stars.hpp>

// Patches: maximal sets of triangles of the complex with the same solid on either side.
//
// An edge with two triangles that pass it in opposite directions changes nothing: both have the same regions of
// space in front and behind. Most vertices have only such edges and one fan of triangles; then the whole fan is
// one patch, and the vertex is never looked at again (*plain*). What is left are the *junctions*: edges between
// vertices that are not plain where more triangles meet, or where two meet turned against each other. Round a
// junction the triangles are sorted exactly, by their planes' normals alone: a normal is perpendicular to the edge,
// and turns about it as its triangle does. Neighbours in that order look at the same region of space.
//
// The boundary of every operand must vanish: at each edge its winding changes sum to nothing. That test is exact
// and geometric (cut edges included, so T-junctions that close are fine), and it is what refuses open operands.
//
// Stars that nothing cuts are what they were in the soup; only the others are looked at anew.
// Cost: linear.

namespace octavo::boolean {

/// One side of a patch: 2 · patch is its front, 2 · patch + 1 its back.
using PatchSide = std::uint32_t;

struct Junction {
    PointId low, high;         ///< low < high
    std::uint32_t begin, end;  ///< of its triangles in `Patches::around`
};

struct Patches {
    std::uint32_t count = 0;
    std::vector<std::uint32_t> of_triangle;  ///< no_index for facets that pieces stand for
    std::vector<std::uint32_t> first;        ///< per patch, its first triangle; ascending
    std::vector<char> is_plain;              ///< per point
    std::vector<Junction> junctions;
    /// 2 · triangle + (it runs from low to high); counter-clockwise seen from the high end.
    std::vector<std::uint32_t> around;
    /// Pairs of patch sides that bound the same region.
    std::vector<std::pair<PatchSide, PatchSide>> same_region;
};

/// Errors: not_a_solid when an operand is open or inconsistently oriented, with facets at such edges.
/// `stars` are those of the soup.
Result<Patches> find_patches(const Complex& complex, const Stars& stars, const PointTable& points,
                             const Context& context);

}  // namespace octavo::boolean
