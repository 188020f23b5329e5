// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/io/output.hpp>

// The arrays of a VTK XML file in its appended section, raw and compressed by zlib (VTK User's Guide 11, "VTK
// XML file formats", 2010; header_type UInt64). The elements of the file name them by offset, so the arrays are
// compressed first, one after the other and a block at a time, and the XML is written when all are known.

namespace octavo::io {

class VtkAppendedData {
  public:
    /// Begins an array and returns its offset, for the attribute `offset`.
    std::uint64_t begin_array();
    /// Adds a value to the array.
    template <class T>
    void add(T value) {
        const std::size_t at = block_.size();
        block_.resize(at + sizeof value);
        store(block_.data() + at, value);
        if (block_.size() >= block_size) compress_block();
    }
    /// Ends the array.
    void end_array();

    /// The attributes of the element VTKFile that say how all this is stored.
    static std::string_view file_attributes();

    /// Writes the element AppendedData.
    void write(Output& output) const;

  private:
    // As VTK's writers do: larger blocks compress no better, smaller ones cost 8 bytes each. All values have 1,
    // 2, 4 or 8 bytes, so that blocks end between values.
    static constexpr std::size_t block_size = std::size_t{1} << 15;

    void compress_block();

    std::vector<std::byte> block_;
    std::vector<std::byte> body_;                  ///< compressed blocks of the present array
    std::vector<std::uint64_t> compressed_sizes_;  ///< of them
    std::uint64_t last_block_ = 0;                 ///< its size when it is not full
    std::vector<std::byte> finished_;              ///< arrays with their headers
};

}  // namespace octavo::io
