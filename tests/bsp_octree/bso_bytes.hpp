// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

// `.bso` files taken apart and put together again, as docs/formats/bso.md says and without any of the library's code,
// so that lies can be told behind checksums that are right.

namespace octavo::tests {

using FileBytes = std::vector<std::uint8_t>;

constexpr std::size_t bso_header_bytes = 52, bso_block_bytes = 16384;

inline std::uint32_t slow_crc(std::span<const std::uint8_t> bytes) {
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    return ~crc;
}

inline std::uint32_t number_at(const FileBytes& bytes, std::size_t at) {
    return bytes[at] | bytes[at + 1] << 8 | bytes[at + 2] << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

inline void append_number(FileBytes& bytes, std::uint32_t number) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<std::uint8_t>(number >> 8 * i));
}

/// Header and bits of a file, without lengths and checksums.
struct BsoParts {
    FileBytes header, bits;
};

/// Of a file that is right.
inline BsoParts bso_parts(const FileBytes& file) {
    BsoParts parts{{file.begin(), file.begin() + bso_header_bytes}, {}};
    for (std::size_t at = bso_header_bytes + 4; at < file.size();) {
        const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at) + 4;
        const std::uint32_t length = number_at(file, at);
        parts.bits.insert(parts.bits.end(), begin, begin + length);
        at += length + 8;
    }
    return parts;
}

inline FileBytes bso_file(const BsoParts& parts) {
    FileBytes file = parts.header;
    append_number(file, slow_crc(file));
    for (std::size_t at = 0; at < parts.bits.size(); at += bso_block_bytes) {
        const std::size_t checked = file.size() - 4,
                          length = std::min(bso_block_bytes, parts.bits.size() - at);
        append_number(file, static_cast<std::uint32_t>(length));
        const auto begin = parts.bits.begin() + static_cast<std::ptrdiff_t>(at);
        file.insert(file.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
        append_number(file, slow_crc(std::span(file).subspan(checked)));
    }
    return file;
}

}  // namespace octavo::tests
