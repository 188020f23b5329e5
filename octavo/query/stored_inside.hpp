// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/bp_octree/bpo_reader.hpp>
#include <octavo/query/inside.hpp>

// Inside, on or outside, answered from a .bpo file where it lies: each answer reads the few chunks that its place
// needs, and the first one comes within milliseconds. For thousands of points, decode the file and ask an InsideQuery.
//
// A leaf of a BP-octree knows the winding number at its low corner and the triangles that meet it, which is what
// leaf_test.hpp wants; only that its corners lie at half-integers of the lattice. So the test runs on a lattice of half
// the unit, where coordinates have 27 bits: normals 4 · 53 bits wide with two zeros at the end, still exact doubles;
// the products of coefficients (56 bits) and origins (54) fit int128.

namespace octavo::query {

class StoredInside {
  public:
    /// Errors: those of BpoReader::open; not_a_solid for a tree of an open surface; limit when it lies so far from
    /// the world's origin that half a unit has no name there.
    static Result<StoredInside> open(const std::string& path);
    static Result<StoredInside> open(std::unique_ptr<io::ByteSource> source);

    /// Where a point of the world lies; the same rules and answers as InsideQuery. Errors: bad_input, io.
    Result<Side> operator()(Vec3 point);

    /// So many bytes of the file have been read.
    std::uint64_t bytes_read() const { return reader_.bytes_read(); }

  private:
    StoredInside(bp_octree::BpoReader reader, exact::Lattice half)
        : reader_(std::move(reader)), half_(half), inverse_half_(1 / half.unit()) {}

    bp_octree::BpoReader reader_;
    exact::Lattice half_;
    double inverse_half_;
};

}  // namespace octavo::query
