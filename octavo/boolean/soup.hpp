// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/transition.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/mesh/mesh.hpp>

// All operands of a Boolean as one soup of facets on one lattice.
//
// Vertices are snapped and welded across operands, so that a vertex is its point. Facets without area are
// dropped. Facets with the same three corners, of whatever operands, become one facet (the first) that carries
// the sum of their winding changes; where the sum is nothing they vanish. Identical operands, the case that makes
// pair tests explode, thus cost no more than one operand.
//
// Cost: linear, about 60 ns a facet; in parallel.

namespace octavo::boolean {

inline constexpr std::uint32_t no_index = ~std::uint32_t{0};

/// What happens to operands that do not close.
enum class OpenOperands : std::uint8_t {
    reject,   ///< an error names the facets at open edges
    winding,  ///< holes are closed by cones (closing.hpp), so that winding numbers exist
};

struct Soup {
    exact::Lattice lattice;
    UninitialisedVector<exact::Point> points;
    UninitialisedVector<mesh::Triangle> facets;
    UninitialisedVector<TransitionId> transition;  ///< per facet: winding behind minus winding in front
    UninitialisedVector<std::uint32_t>
        origin;  ///< per facet: the input triangle, counted through all operands
    std::vector<std::uint32_t> first_triangle;  ///< per operand, and one past the last
    TransitionTable transitions;

    double largest_displacement = 0;    ///< of a vertex by snapping, in world units
    std::size_t moved_vertices = 0;     ///< not on the lattice before
    std::size_t flat_facets = 0;        ///< dropped: no area on the lattice
    std::size_t coincident_facets = 0;  ///< merged into another facet
    std::size_t closing_facets = 0;     ///< added to close operands
    std::vector<std::string> warnings;

    mesh::Source source(std::uint32_t facet) const;
};

/// Errors: bad_input when a vertex is not finite or a corner out of range; limit when there are too many facets
/// or the operands' sizes and positions have no common lattice. Warns of operands that the lattice is too coarse for.
/// `names` are what warnings call operands; those beyond are called "operand 3".
Result<Soup> make_soup(std::span<const mesh::Mesh* const> operands, OpenOperands open,
                       std::span<const std::string> names, const Context& context);

/// Drops the facets that are marked. Cancellation leaves the others anything.
void drop_facets(const std::vector<char>& dropped, Soup& soup, const Context& context);

}  // namespace octavo::boolean
