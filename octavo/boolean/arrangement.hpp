// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/contacts.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/soup.hpp>

// The soup cut along all its contacts: a conforming complex of triangles, no two of which cross or overlap.
//
// Facets that nothing cuts stay as they are. Each other face, and each set of coplanar faces that overlap (a
// *sheet*), is subdivided in its plane by all that meets it. Faces that overlap become one triangle that carries
// the sum of their winding changes, like facets that coincide from the start.
//
// Invariants: two triangles share nothing, a corner, or an edge with both its ends; equal points have equal ids; a
// triangle turns as its facet (`facet`, the first face of those that cover it) does.
// Cost: linear in contacts and cut facets; sheets are independent and run in parallel.

namespace octavo::boolean {

/// Triangles are numbered through: [0, facets) are the soup's, then come the pieces of cut facets.
struct Complex {
    const Soup* soup = nullptr;
    std::vector<char> is_cut;  ///< per facet of the soup: pieces stand for it
    UninitialisedVector<mesh::Triangle> pieces;
    UninitialisedVector<std::uint32_t> piece_facet;  ///< the name of its face
    UninitialisedVector<TransitionId> piece_transition;
    TransitionTable transitions;  ///< the soup's and those of overlapping facets
    /// Facets of cut faces of two, and the face, after which their pieces are named.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> joined;
    std::size_t sheets = 0;

    std::uint32_t size() const { return static_cast<std::uint32_t>(soup->facets.size() + pieces.size()); }
    std::uint32_t facets() const { return static_cast<std::uint32_t>(soup->facets.size()); }
    bool is_piece(std::uint32_t triangle) const { return triangle >= soup->facets.size(); }
    bool exists(std::uint32_t triangle) const { return is_piece(triangle) || !is_cut[triangle]; }
    const mesh::Triangle& corners(std::uint32_t triangle) const {
        return is_piece(triangle) ? pieces[triangle - soup->facets.size()] : soup->facets[triangle];
    }
    /// The soup facet in whose plane the triangle lies, turning the same way.
    std::uint32_t facet(std::uint32_t triangle) const {
        return is_piece(triangle) ? piece_facet[triangle - soup->facets.size()] : triangle;
    }
    TransitionId transition(std::uint32_t triangle) const {
        return is_piece(triangle) ? piece_transition[triangle - soup->facets.size()]
                                  : soup->transition[triangle];
    }
};

/// Adds the points where cuts cross inside facets to `points`. Cancellation leaves the result incomplete.
Complex arrange(const Soup& soup, const Contacts& contacts, PointTable& points, const Context& context);

}  // namespace octavo::boolean
