// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include <octavo/base/result.hpp>
#include <octavo/io/input.hpp>

// Parts of a file, for formats that are made to be read in parts. They are read rather than mapped: another program
// that shortens a mapped file kills its readers with SIGBUS, and here it is an error. One thread at a time.

namespace octavo::io {

class RangeReader {
  public:
    /// Errors: io when the system refuses.
    static Result<RangeReader> open(const std::string& path);

    std::uint64_t size() const { return size_; }
    /// Errors: bad_input when the file ends before, io when the system refuses.
    Result<ByteBlock> read(std::uint64_t offset, std::size_t size);

  private:
    RangeReader() = default;
    std::string path_;
    std::ifstream file_;
    std::uint64_t size_ = 0;
};

}  // namespace octavo::io
