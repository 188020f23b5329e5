// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/classic/csg_build.hpp>
#include <octavo/octree/df_code.hpp>

// The classic method of building an octree from CSG: an octree for each primitive, then set operations.

namespace octavo::classic {

struct PrimitivewiseOctree {
    octree::DfCode code;
    CsgBuildStats stats;
};

/// The octree of the program's expression, `options.depth` levels deep, before gray cells are looked at again. Octrees
/// of sub-expressions live only until they are combined; those of one n-ary operation are combined in pairs of like
/// count, so that a leaf takes part in log n operations and not in n. `stats.octants`, `primitive_tests`, `peak_nodes`
/// and `peak_bytes` are those of this method. Errors: limit, cancelled.
Result<PrimitivewiseOctree> build_by_primitive(const csg::Program& program, const CsgBuildOptions& options,
                                               const Context& context);

}  // namespace octavo::classic
