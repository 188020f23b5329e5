// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/vtu.hpp>
#include <octavo/io/write.hpp>
#include <octavo/octree/octree.hpp>

// A whole octree as a hyper tree grid (.htg), VTK's own form of octrees, as VTK 9.1 and ParaView 5.10 and later
// read it (version 1.0 of the format): one tree that is the universe, with a bit for each node that says
// whether it is split, level by level. A bit and a byte a node before compression, where an unstructured grid
// takes about a hundred bytes a leaf. Cell data: `color` (0 white, 1 black, 2 gray; split nodes are gray).
//
// Leaves that are not chosen are masked: they are there and not shown.

namespace octavo::io {

/// Writes the file `path`, or standard output when it is "-".
Result<WriteReport> write_hyper_tree_grid(const std::string& path, const octree::Octree& octree,
                                          const LeafChoice& choice = {}, const Context& context = {});

}  // namespace octavo::io
