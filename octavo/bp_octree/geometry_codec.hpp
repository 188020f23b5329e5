// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Triangles on the lattice in few bits, without loss: connectivity by growing a region edge by edge, vertices as
// differences from a parallelogram.
//
// A queue holds the open edges of what is coded so far. The next open edge either has a triangle on its other side or
// not (one bit); the third corner of that triangle is a new vertex, the far end of the boundary edge after or before
// it, or any vertex by number (two bits and the number). A new vertex is foretold as the corner of the parallelogram
// over the last triangle, and the error is Rice-coded. When the queue is empty and triangles remain, one is coded by
// its three vertices. Nothing asks for a manifold: a triangle that no open edge leads to starts a region of its own.
// About 3.3 bits a triangle for connectivity and 45 to 55 a vertex for scanned models on 26-bit coordinates.
//
// Sources: S. Gumhold and W. Straßer, Real time compression of triangle mesh connectivity, 1998 (cut-border); C.
// Touma and C. Gotsman, Triangle mesh compression, 1998 (parallelograms); R. Rice, 1979. Departures: a queue instead
// of a stack keeps the region round, so that the neighbours on the border are foretold well; no split offsets.

namespace octavo::bp_octree {

/// Triangles and the order in which they are coded; vertices are numbered in order of appearance.
struct CodedGeometry {
    std::vector<std::uint8_t> bytes;
    std::vector<std::uint32_t> order;  ///< order[i]: the number, in the input, of the i-th coded triangle
};

/// Codes `triangles`, corners into `points`. Corners keep their cyclic order, not which comes first.
CodedGeometry encode_geometry(std::span<const exact::Point> points,
                              std::span<const mesh::Triangle> triangles);

struct DecodedGeometry {
    std::vector<exact::Point> points;
    std::vector<mesh::Triangle> triangles;
};

/// The inverse. Errors: bad_input when the bytes are not what encode_geometry makes of `triangles` triangles.
Result<DecodedGeometry> decode_geometry(std::span<const std::uint8_t> bytes, std::size_t triangles);

}  // namespace octavo::bp_octree
