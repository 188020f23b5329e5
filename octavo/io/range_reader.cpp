// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <cstring>

#include <octavo/io/range_reader.hpp>

namespace octavo::io {
namespace {

Error failure(const std::string& path, const char* what) {
    Error error{ErrorCode::io, std::string(what) + ": " + std::strerror(errno), {}};
    error.place.file = path;
    return error;
}

}  // namespace

Result<RangeReader> RangeReader::open(const std::string& path) {
    RangeReader reader;
    reader.path_ = path;
    errno = 0;
    reader.file_.open(path, std::ios::binary | std::ios::ate);
    if (!reader.file_) return failure(path, "cannot be opened");
    const std::streamoff end = reader.file_.tellg();
    if (end < 0) return failure(path, "cannot be read in parts");
    reader.size_ = static_cast<std::uint64_t>(end);
    return reader;
}

Result<ByteBlock> RangeReader::read(std::uint64_t offset, std::size_t size) {
    const auto ends_early = [&] {
        Error error{ErrorCode::bad_input, "the file ends early", {}};
        error.place.file = path_;
        error.place.byte = size_;
        return error;
    };
    if (offset > size_ || size > size_ - offset) return ends_early();
    ByteBlock block(size);
    errno = 0;
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(size));
    if (file_.gcount() == static_cast<std::streamsize>(size)) return block;
    return file_.bad() ? failure(path_, "cannot be read") : ends_early();
}

}  // namespace octavo::io
