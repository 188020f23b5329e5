// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>

// A file or standard input from the front, piece by piece: for formats that are read without having them in memory
// whole, and from pipes that are still being written to.

namespace octavo::io {

class InputStream {
  public:
    /// Opens the file `path`, or standard input when it is "-". Of a pipe this waits for a writer. Errors:
    /// io, with the system's reason; cancelled.
    static Result<InputStream> open(const std::string& path, const Context& context = {});

    InputStream(InputStream&& other) noexcept;
    InputStream& operator=(InputStream&&) = delete;
    ~InputStream();

    /// Fills the front of `room`, waiting until there is something, and returns how many bytes; 0 at the end. `room` is
    /// not empty. Errors: io, cancelled.
    Result<std::size_t> read(std::span<std::byte> room, const Context& context = {});

    /// The size of a file, as far as the system knows it; 0 for pipes.
    std::size_t expected_size() const { return expected_size_; }

  private:
    InputStream(int descriptor, std::size_t expected_size)
        : descriptor_(descriptor), expected_size_(expected_size) {}

    int descriptor_;
    std::size_t expected_size_;
};

}  // namespace octavo::io
