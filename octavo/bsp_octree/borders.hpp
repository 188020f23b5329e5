// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/boolean/point_table.hpp>
#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/plane_table.hpp>

// The sum of the borders of many fragments: the borders of what the fragments of each plane cover together.
//
// Each fragment's edges are directed segments. First, equal segments of one plane that run opposite ways cancel; that
// removes nearly all cuts. The rest is gathered by lines of space. On a line, segments of one facing are added up
// between neighbouring end points: what runs both ways vanishes, however either was cut. Then the end points go at
// which nothing changes, for any facing. What comes out is conforming: segments of all planes on a line have the same
// ends.
//
// Where a solid touches itself, faces may cross and yet have no border there: three planes through one line with
// sectors in and out by turns, as of three wedges on one edge. Each sector that is in lies opposite one that is out, so
// each face goes straight on. (Of an even number of planes, faces turn round there.) Two faces that both go on across
// one line cross, and are slit along it: the segment is there both ways. In the same way three borders of one plane may
// go straight through one point. It is an end of fragments on all of these lines, so points that borders of one facing
// pass on several lines are found by their numbers; all lines are then added up again and keep them.

namespace octavo::bsp_octree {

struct Segment {
    bsp::Facing facing;
    boolean::PointId from, to;  ///< the face is on the left, seen from where the plane's normal points
    friend auto operator<=>(const Segment&, const Segment&) = default;
};

/// A segment and the other bound whose line with the segment's plane it lies on.
struct BoundedSegment {
    Segment segment;
    bsp::Bound bound;
    bool may_be_slit = false;  ///< faces may cross here (shared_lines.hpp)
};

/// The borders, sorted by facing. `points` names the ends. False when they do not close: the keys of this attempt
/// failed (line_key.hpp), or the fragments are no boundary. Cancelled, they are anything.
bool sum_borders(std::vector<BoundedSegment> edges, const bsp::PlaneTable& planes,
                 const boolean::PointTable& points, int attempt, std::vector<Segment>& borders,
                 const Context& context);

}  // namespace octavo::bsp_octree
