// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/frame.hpp>

namespace octavo::bp_octree {

Frame Frame::around(std::span<const exact::Point> points, int depth) {
    OCTAVO_CHECK(!points.empty(), "a frame needs a point");
    OCTAVO_CHECK(depth >= 0 && depth <= max_depth, "the depth of a BP-octree is 0 to 18");
    Frame frame;
    frame.depth_ = depth;
    for (int axis = 0; axis < 3; ++axis) {
        std::int32_t low = points[0][axis], high = low;
        for (const exact::Point& point : points) {
            low = std::min(low, point[axis]);
            high = std::max(high, point[axis]);
        }
        const std::int32_t step = std::int32_t{2} << depth;
        const std::int32_t content = 2 * (high - low) + 2;
        frame.low_[axis] = 2 * low - 1;
        frame.side_[axis] = (content + step - 1) / step * step;
    }
    return frame;
}

Result<Frame> Frame::from_parts(std::array<std::int32_t, 3> low, std::array<std::int32_t, 3> side,
                                int depth) {
    const auto bad = [](const char* sentence) { return Error{ErrorCode::bad_input, sentence, {}}; };
    if (depth < 0 || depth > max_depth) return bad("the depth is not within 0 and 18");
    // `around` pads at most one step beyond the doubled universe.
    const std::int32_t largest = (exact::universe_side << 1) + (std::int32_t{2} << depth);
    for (int axis = 0; axis < 3; ++axis) {
        if (low[axis] < -1 || low[axis] >= exact::universe_side * 2 || (low[axis] & 1) == 0)
            return bad("the root box's low corner is not a half-integer of the lattice");
        if (side[axis] <= 0 || side[axis] > largest || side[axis] % (std::int32_t{2} << depth) != 0)
            return bad("a side of the root box is no multiple of the smallest cell");
    }
    Frame frame;
    frame.low_ = low;
    frame.side_ = side;
    frame.depth_ = depth;
    return frame;
}

}  // namespace octavo::bp_octree
