// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <zlib.h>

#include <octavo/base/check.hpp>
#include <octavo/octree/oct_format.hpp>

// Any bytes are refused with a sentence or are exactly what the writer would make of the octree in them. They
// are tried as they are and with the checksum put right, which random changes never do.

namespace {

void try_bytes(std::span<const std::uint8_t> bytes) {
    using namespace octavo;
    const Result<octree::Octree> octree = octree::decode(bytes);
    if (!octree) {
        OCTAVO_CHECK(!octree.error().sentence.empty(), "an error has a sentence");
        return;
    }
    OCTAVO_CHECK(octree->validate().has_value(), "what was read is a tree");
    const std::vector<std::uint8_t> again = octree::encode(*octree);
    OCTAVO_CHECK(std::equal(bytes.begin(), bytes.end(), again.begin(), again.end()),
                 "there is one file per octree");
    const octree::OctreeStats stats = octree->stats();
    OCTAVO_CHECK(stats.nodes() == octree->code().size(), "all nodes are counted");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t checksum_at = 20;
    try_bytes({data, size});
    if (size < 64) return 0;
    std::vector<std::uint8_t> mended(data, data + size);
    std::fill_n(mended.begin() + checksum_at, 4, std::uint8_t{0});
    const uLong checksum = crc32(crc32(0, nullptr, 0), mended.data(), static_cast<uInt>(mended.size()));
    for (std::size_t i = 0; i < 4; ++i)
        mended[checksum_at + i] = static_cast<std::uint8_t>(checksum >> (8 * i));
    try_bytes(mended);
    return 0;
}
