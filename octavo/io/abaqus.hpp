// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/hex_mesh.hpp>

// Abaqus and CalculiX input: nodes, C3D8 elements, sets and the equations that tie hanging nodes.
//
// Without the equations a graded mesh has cracks and solvers give wrong stresses without a word, so they are always
// written: one *EQUATION for each hanging node and each degree of freedom, the dependent node first.
// CalculiX reads 20 characters of a number and drops the rest, exponent included; no number here is longer.
//
// Sets: an element set for each material ("A" or "A_AND_B", upper case, "OUTSIDE"; none twice,
// mesh/material_names.hpp); an element surface for its part of the boundary ("SURFACE_OF_" and the name of the set),
// where sides that smaller cells cover in part are left out; the node sets ALL, HANGING, and XMIN to ZMAX: the nodes at
// either end of the mesh, to a thousandth of the shortest edge of a cell, without hanging ones, which supports must not
// hold. Node and element numbers are those of the mesh plus one.

namespace octavo::io {

struct AbaqusOptions {
    std::span<const std::string> names = {};  ///< of the solids; those that are missing are called SOLID_0 …
    /// Degrees of freedom 1 to this are tied: 3 for displacements, 1 for temperature (as degree 11).
    enum class Field : std::uint8_t { displacement, temperature } field = Field::displacement;
    /// Text to append: materials, supports, loads and steps.
    std::string tail = {};
};

/// Writes to the file `path`, or to standard output when it is "-".
/// Errors: unsupported when hanging nodes are masters of others (balance by face); io; cancelled.
Result<WriteReport> write_abaqus(const std::string& path, const mesh::HexMesh& mesh,
                                 const AbaqusOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
