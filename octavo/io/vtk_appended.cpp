// SPDX-License-Identifier: Apache-2.0
#include <zlib.h>

#include <octavo/base/check.hpp>
#include <octavo/io/vtk_appended.hpp>

namespace octavo::io {

std::uint64_t VtkAppendedData::begin_array() {
    block_.clear();
    block_.reserve(block_size);
    body_.clear();
    compressed_sizes_.clear();
    last_block_ = 0;
    return finished_.size();
}

void VtkAppendedData::compress_block() {
    uLongf size = compressBound(block_.size());
    const std::size_t at = body_.size();
    body_.resize(at + size);
    // Level 1: these arrays are regular, and higher levels gain little for several times the time.
    const int status = compress2(reinterpret_cast<Bytef*>(body_.data() + at), &size,
                                 reinterpret_cast<const Bytef*>(block_.data()), block_.size(), 1);
    OCTAVO_CHECK(status == Z_OK, "zlib compresses into a large enough buffer");
    body_.resize(at + size);
    compressed_sizes_.push_back(size);
    block_.clear();
}

void VtkAppendedData::end_array() {
    if (!block_.empty()) {
        last_block_ = block_.size();
        compress_block();
    }
    const auto append = [&](std::uint64_t value) {
        const std::size_t at = finished_.size();
        finished_.resize(at + sizeof value);
        store(finished_.data() + at, value);
    };
    append(compressed_sizes_.size());
    append(block_size);
    append(last_block_);
    for (const std::uint64_t size : compressed_sizes_) append(size);
    finished_.insert(finished_.end(), body_.begin(), body_.end());
}

std::string_view VtkAppendedData::file_attributes() {
    return "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
           "compressor=\"vtkZLibDataCompressor\"";
}

void VtkAppendedData::write(Output& output) const {
    output.append("<AppendedData encoding=\"raw\">\n_");
    output.append(finished_);
    output.append("\n</AppendedData>\n");
}

}  // namespace octavo::io
