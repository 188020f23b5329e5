// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/boolean/point_table.hpp>
#include <octavo/boolean/surface.hpp>
#include <octavo/bsp/plane_table.hpp>
#include <octavo/bsp_octree/borders.hpp>

// From borders to triangles: what the segments of one plane and facing enclose, triangulated exactly.
//
// A plane is filled from the outside inwards, turning at every border. Where a corner of a face only touches the
// middle of a border of the same plane, the triangulation cuts that border, but the faces on its other side know
// nothing of the corner. Such cuts are told to all planes, and filling is done again with them.

namespace octavo::bsp_octree {

/// Facets name planes of the table as facets of the soup; all are pieces. `borders` are sorted by facing, and are cut
/// where a corner touches them.
boolean::Surface fill_borders(std::vector<Segment>& borders, const bsp::PlaneTable& planes,
                              const boolean::PointTable& points);

}  // namespace octavo::bsp_octree
