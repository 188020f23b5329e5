// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/render/camera.hpp>
#include <octavo/render/scene.hpp>

// The faces of a scene or of a BSP-octree from the front to the back: none hides one before it.
//
// An octree gives the order for nothing: octants next to the viewer come first (eye.hpp), and each leaf has a BSP tree
// of the faces in it (tree_order.hpp). For a BSP-octree both are there. The facets of a scene may be anything, open,
// crossing, covering one another: they are rounded to a lattice and subdivided for this one view by the same rules,
// leaf after leaf, without keeping the tree. All decisions are exact; only the corners that come out are doubles.
// Cost: a scene of 100 K triangles about 1 s, 6 µs a triangle of it for fragments, 2 for order.

namespace octavo::render {

/// A convex piece of a face, in one colour.
struct Patch {
    std::uint32_t begin = 0, count = 0;  ///< corners, either way round
    Vec3 normal;                         ///< of length 1, towards the viewer
    Color color;                         ///< as lit
};

struct Patches {
    std::vector<Vec3> corners;
    std::vector<Patch> patches;  ///< from the front to the back
    double unit = 0;             ///< of the lattice: corners are as exact as that

    std::span<const Vec3> corners_of(const Patch& patch) const {
        return {corners.data() + patch.begin, patch.count};
    }
};

/// Errors: bad_input when a facet is not finite, limit when the scene has no lattice, cancelled.
Result<Patches> patches_of(const Scene& scene, const Camera& camera, const Context& context = {});

enum class BspOctreeColors : std::uint8_t {
    solid,  ///< the surface of a solid
    node,   ///< by how many planes the leaf holds: a face, an edge, a vertex, more
};

struct BspOctreePaint {
    BspOctreeColors colors = BspOctreeColors::solid;
    /// Faces that look so are where the solid was cut open.
    std::span<const bsp::Facing> cut = {};
};

/// Errors: cancelled.
Result<Patches> patches_of(const bsp_octree::BspOctree& solid, const Camera& camera,
                           const BspOctreePaint& paint = {}, const Context& context = {});

}  // namespace octavo::render
