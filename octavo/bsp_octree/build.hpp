// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/mesh/mesh.hpp>

// Triangles → BSP-octree.
//
// Fragments of facets descend to the leaves (subdivide.hpp). Each cell also knows the winding number of its low corner
// displaced by an infinitely small (ε₁, ε₂, ε₃), and that of an octant follows from its parent's by steps that count
// crossings (classic/crossing.hpp), so an octant without faces knows its colour at once. The source colours such
// octants from the signs of two corners of their siblings instead (algorithm 3.1); a corner on a face has no sign, and
// steps do not need siblings.
//
// A BSP tree labels regions by the faces that bound them, which is right for a surface that bounds a solid and wrong
// for one that crosses or covers itself. So the surface is checked first, and where it may be no solid's, regions are
// labelled by winding numbers: inside is where they are positive, as everywhere in Octavo. Planes stay those of facets,
// and no vertex is rounded. (Resolving by a Boolean first, rounded to the lattice, was tried and lost: slits thinner
// than a lattice unit close, or cross anew in every round; docs/methods/bsp_octree.md.) Source: algorithm 3.1 in
// Argüelles, BSP-OctTree.

namespace octavo::bsp_octree {

enum class SurfaceCheck : std::uint8_t {
    resolve,  ///< look for self-intersections and overlaps, and take the solid for where it winds about
    trust,    ///< the caller knows that the closed surface does not meet itself; wrong if it does
};

struct MeshOptions {
    Options octree;
    SurfaceCheck surface = SurfaceCheck::resolve;
};

struct BuildReport {
    std::size_t facets_without_area = 0;
    std::size_t moved_vertices = 0;   ///< by snapping
    double largest_displacement = 0;  ///< by snapping, in world units
    bool resolved = false;            ///< the surface had other windings than 0 before and 1 behind it
    std::vector<std::string> warnings;
};

struct Built {
    BspOctree octree;
    BuildReport report;
};

/// The BSP-octree of a closed mesh on the finest lattice that holds it.
/// Errors: bad_input (indices, vertices not finite), not_a_solid (open), limit (no lattice), cancelled.
Result<Built> build(const mesh::Mesh& mesh, const MeshOptions& options = {}, const Context& context = {});

/// The same on a given lattice, whose universe must contain the mesh with a unit to spare, and in a given store.
Result<Built> build(const mesh::Mesh& mesh, const exact::Lattice& lattice, const MeshOptions& options = {},
                    const Context& context = {}, std::shared_ptr<Store> store = nullptr);

}  // namespace octavo::bsp_octree
