// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/classify.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/exact/plane.hpp>

// The boundary of the result while its points are still exact: the selected triangles of the complex, turned so
// that the solid is behind them.

namespace octavo::boolean {

struct Surface {
    struct Facet {
        std::uint32_t soup_facet : 30;  ///< in whose plane it lies; also where it comes from
        std::uint32_t reversed : 1;     ///< it turns against that facet
        std::uint32_t is_piece : 1;     ///< not a whole input facet
    };
    UninitialisedVector<mesh::Triangle> triangles;  ///< whole input facets first
    UninitialisedVector<Facet> facets;              ///< of each triangle
    /// Soup facets whose pieces are parts of a polygon with pieces of others, and the facet that this is named after.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> merged;

    /// The number of whole input facets.
    std::size_t first_piece() const {
        const auto at = std::partition_point(facets.begin(), facets.end(),
                                             [](const Facet& facet) { return facet.is_piece == 0; });
        return static_cast<std::size_t>(at - facets.begin());
    }

    /// The plane of triangle `index`, its front outside the solid.
    exact::Plane plane(const Soup& soup, std::size_t index) const {
        const mesh::Triangle& corner = soup.facets[facets[index].soup_facet];
        const exact::Plane plane =
            exact::Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
        return facets[index].reversed ? plane.reversed() : plane;
    }
};

/// The triangles that bound the result, in the order of the complex. Cancellation leaves surfaces incomplete.
Surface select(const Complex& complex, const Patches& patches, const Classification& classification,
               const Context& context);

/// The triangles that dangle, as their facets turn.
Surface select_dangling(const Complex& complex, const Patches& patches, const Classification& classification,
                        const Context& context);

/// Per point: whether it is where triangles were cut, or met other surfaces. All other points keep their fan of
/// input facets.
std::vector<char> special_points(const Surface& surface, const Patches& patches);

}  // namespace octavo::boolean
