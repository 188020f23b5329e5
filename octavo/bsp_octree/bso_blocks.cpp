// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bsp_octree/bso_blocks.hpp>

namespace octavo::bsp_octree {
namespace {

// In the memory of a block: the checksum before it, its length, its bytes, its checksum.
constexpr std::size_t length_at = block_checksum_bytes, bytes_at = length_at + block_length_bytes;

void append_number(std::vector<std::uint8_t>& bytes, std::uint32_t number) {
    bytes.resize(bytes.size() + sizeof number);
    store(bytes.data() + bytes.size() - sizeof number, number);
}

}  // namespace

BlockWriter::BlockWriter(ByteSink sink, std::span<const std::uint8_t> header) : sink_(std::move(sink)) {
    block_.reserve(bytes_at + most_block_bytes + block_checksum_bytes);
    sink_(header);
    append_number(block_, crc32_of(header));
    sink_(block_);
    append_number(block_, 0);
}

void BlockWriter::put(std::uint32_t value, int count) {
    pending_ |= std::uint64_t{value} << used_;
    used_ += count;
    while (used_ >= 8) {
        block_.push_back(static_cast<std::uint8_t>(pending_));
        pending_ >>= 8;
        used_ -= 8;
        if (block_.size() == bytes_at + most_block_bytes) end_block();
    }
}

void BlockWriter::finish() {
    if (used_ > 0) put(0, 8 - used_);
    if (block_.size() > bytes_at) end_block();
}

void BlockWriter::end_block() {
    store(&block_[length_at], static_cast<std::uint32_t>(block_.size() - bytes_at));
    const std::uint32_t checksum = crc32_of(block_);
    append_number(block_, checksum);
    sink_(std::span<const std::uint8_t>(block_).subspan(length_at));
    store(block_.data(), checksum);
    block_.resize(bytes_at);
}

BlockReader::BlockReader(const ByteSource& source, const Context& context)
    : source_(source), context_(context), block_(bytes_at + most_block_bytes + block_checksum_bytes) {}

void BlockReader::fail(Error error) {
    if (!error_) error_ = std::move(error);
}

void BlockReader::fail(std::string sentence, std::uint64_t byte) {
    Error error{ErrorCode::bad_input, std::move(sentence), {}};
    error.place.byte = byte;
    fail(std::move(error));
}

/// Reads `size` bytes to block_[from] on, or fewer when there are no more, and returns how many.
std::size_t BlockReader::fill(std::size_t from, std::size_t size) {
    std::size_t got = 0;
    while (got < size && !failed()) {
        const Result<std::size_t> more = source_(std::span(block_).subspan(from + got, size - got));
        if (!more)
            fail(more.error());
        else if (*more == 0)
            break;
        else
            got += *more;
    }
    return got;
}

std::span<const std::uint8_t> BlockReader::header(std::size_t size) {
    const std::size_t got = fill(0, size);
    if (got == size) begin_ = next_ = end_ = size - block_checksum_bytes;
    return {block_.data(), got};
}

void BlockReader::check_header() {
    if (load<std::uint32_t>(&block_[end_]) != crc32_of({block_.data(), end_}))
        fail("the .bso file is damaged: the checksum of its header does not agree", end_);
}

void BlockReader::next_block() {
    if (failed()) return;
    if (context_.cancelled()) return fail(Context::cancelled_error());
    if (is_last_) return fail("the .bso file ends inside its tree", block_at_ + end_ + block_checksum_bytes);
    // The next block begins, as here, with the checksum of the one before.
    block_at_ += end_;
    std::copy_n(block_.begin() + static_cast<std::ptrdiff_t>(end_), block_checksum_bytes, block_.begin());
    begin_ = next_ = end_ = bytes_at;
    const std::uint64_t at = block_at_ + length_at;
    const std::size_t length_bytes = fill(length_at, block_length_bytes);
    if (failed()) return;
    if (length_bytes < block_length_bytes)
        return fail("the .bso file ends inside its tree", at + length_bytes);
    const auto length = load<std::uint32_t>(&block_[length_at]);
    if (length == 0 || length > most_block_bytes)
        return fail("a block of the .bso file does not have 1 to 16384 bytes, but " + std::to_string(length),
                    at);
    const std::size_t got = fill(bytes_at, length + block_checksum_bytes);
    if (failed()) return;
    if (got < length + block_checksum_bytes)
        return fail("the .bso file ends inside a block", at + block_length_bytes + got);
    if (load<std::uint32_t>(&block_[bytes_at + length]) != crc32_of({block_.data(), bytes_at + length}))
        return fail("the .bso file is damaged: the checksum of the block from here on does not agree", at);
    is_last_ = length < most_block_bytes;
    end_ = bytes_at + length;
}

void BlockReader::finish() {
    if (failed()) return;
    std::uint8_t* const spare = block_.data();
    if (next_ != end_ || pending_ != 0) return fail("the .bso file goes on after its tree");
    const std::uint64_t end = block_at_ + end_ + block_checksum_bytes;
    const Result<std::size_t> more = source_({spare, 1});
    if (!more) return fail(more.error());
    if (*more != 0) fail("the .bso file goes on after its tree", end);
}

}  // namespace octavo::bsp_octree
