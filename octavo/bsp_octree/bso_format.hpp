// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>

// The bytes of a `.bso` file: a BSP-octree, exactly (docs/formats/bso.md).
//
// The DF code of the source: two bits a node of the octree, one bit a node of a BSP tree, and references to a table of
// planes. A plane is three lattice points, and neighbours share points: so points are a table too, and a plane is
// three references. References say "the next new one" with one bit, else how far back the one meant was first used;
// since tables are in the order of first use, and neighbours in space come soon after one another, that is short.
// Measured: 11.5 bytes a triangle of the closed bunny, 11.8 of the armadillo; a binary PLY has 19.

namespace octavo::bsp_octree {

/// True when the bytes begin like a .bso file.
bool looks_like_bso(std::span<const std::uint8_t> bytes);

/// Nodes and planes that the solid does not refer to are left out. The same solid gives the same bytes.
std::vector<std::uint8_t> encode(const BspOctree& octree);

/// Tests every claim: bad_input with the byte where the trouble is; unsupported for another version.
/// Not tested is whether the faces of the trees close: of a file that was made to lie, `to_mesh` will say so.
Result<BspOctree> decode(std::span<const std::uint8_t> bytes);

}  // namespace octavo::bsp_octree
