// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <octavo/base/grouped.hpp>
#include <octavo/base/result.hpp>

// What a descent (octree/descend.hpp) can be told, apart from the descent: builders of octrees hand parts of it on in
// options of their own.

namespace octavo::octree {

struct DescentOptions {
    /// The name under which progress is reported.
    std::string_view phase = "octree";
    /// Sub-trees with more weight than this may run at the same time as their siblings. Small enough for
    /// eight threads to share 100 000 triangles, large enough that a fork (some microseconds) is lost in it.
    /// It does not influence the result.
    std::size_t fork_weight = 2000;
    /// An octree with more nodes than this is refused. The default is 500 MB of DF code.
    std::uint64_t max_nodes = default_max_nodes;
    static constexpr std::uint64_t default_max_nodes = 2'000'000'000;
};

/// The error of an octree that has more nodes than the limit.
inline Error too_many_nodes(std::uint64_t max_nodes, int depth) {
    return {ErrorCode::limit,
            "the octree has more than " + grouped(max_nodes) + " nodes at depth " + std::to_string(depth) +
                "; ask for less depth, or raise the limit",
            {},
            "max_nodes"};
}

}  // namespace octavo::octree
