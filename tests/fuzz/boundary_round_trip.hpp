// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/snap.hpp>

#include "round_trip.hpp"

// What fuzzers of TetGen's formats do: what was read is sound, its triangles and its polygons are the same faces, and
// when it bounds a solid, writing and reading give that solid again, though faces may have been merged.

namespace octavo::fuzz {

inline void read_write_read_boundary(const std::uint8_t* data, std::size_t size, const char* format) {
    const io::ReadOptions options{.format = format};
    const Bytes bytes = bytes_of({reinterpret_cast<const char*>(data), size});
    const Result<io::ReadMesh> first = io::read_mesh(bytes, options);
    const Result<io::ReadPolygons> polygons = io::read_polygons(bytes, options);
    if (!first) {
        OCTAVO_CHECK(!first.error().sentence.empty(), "an error has a sentence");
        OCTAVO_CHECK(first.error().code != ErrorCode::internal, "bad bytes are not our defect");
        return;
    }
    check_sound(*first);
    OCTAVO_CHECK(polygons.has_value(), "what makes triangles makes polygons");
    OCTAVO_CHECK(polygons->mesh.corners.size() >= 3, "faces have corners");

    const Result<io::WrittenBytes> written = io::write_mesh(first->mesh, {.format = format});
    OCTAVO_CHECK(written.has_value(), "what was read can be written");
    // Merged faces of surfaces that cross or touch themselves may be no facets by the reader's rules.
    const Result<io::ReadMesh> second = io::read_mesh(written->bytes, options);
    if (!second) return;
    check_sound(*second);
}

}  // namespace octavo::fuzz
