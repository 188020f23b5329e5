// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>

// The whole of a file in memory. It is read rather than mapped: another program that shortens a mapped file
// kills its readers with SIGBUS, and the copy costs little beside parsing.

namespace octavo::io {

/// Owns bytes that were never initialised twice.
class ByteBlock {
  public:
    ByteBlock() = default;
    explicit ByteBlock(std::size_t size) : bytes_(new std::byte[size]), size_(size) {}

    std::byte* data() { return bytes_.get(); }
    std::size_t size() const { return size_; }
    void shrink(std::size_t size) { size_ = size; }
    Bytes bytes() const { return {bytes_.get(), size_}; }

  private:
    std::unique_ptr<std::byte[]> bytes_;
    std::size_t size_ = 0;
};

/// The first bytes of standard input, at most eight, as many as tell formats apart; fewer when it ends before. They are
/// not lost: who reads "-" later gets them too. Waits until they are there, or the context is cancelled. Not for two
/// threads at once.
Bytes beginning_of_stdin(const Context& context = {});

/// Reads the file `path` whole, or standard input when it is "-". Fails with ErrorCode::io when the system
/// refuses, with its reason.
Result<ByteBlock> read_bytes(const std::string& path, const Context& context = {});

}  // namespace octavo::io
