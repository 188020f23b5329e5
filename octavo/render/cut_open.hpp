// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/mesh/mesh.hpp>

// Solids cut open for a look inside: without what lies in a box, by the kernel's own set operations, so that the cut is
// a face like any other. Sides of the box may be infinite: a half space is a box with five of them.

namespace octavo::render {

/// The operand that facets of a cut have as their source.
inline constexpr std::uint32_t cut_operand = ~std::uint32_t{0};

/// The solid without `removed`. Sources of the facets are those of `solid`, operand 0 where it has none.
/// Errors: those of Booleans; not_a_solid when the mesh does not bound one.
Result<mesh::Mesh> cut_open(const mesh::Mesh& solid, const Box3& removed, const Context& context = {});

struct CutBspOctree {
    bsp_octree::BspOctree solid;
    std::vector<bsp::Facing> cut;  ///< how faces of the cut look
};

/// Errors: those of set operations.
Result<CutBspOctree> cut_open(const bsp_octree::BspOctree& solid, const Box3& removed,
                              const Context& context = {});

}  // namespace octavo::render
