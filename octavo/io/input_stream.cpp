// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <octavo/io/input.hpp>
#include <octavo/io/input_stream.hpp>

namespace octavo::io {
namespace {

Error system_error(const char* what) {
    return {ErrorCode::io, std::string(what) + ": " + std::strerror(errno), {}};
}

/// What was read of standard input, which cannot be put back into a pipe.
struct Beginning {
    std::array<std::byte, 8> bytes;
    std::size_t size = 0, delivered = 0;
    bool is_read = false;
};

Beginning& stdin_beginning() {
    static Beginning beginning;
    return beginning;
}

}  // namespace

Bytes beginning_of_stdin(const Context& context) {
    Beginning& beginning = stdin_beginning();
    while (!beginning.is_read && beginning.size < beginning.bytes.size()) {
        const ssize_t got = ::read(STDIN_FILENO, beginning.bytes.data() + beginning.size,
                                   beginning.bytes.size() - beginning.size);
        if (got < 0 && errno == EINTR && !context.cancelled()) continue;
        // An error is told to who reads the rest.
        if (got <= 0) break;
        beginning.size += static_cast<std::size_t>(got);
    }
    beginning.is_read = true;
    return {beginning.bytes.data(), beginning.size};
}

Result<InputStream> InputStream::open(const std::string& path, const Context& context) {
    if (path == "-") return InputStream(STDIN_FILENO, 0);
    int descriptor = -1;
    do {
        descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    } while (descriptor < 0 && errno == EINTR && !context.cancelled());
    if (descriptor < 0 && context.cancelled()) return Context::cancelled_error();
    if (descriptor < 0) return system_error("cannot be opened");
    InputStream stream(descriptor, 0);
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) return system_error("cannot be read");
    if (S_ISDIR(status.st_mode)) return Error{ErrorCode::io, "is a folder, not a file", {}};
    if (S_ISREG(status.st_mode)) stream.expected_size_ = static_cast<std::size_t>(status.st_size);
    return stream;
}

InputStream::InputStream(InputStream&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), expected_size_(other.expected_size_) {}

InputStream::~InputStream() {
    if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

Result<std::size_t> InputStream::read(std::span<std::byte> room, const Context& context) {
    if (descriptor_ == STDIN_FILENO) {
        Beginning& beginning = stdin_beginning();
        beginning.is_read = true;  // what comes now is not the beginning any more
        if (const std::size_t left = beginning.size - beginning.delivered; left > 0) {
            const std::size_t given = std::min(left, room.size());
            std::copy_n(beginning.bytes.data() + beginning.delivered, given, room.data());
            beginning.delivered += given;
            return given;
        }
    }
    for (;;) {
        // A signal that asks to stop interrupts a read that waits.
        if (context.cancelled()) return Context::cancelled_error();
        const ssize_t got = ::read(descriptor_, room.data(), room.size());
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno != EINTR) return system_error("cannot be read");
    }
}

}  // namespace octavo::io
