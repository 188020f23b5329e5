// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/mesh/mesh.hpp>

// Milling: a workpiece less a tool at thousands of poses, one after the other, exactly.
//
// Each step subtracts the tool at one pose. It costs what the tool touches: the tool's own tree, and the cells where
// both have faces; the rest of the workpiece is shared with the version before. Old versions and the tools' nodes are
// garbage; when it outweighs what is alive, the workpiece moves to a store of its own. So memory is bounded, and the
// cost of moving, spread over the steps that made the garbage, too.
//
// The tool stands at the poses and does not sweep between them; poses as close as the surface wants to be smooth are
// the caller's business. Every pose rounds the tool's vertices to the workpiece's lattice, once. That lattice holds the
// workpiece and the tool wherever they come near each other; poses far away, where the tool moves aside, say, do not
// make it coarser. A workpiece that is an octree already stays on its own, and nothing of it is rounded.

namespace octavo::bsp_octree {

struct MillOptions {
    Options octree;  ///< of the workpiece's tree, where that is built
    /// Garbage collection starts when the store has this many times the bytes of the workpiece after the last one.
    double most_garbage = 3;
};

struct MillStep {
    std::uint64_t number = 0;  ///< from 0
    double seconds = 0;        ///< CPU time of this thread
    const BspOctree& solid;    ///< the workpiece after the step
    std::span<const octree::Cell> changed;
};

struct MillReport {
    std::uint64_t steps = 0;
    std::uint64_t cutting_steps = 0;   ///< that took something away
    std::uint64_t collections = 0;     ///< of garbage
    double build_seconds = 0;          ///< CPU time of making the workpiece's tree
    std::vector<double> step_seconds;  ///< CPU time by step, collections included
    double largest_displacement = 0;   ///< of the workpiece's vertices, by snapping, in world units
    std::vector<std::string> warnings;
};

struct Milled {
    BspOctree solid;
    MillReport report;
};

using OnMillStep = std::function<void(const MillStep&)>;

/// The workpiece without the tool at all poses. `on_step`, if any, is called after each.
/// Errors: those of building, of operand 0 for the workpiece and operand 1 for the tool; bad_input for a pose that
/// makes the tool's coordinates not finite; cancelled.
Result<Milled> mill(const mesh::Mesh& work, const mesh::Mesh& tool, std::span<const Affine> poses,
                    const MillOptions& options = {}, const Context& context = {},
                    const OnMillStep& on_step = {});

/// The same of an octree, on its lattice, which must have room for the tool, and in its store.
Result<Milled> mill(const BspOctree& work, const mesh::Mesh& tool, std::span<const Affine> poses,
                    const MillOptions& options = {}, const Context& context = {},
                    const OnMillStep& on_step = {});

/// Whether the octree's lattice has room for the tool at all poses at which it comes near the solid.
bool has_room(const BspOctree& work, const mesh::Mesh& tool, std::span<const Affine> poses);

}  // namespace octavo::bsp_octree
