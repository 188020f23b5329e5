// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <octavo/octree/oct_format.hpp>

// Any bytes are either refused or are exactly what the octree they give encodes to. A fuzzer seldom guesses a
// checksum, so every input is also tried with the right beginning and the right checksum.

namespace {

using Bytes = std::vector<std::uint8_t>;

void try_decode(const Bytes& bytes) {
    const octavo::Result<octavo::octree::Octree> octree = octavo::octree::decode(bytes);
    if (!octree) return;
    if (!octree->validate()) std::abort();
    octree->stats();
    if (octavo::octree::encode(*octree) != bytes) std::abort();
}

Bytes made_plausible(Bytes bytes) {
    static const Bytes model = octavo::octree::encode({});
    std::copy(model.begin(), model.begin() + 12, bytes.begin());
    std::fill(bytes.begin() + 20, bytes.begin() + 24, 0);
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const std::uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xEDB88320U : crc >> 1;
    }
    for (std::size_t i = 0; i < 4; ++i) bytes[20 + i] = static_cast<std::uint8_t>(~crc >> (8 * i));
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes(data, data + size);
    try_decode(bytes);
    if (size >= 64) try_decode(made_plausible(bytes));
    return 0;
}
