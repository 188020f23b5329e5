// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "round_trip.hpp"

// What fuzzers of TetGen's formats do: what was read is sound and can be written, and what of that can be read is sound
// again. It need not be the same: coplanar faces were merged, and where a surface crosses or touches itself the merged
// ones may be no facets by the reader's rules. That solids survive is tested in io/tetgen_test.cpp.

namespace octavo::fuzz {

inline void read_write_read_boundary(const std::uint8_t* data, std::size_t size, const char* format) {
    const io::ReadOptions options{.format = format};
    const Result<io::ReadMesh> first = read_soundly(data, size, options);
    if (!first) return;
    const Result<io::WrittenBytes> written = io::write_mesh(first->mesh, {.format = format});
    OCTAVO_CHECK(written.has_value(), "what was read can be written");
    const Result<io::ReadMesh> second = io::read_mesh(written->bytes, options);
    if (second) check_sound(*second);
}

}  // namespace octavo::fuzz
