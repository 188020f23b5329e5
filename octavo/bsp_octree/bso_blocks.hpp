// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>

// Bits in a sequence of blocks, each with its checksum, written and read strictly from the front.
//
// The header is the first block, and has a size that both sides know. Every other block is its length, the bytes that
// hold its bits, and a checksum over both and over the checksum before, so that a block that is missing or in a wrong
// place is noticed as one that is damaged is. All blocks are full but the last: the same bits are the same bytes.
// Nothing is delivered of a block before its checksum was tested, and nothing but the block at hand is in memory.

namespace octavo::bsp_octree {

/// Takes bytes in the order of the file.
using ByteSink = std::function<void(std::span<const std::uint8_t>)>;

/// Fills the front of the room it is given, which is not empty, and returns how many bytes; 0 at the end.
using ByteSource = std::function<Result<std::size_t>(std::span<std::uint8_t>)>;

/// Bytes of bits in a block. A reader waits for a whole one, so a picture that grows wants them small; the eight bytes
/// around them are a twentieth of a percent.
constexpr std::size_t most_block_bytes = std::size_t{1} << 14;
constexpr std::size_t block_length_bytes = 4, block_checksum_bytes = 4;

class BlockWriter {
  public:
    BlockWriter(ByteSink sink, std::span<const std::uint8_t> header);

    /// Appends the lowest `count` bits, 0 to 32.
    void put(std::uint32_t value, int count);
    /// Fills up the last byte with zeros and gives the sink what is left.
    void finish();

  private:
    void end_block();

    ByteSink sink_;
    std::vector<std::uint8_t> block_;  ///< the checksum before, room for the length, and the bytes
    std::uint64_t pending_ = 0;
    int used_ = 0;
};

/// Reads until something is wrong: from there on all bits are zero, and `error` says what and where.
class BlockReader {
  public:
    explicit BlockReader(const ByteSource& source, const Context& context);

    /// The header, of `size` bytes with its checksum; once, first. Fewer bytes when there are no more.
    std::span<const std::uint8_t> header(std::size_t size);
    /// The header's checksum, or an error.
    void check_header();

    /// The next `count` bits, 0 to 32.
    std::uint32_t get(int count) {
        while (filled_ < count) {
            if (next_ == end_) next_block();
            pending_ |= std::uint64_t{next_ == end_ ? std::uint8_t{0} : block_[next_++]} << filled_;
            filled_ += 8;
        }
        const auto value = static_cast<std::uint32_t>(pending_ & ((std::uint64_t{1} << count) - 1));
        pending_ >>= count;
        filled_ -= count;
        return value;
    }

    /// Tests that the bits that fill up the last byte are zeros and that nothing follows.
    void finish();

    /// Where in the file the bits are that `get` delivered last.
    std::uint64_t byte() const { return block_at_ + next_ - (next_ > begin_ ? 1 : 0); }

    bool failed() const { return error_.has_value(); }
    const Error& error() const { return *error_; }
    /// Remembers the first error; `fail(sentence)` that of the bits that were delivered last.
    void fail(Error error);
    void fail(std::string sentence) { fail(std::move(sentence), byte()); }
    void fail(std::string sentence, std::uint64_t byte);

  private:
    std::size_t fill(std::size_t from, std::size_t size);
    void next_block();

    const ByteSource& source_;
    const Context& context_;
    std::vector<std::uint8_t> block_;             ///< the checksum before, then as in the file
    std::uint64_t block_at_ = 0;                  ///< what block_[0] is in the file
    std::size_t next_ = 0, end_ = 0, begin_ = 0;  ///< in block_: of the bytes that hold bits
    std::uint64_t pending_ = 0;
    int filled_ = 0;
    bool is_last_ = false;
    std::optional<Error> error_;
};

}  // namespace octavo::bsp_octree
