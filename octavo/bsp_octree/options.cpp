// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <octavo/bsp_octree/options.hpp>
#include <octavo/exact/lattice.hpp>

namespace octavo::bsp_octree {

Status check(const Options& options) {
    if (options.depth < 0 || options.depth > exact::coordinate_bits)
        return Error{ErrorCode::bad_input,
                     "the depth of a BSP-octree is 0 to 26, not " + std::to_string(options.depth),
                     {}};
    if (options.planes < 1 || options.planes > Options::most_planes)
        return Error{
            ErrorCode::bad_input,
            "a leaf of a BSP-octree holds at most 1 to 1000 planes, not " + std::to_string(options.planes),
            {}};
    return Done{};
}

}  // namespace octavo::bsp_octree
