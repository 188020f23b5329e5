// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/soup.hpp>

// What nearly touches in a soup: vertices near vertices, edges and facets, and edges near edges.
//
// Distances are measured in doubles: nearness is the user's wish, not a decision about geometry, and whatever is found
// here is only ever joined in ways that keep surfaces closed (flush.hpp). What touches *exactly* is told apart by
// integer arithmetic, because the arrangement handles it and nothing need be moved for it.
// Facets of one operand count like any others, and a facet's own corner may be near its opposite edge.
// Cost: that of the search for contacts.

namespace octavo::boolean {

/// Two vertices, low < high.
struct Edge {
    std::uint32_t low = 0, high = 0;
    Edge() = default;
    Edge(std::uint32_t a, std::uint32_t b) : low(a < b ? a : b), high(a < b ? b : a) {}
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

struct NearContacts {
    struct AtVertex {
        std::uint32_t vertex, other;
        friend auto operator<=>(const AtVertex&, const AtVertex&) = default;
    };
    struct OnEdge {
        Edge edge;
        std::uint32_t vertex;
        bool exact;  ///< the vertex lies on the edge
        friend auto operator<=>(const OnEdge&, const OnEdge&) = default;
    };
    struct OnFacet {
        std::uint32_t facet, vertex;
        bool exact;  ///< the vertex lies on the facet
        friend auto operator<=>(const OnFacet&, const OnFacet&) = default;
    };
    /// Edges that pass each other, far from the ends of both.
    struct Crossing {
        Edge first, second;   ///< first < second
        exact::Point middle;  ///< the lattice point nearest to the middle between them
        bool exact;           ///< they meet
        friend auto operator<=>(const Crossing&, const Crossing&) = default;
    };
    /// Facets that are nearly parallel and come near each other.
    struct Faces {
        std::uint32_t first, second;
        friend auto operator<=>(const Faces&, const Faces&) = default;
    };

    // Each sorted, without repetitions.
    std::vector<AtVertex> at_vertex;
    std::vector<OnEdge> on_edge;
    std::vector<OnFacet> on_facet;
    std::vector<Crossing> crossings;
    std::vector<Faces> faces;

    /// How much is near without touching.
    std::size_t inexact() const;
};

/// All that is not farther apart than `tolerance`, in lattice units. `tree` must have been built with that reach or a
/// greater one. Cancellation leaves the result incomplete.
NearContacts find_near_contacts(const Soup& soup, const FacetTree& tree, double tolerance,
                                const Context& context);

}  // namespace octavo::boolean
