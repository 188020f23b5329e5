// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/octree/octree.hpp>

// The bytes of a .oct file: a 64-byte header and the DF code, four nodes a byte; docs/formats/oct.md describes
// them bit by bit. A file is either exactly what `encode` writes or it is refused: counts, lengths, unused bits,
// the checksum and the shape of the tree are all tested before an Octree exists, and nothing is allocated on the
// word of a count alone.

namespace octavo::octree {

/// The file's bytes. The same octree always gives the same bytes, on every machine.
std::vector<std::uint8_t> encode(const Octree& octree);

/// The octree in a file's bytes. Errors: bad_input (with the byte where that makes sense); unsupported for a
/// version that this library does not know.
Result<Octree> decode(std::span<const std::uint8_t> bytes);

/// True when the bytes begin like a .oct file.
bool looks_like_oct(std::span<const std::uint8_t> bytes);

}  // namespace octavo::octree
