// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include <octavo/base/context.hpp>
#include <octavo/csg/expression.hpp>
#include <octavo/csg/program.hpp>
#include <octavo/octree/descent_options.hpp>
#include <octavo/octree/octree.hpp>

// From a CSG expression to its classic octree, by either of two methods that give the same tree.
//
// Top-down: one descent evaluates the whole expression in each octant and prunes it on the way
// (csg/prune.hpp). Work and memory follow the surface of the result. Classic: an octree is built for every
// primitive and the set operations are done on octrees; kept because it is the method that the other is measured
// against, and as its oracle. In both, gray cells of the last level are looked at again
// (csg/local_arrangement.hpp), so that primitives that abut leave no inner wall, and eight white or black
// siblings become one cell.
//
// Source: F. Argüelles, creation of octrees from CSG definitions, chapter 3, with the methods "clásico" and "top
// down"; there memory per primitive and no pruning below the first decided operand.

namespace octavo::classic {

enum class CsgMethod : std::uint8_t { top_down, classic };

struct CsgBuildOptions {
    /// Levels below the universe; cells of the last have side 2^(26 − depth) lattice units. At most 21.
    int depth = 7;
    /// When positive, the depth follows from it: the least one whose cells have at most this side in the world.
    double precision = 0;
    CsgMethod method = CsgMethod::top_down;
    /// See csg::CompileOptions.
    std::optional<Box3> universe = {};
    /// An octree with more nodes is refused; of CsgMethod::classic all octrees that exist at a time.
    std::uint64_t max_nodes = octree::DescentOptions::default_max_nodes;
};

struct CsgBuildStats {
    std::uint64_t primitives = 0;  ///< leaves of the expression on the lattice
    std::uint64_t octants = 0;     ///< cells classified
    std::uint64_t primitive_tests =
        0;                         ///< primitives tested: once for each octant that the primitive's box meets
    std::uint64_t resolved = 0;    ///< gray cells of the last level that a second look decided
    std::uint64_t peak_nodes = 0;  ///< most octree nodes that existed at a time
    std::uint64_t peak_bytes = 0;  ///< of them and of pruned programs, on one path from the root
};

struct CsgOctree {
    octree::Octree octree;
    CsgBuildStats stats;
};

/// The octree of an expression. The same for both methods and any number of threads. Errors: bad_input (a number
/// that is not finite, a depth out of range), limit (unbounded, too large, more nodes than `max_nodes`), cancelled.
Result<CsgOctree> build(const csg::Expr& expression, const CsgBuildOptions& options = {},
                        const Context& context = {});

/// The same for an expression that is already on a lattice.
Result<CsgOctree> build(const csg::Program& program, const CsgBuildOptions& options = {},
                        const Context& context = {});

}  // namespace octavo::classic
