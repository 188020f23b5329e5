// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <new>

#include <octavo/io/input.hpp>
#include <octavo/io/input_stream.hpp>

namespace octavo::io {
namespace {

// Large enough that system calls cost nothing, small enough that cancelling is quick.
constexpr std::size_t read_step = std::size_t{1} << 24;

Result<ByteBlock> read_all(const std::string& path, const Context& context) {
    Result<InputStream> stream = InputStream::open(path, context);
    if (!stream) return std::move(stream).error();
    ByteBlock block(stream->expected_size() + 1);  // a guess, but for the byte that finds the end
    std::size_t filled = 0;
    for (;;) {
        if (filled == block.size()) {
            ByteBlock larger(std::max<std::size_t>(2 * block.size(), 1 << 16));
            std::memcpy(larger.data(), block.data(), filled);
            block = std::move(larger);
        }
        const Result<std::size_t> got =
            stream->read({block.data() + filled, std::min(read_step, block.size() - filled)}, context);
        if (!got) return got.error();
        if (*got == 0) break;
        filled += *got;
    }
    block.shrink(filled);
    return block;
}

}  // namespace

Result<ByteBlock> read_bytes(const std::string& path, const Context& context) try {
    Result<ByteBlock> result = read_all(path, context);
    if (result) return result;
    Error error = std::move(result).error();
    error.place.file = path;
    return error;
} catch (const std::bad_alloc&) {
    Error error{ErrorCode::limit, "does not fit into memory", {}};
    error.place.file = path;
    return error;
}

}  // namespace octavo::io
