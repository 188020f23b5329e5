// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/query/closest.hpp>

// Which surfaces the nodes between cells of different materials belong on, and where these are nearest.
//
// Problem: the nearest surface may be that of a solid that has nothing to do with the two materials, or that lies
// wholly within another one and bounds nothing there. Idea: two cells are separated by the solids that only one of them
// belongs to. Those of one side together are their union, and the signed distance of a union is the least of its
// solids' distances: outside all that is the nearest surface, and inside the one under which the point lies deepest,
// since all nearer ones lie within that solid. Of the two sides' unions the nearer one counts: where materials meet,
// both surfaces separate them. A node of several separations wants to be on the surfaces of all, so the one farthest
// off is its next aim. Inside is winding number > 0, and open solids are closed as they were for meshing
// (classic/closed_surface.hpp). Not seen: that parts of a surface separate nothing, where solids touch. Where a face
// that two solids share runs out to the boundary of the mesh, nodes on its rim lie on both surfaces and go no farther.

namespace octavo::hexmesh {

/// The solids of two neighbouring cells that only one of them belongs to; ascending.
struct Separation {
    std::vector<mesh::SolidIndex> one_side, other_side;
    friend auto operator<=>(const Separation&, const Separation&) = default;
};

/// The nodes on sides between different materials, or between one and nothing. Hanging nodes, which follow their
/// masters, are left out.
struct SeparatingNodes {
    std::vector<mesh::NodeIndex> nodes;     ///< ascending
    std::vector<std::uint32_t> begin, ids;  ///< of node i: separations ids[begin[i]] to ids[begin[i + 1] - 1]
    std::vector<Separation> separations;

    std::span<const std::uint32_t> of(std::size_t i) const {
        return {ids.data() + begin[i], begin[i + 1] - begin[i]};
    }
};

SeparatingNodes separating_nodes(const mesh::HexMesh& mesh);

class SeparatingSurfaces {
  public:
    /// Prepares those of the solids that `mesh` has cells of; it tells which of them overlap.
    /// Errors: those of query::ClosestQuery; cancelled.
    static Result<SeparatingSurfaces> build(std::span<const mesh::Mesh> solids, const mesh::HexMesh& mesh,
                                            const Context& context);

    /// For each of `nodes`, when it is at its of `points`, the nearest point of the one of its separating surfaces that
    /// is farthest off; distances are not negative. Cancelled: some are NaN.
    std::vector<query::Closest> operator()(const SeparatingNodes& nodes, std::span<const Vec3> points,
                                           const Context& context) const;

  private:
    std::vector<std::optional<query::ClosestQuery>> closest_;  ///< per solid
};

}  // namespace octavo::hexmesh
