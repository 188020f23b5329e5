// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/octree/octree.hpp>

// Leaves of an octree as an unstructured grid of hexahedra (.vtu), for ParaView and everything else that reads
// VTK's files. Corners are shared, so leaves of one size are joined as a conforming mesh and leaves of two
// sizes meet in hanging nodes; the corners of hexahedra go round the bottom, then round the top. Cell data:
// `color` (0 white, 1 black, 2 gray) and `level`. Coordinates are exact doubles.
//
// Costs about 40 bytes a leaf in the file. For millions of leaves hyper_tree_grid.hpp is smaller by far.

namespace octavo::io {

/// Which leaves become cells.
struct LeafChoice {
    bool white = false;
    bool black = true;
    bool gray = true;

    bool takes(octree::Color color) const {
        return color == octree::Color::white ? white : color == octree::Color::black ? black : gray;
    }
};

/// Writes the chosen leaves to the file `path`, or to standard output when it is "-".
Result<WriteReport> write_vtu(const std::string& path, const octree::Octree& octree,
                              const LeafChoice& choice = {}, const Context& context = {});

}  // namespace octavo::io
