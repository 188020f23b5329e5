// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include <octavo/base/bytes.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/input.hpp>

// Bytes that are read in parts, for formats that are made to be: a file on disk, a file mapped into memory, bytes in
// memory, or what a caller derives, such as HTTP range requests. One thread at a time.
//
// A file is read or mapped. Mapped, nothing is copied and programs share its pages; but whoever shortens it in place
// kills its readers with SIGBUS, which no check can prevent. So reading is what Octavo itself does with files that it
// was given, and mapping is for files that the caller knows nobody touches (those that Octavo writes are replaced,
// never changed).

namespace octavo::io {

/// A part of a source: its own copy, or a view of the source's memory, good for as long as the source.
class ByteRange {
  public:
    explicit ByteRange(ByteBlock block) : block_(std::move(block)), bytes_(block_.bytes()) {}
    static ByteRange view(Bytes bytes) {
        ByteRange range{ByteBlock()};
        range.bytes_ = bytes;
        return range;
    }

    Bytes bytes() const { return bytes_; }
    std::span<const std::uint8_t> octets() const {
        return {reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size()};
    }

  private:
    ByteBlock block_;
    Bytes bytes_;
};

class ByteSource {
  public:
    virtual ~ByteSource() = default;

    /// How many bytes are there. Of a download, those that have arrived.
    virtual std::uint64_t size() const = 0;
    /// `size` bytes from `offset` on. Errors: bad_input when they are not there, io when the system refuses.
    virtual Result<ByteRange> read(std::uint64_t offset, std::size_t size) = 0;
    /// What errors call the source; empty when it has no name.
    virtual const std::string& name() const = 0;
};

/// Reads parts of a file. Errors: io when the system refuses, also for what cannot be read in parts, such as pipes.
Result<std::unique_ptr<ByteSource>> open_file(const std::string& path);

/// Maps a file; see above for when. Errors: io when the system refuses.
Result<std::unique_ptr<ByteSource>> map_file(const std::string& path);

/// Takes bytes that are in memory.
std::unique_ptr<ByteSource> source_of(ByteBlock block, std::string name = "");

}  // namespace octavo::io
