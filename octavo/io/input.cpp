// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <octavo/io/input.hpp>

namespace octavo::io {
namespace {

// Large enough that system calls cost nothing, small enough that cancelling is quick.
constexpr std::size_t read_step = std::size_t{1} << 24;

Error system_error(const char* what) {
    return {ErrorCode::io, std::string(what) + ": " + std::strerror(errno), {}};
}

/// What was read of standard input, which cannot be put back into a pipe.
struct Beginning {
    std::array<std::byte, 8> bytes;
    std::size_t size = 0;
    bool is_read = false, is_delivered = false;
};

Beginning& stdin_beginning() {
    static Beginning beginning;
    return beginning;
}

/// Reads until the end; `expected` is a guess of the size that need not be right (pipes say 0). The block begins with
/// `begin`, bytes that were read before.
Result<ByteBlock> read_all(int descriptor, std::size_t expected, const Context& context, Bytes begin = {}) {
    ByteBlock block(begin.size() + expected + 1);
    std::copy(begin.begin(), begin.end(), block.data());
    std::size_t filled = begin.size();
    for (;;) {
        if (context.cancelled()) return Context::cancelled_error();
        if (filled == block.size()) {
            ByteBlock larger(std::max<std::size_t>(2 * block.size(), 1 << 16));
            std::memcpy(larger.data(), block.data(), filled);
            block = std::move(larger);
        }
        const ssize_t got =
            ::read(descriptor, block.data() + filled, std::min(read_step, block.size() - filled));
        if (got == 0) break;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return system_error("cannot be read");
        filled += static_cast<std::size_t>(got);
    }
    block.shrink(filled);
    return block;
}

/// Closes what it opened.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) ::close(number);
    }
};

Result<ByteBlock> read_stdin(const Context& context) {
    Beginning& beginning = stdin_beginning();
    if (beginning.is_delivered) return read_all(STDIN_FILENO, 0, context);
    beginning.is_delivered = true;
    return read_all(STDIN_FILENO, 0, context, Bytes(beginning.bytes.data(), beginning.size));
}

Result<ByteBlock> read_file(const std::string& path, const Context& context) {
    if (path == "-") return read_stdin(context);

    const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    struct stat status {};
    if (file.number < 0) return system_error("cannot be opened");
    if (::fstat(file.number, &status) != 0) return system_error("cannot be read");
    if (S_ISDIR(status.st_mode)) return Error{ErrorCode::io, "is a folder, not a file", {}};
    return read_all(file.number, S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) : 0,
                    context);
}

}  // namespace

Bytes beginning_of_stdin() {
    Beginning& beginning = stdin_beginning();
    while (!beginning.is_read && !beginning.is_delivered && beginning.size < beginning.bytes.size()) {
        const ssize_t got = ::read(STDIN_FILENO, beginning.bytes.data() + beginning.size,
                                   beginning.bytes.size() - beginning.size);
        if (got < 0 && errno == EINTR) continue;
        // An error is told to who reads the rest.
        if (got <= 0) break;
        beginning.size += static_cast<std::size_t>(got);
    }
    beginning.is_read = true;
    return {beginning.bytes.data(), beginning.size};
}

Result<ByteBlock> read_bytes(const std::string& path, const Context& context) try {
    Result<ByteBlock> result = read_file(path, context);
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
