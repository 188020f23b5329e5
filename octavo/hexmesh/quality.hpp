// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// How good the cells of a mesh are for a solver: the scaled Jacobian, and whether the map from the unit cube is one to
// one in each cell.
//
// The scaled Jacobian of a corner is the determinant of its three edges over the product of their lengths: 1 for a
// right angle, 0 when flat, negative when folded; a cell's is the least of its eight corners. That alone does not tell
// whether the trilinear map folds inside. Its determinant is a polynomial of degree 2 along each axis; written
// in Bernstein form it lies between the least and the largest of its 27 coefficients, so when all are positive it is
// positive everywhere (A. Johnen, J.-C. Weill, J.-F. Remacle, Robust and efficient validation of the linear
// hexahedral element, 2017). Coefficients must exceed 10⁻⁹ of the cube of the longest edge, a million times what
// rounding does to them, so a yes is a proof. Their mean is the volume of the cell, exact in real arithmetic.
//
// Cells may have right angles and still be slivers: so the shortest edge and the largest ratio of edges are told too.

namespace octavo::hexmesh {

using CellCorners = std::array<Vec3, 8>;

double scaled_jacobian(const CellCorners& corners);

/// True only if the trilinear map is positively oriented everywhere in the cell.
bool is_positive_everywhere(const CellCorners& corners);

/// The volume of the image of the unit cube under the trilinear map; negative where more of it is folded than not.
double volume_of(const CellCorners& corners);

struct Quality {
    double least = 1, mean = 1;  ///< scaled Jacobian
    /// Cells with scaled Jacobian in [i/10, (i+1)/10); those below 0 in the first, 1 in the last.
    std::array<std::uint64_t, 10> histogram{};
    double volume = 0;                      ///< of all cells
    double shortest_edge = 0;               ///< in world units
    double largest_edge_ratio = 1;          ///< longest over shortest edge of one cell
    std::uint64_t not_proved_positive = 0;  ///< cells that `is_positive_everywhere` does not vouch for
};

/// Products of three lengths must be doubles, also those of cells a millionth as large. Error: limit when a model of
/// these bounds is too large or too small for that.
Status check_size(const Box3& bounds);

CellCorners corners_of(const mesh::HexMesh& mesh, mesh::CellIndex cell);

/// Per cell.
std::vector<double> scaled_jacobians(const mesh::HexMesh& mesh);

Quality measure_quality(const mesh::HexMesh& mesh);

}  // namespace octavo::hexmesh
