// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/output.hpp>

// The part of ZIP (PKWARE, APPNOTE.TXT, 2022) that 3MF needs: entries stored or deflated, found through the
// central directory at the end, whose sizes are right also where the local headers leave them to data
// descriptors. Zip64, encryption, split archives and other methods are refused by name.
//
// Nothing is believed: an entry is unpacked in steps and may not grow beyond the size that the directory
// states, nor beyond the caller's limit, and its checksum must be right.

namespace octavo::io {

struct ZipEntry {
    std::string name;
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
    std::uint32_t checksum = 0;
    std::uint32_t packed_size = 0;
    std::uint32_t size = 0;
    std::uint32_t local_header = 0;  ///< offset in the file
};

class ZipReader {
  public:
    /// Reads the directory of an archive, which must outlive the reader.
    static Result<ZipReader> open(Bytes archive);

    const std::vector<ZipEntry>& entries() const { return entries_; }

    /// The entry of that name, compared as OPC does, without regard to ASCII case and to a leading slash;
    /// nullptr when there is none.
    const ZipEntry* find(std::string_view name) const;

    /// Unpacks an entry of at most `limit` bytes.
    Result<std::vector<std::byte>> read(const ZipEntry& entry, std::uint64_t limit) const;

  private:
    explicit ZipReader(Bytes archive) : archive_(archive) {}
    Status read_directory();
    Result<Bytes> packed(const ZipEntry& entry) const;

    Bytes archive_;
    std::vector<ZipEntry> entries_;
    std::unordered_map<std::string, std::size_t> entry_of_name_;  ///< by names as `find` compares them
};

/// Appends an archive to an output, entry by entry; the same entries always give the same bytes.
class ZipWriter {
  public:
    explicit ZipWriter(Output& output) : output_(output), begin_(output.size()) {}

    /// Adds a deflated entry. Fails with ErrorCode::limit beyond 4 GiB, where Zip64 would begin.
    Status add(std::string_view name, std::string_view content);
    /// Writes the directory; nothing may follow.
    Status finish();

  private:
    void append_fields(const ZipEntry& entry);

    Output& output_;
    std::uint64_t begin_;
    std::vector<ZipEntry> entries_;
};

}  // namespace octavo::io
