// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/octree/oct_format.hpp>

namespace octavo::octree {
namespace {

// As in PNG: a byte that is no text, the name, and both line ends, so that a transfer in text mode shows at once.
constexpr std::array<std::uint8_t, 8> magic{0x89, 'O', 'C', 'T', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t version = 1;

// Byte offsets of the header's fields; all integers are little-endian.
constexpr std::size_t version_at = 8, depth_at = 12, exponent_at = 16, checksum_at = 20, origin_at = 24,
                      nodes_at = 48, reserved_at = 56, header_bytes = 64;

Error refuse(std::string sentence, std::size_t byte) {
    Error error{ErrorCode::bad_input, std::move(sentence), {}};
    error.place.byte = byte;
    return error;
}

/// The DF code after the header; the byte count has been tested against `nodes`.
Result<DfCode> read_code(std::span<const std::uint8_t> bytes, std::uint64_t nodes) {
    std::vector<std::uint64_t> words((bytes.size() + 7) / 8, 0);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        words[i / 8] |= static_cast<std::uint64_t>(bytes[i]) << (8 * (i % 8));
    return DfCode::from_words(std::move(words), static_cast<std::size_t>(nodes));
}

}  // namespace

bool looks_like_oct(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::vector<std::uint8_t> encode(const Octree& octree) {
    const DfCode& code = octree.code();
    std::vector<std::uint8_t> bytes(header_bytes + (code.size() + 3) / 4, 0);
    std::copy(magic.begin(), magic.end(), bytes.begin());
    store(&bytes[version_at], version);
    store(&bytes[depth_at], static_cast<std::uint32_t>(octree.depth()));
    store(&bytes[exponent_at], static_cast<std::int32_t>(octree.lattice().exponent()));
    for (std::size_t axis = 0; axis < 3; ++axis)
        store(&bytes[origin_at + 8 * axis], octree.lattice().origin()[axis]);
    store(&bytes[nodes_at], static_cast<std::uint64_t>(code.size()));
    for (std::size_t i = header_bytes; i < bytes.size(); ++i) {
        const std::size_t offset = i - header_bytes;
        bytes[i] = static_cast<std::uint8_t>(code.words()[offset / 8] >> (8 * (offset % 8)));
    }
    store(&bytes[checksum_at], crc32_around(bytes, checksum_at));
    return bytes;
}

Result<Octree> decode(std::span<const std::uint8_t> bytes) {
    if (!looks_like_oct(bytes)) return refuse("this is no .oct file: it does not begin like one", 0);
    if (bytes.size() < header_bytes)
        return refuse("the .oct file ends inside its header of 64 bytes", bytes.size());
    const std::uint32_t file_version = load<std::uint32_t>(&bytes[version_at]);
    if (file_version != version) {
        Error error = refuse(
            "the .oct file has version " + std::to_string(file_version) + "; this program knows version 1",
            version_at);
        error.code = ErrorCode::unsupported;
        return error;
    }
    const std::uint64_t nodes = load<std::uint64_t>(&bytes[nodes_at]);
    const std::uint64_t code_bytes = bytes.size() - header_bytes;
    if (nodes / 4 + (nodes % 4 != 0) != code_bytes)
        return refuse("the .oct file claims " + std::to_string(nodes) + " nodes but holds " +
                          std::to_string(code_bytes) + " bytes of them, four to a byte",
                      nodes_at);
    if (load<std::uint32_t>(&bytes[checksum_at]) != crc32_around(bytes, checksum_at))
        return refuse("the .oct file is damaged: its checksum does not agree", checksum_at);
    if (load<std::uint64_t>(&bytes[reserved_at]) != 0)
        return refuse("the reserved bytes of the .oct header are not zero", reserved_at);
    const std::uint32_t depth = load<std::uint32_t>(&bytes[depth_at]);
    if (depth > max_level)
        return refuse("the depth of the octree is " + std::to_string(depth) + ", not in 0 to 21", depth_at);

    std::array<std::int64_t, 3> origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
        origin[axis] = load<std::int64_t>(&bytes[origin_at + 8 * axis]);
    Result<exact::Lattice> lattice =
        exact::Lattice::from_parts(load<std::int32_t>(&bytes[exponent_at]), origin);
    if (!lattice) return refuse(lattice.error().sentence, exponent_at);

    Result<DfCode> code = read_code(bytes.subspan(header_bytes), nodes);
    if (!code) return refuse(code.error().sentence, header_bytes);
    Result<Octree> octree = Octree::from_untrusted(*lattice, static_cast<int>(depth), std::move(*code));
    if (!octree) return refuse(octree.error().sentence, header_bytes);
    return octree;
}

}  // namespace octavo::octree
