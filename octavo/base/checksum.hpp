// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

// CRC-32 as in zlib and PNG, which every file format of Octavo carries.

namespace octavo {

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes);

/// The checksum of bytes that hold it themselves: the four at `own` are taken as zero. At least `own` + 4 bytes.
std::uint32_t crc32_around(std::span<const std::uint8_t> bytes, std::size_t own);

}  // namespace octavo
