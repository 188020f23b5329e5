// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <utility>

#include <zlib.h>

#include <octavo/base/checksum.hpp>
#include <octavo/io/text_scanner.hpp>
#include <octavo/io/zip.hpp>

namespace octavo::io {
namespace {

constexpr std::uint32_t local_signature = 0x04034b50, directory_signature = 0x02014b50,
                        end_signature = 0x06054b50;
constexpr std::size_t local_size = 30, directory_size = 46, end_size = 22;
constexpr std::uint16_t stored = 0, deflated = 8;
constexpr std::uint16_t encrypted_flag = 1, names_are_utf8_flag = 1 << 11;
constexpr std::uint32_t in_zip64 = 0xffffffffu;
// DOS has no time before 1980; a fixed one keeps archives reproducible.
constexpr std::uint16_t first_of_january_1980 = 0x21;

std::uint16_t word_at(Bytes bytes, std::size_t at) { return load<std::uint16_t>(bytes.data() + at); }
std::uint32_t long_at(Bytes bytes, std::size_t at) { return load<std::uint32_t>(bytes.data() + at); }

Error damaged(std::size_t byte, std::string sentence) {
    Place place;
    place.byte = byte;
    return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
}

Error unsupported(std::string sentence) { return {ErrorCode::unsupported, std::move(sentence), {}}; }

/// Where the record at the archive's end begins, behind which there may be a comment.
std::optional<std::size_t> find_end(Bytes archive) {
    if (archive.size() < end_size) return {};
    const std::size_t last = archive.size() - end_size;
    const std::size_t first = last > 0xffff ? last - 0xffff : 0;
    for (std::size_t at = last + 1; at-- > first;)
        if (long_at(archive, at) == end_signature &&
            at + end_size + word_at(archive, at + 20) == archive.size())
            return at;
    return {};
}

/// Frees what inflateInit2 or deflateInit2 took.
struct Inflating {
    z_stream stream{};
    bool begun = inflateInit2(&stream, -MAX_WBITS) == Z_OK;
    Inflating() = default;
    Inflating(const Inflating&) = delete;
    Inflating& operator=(const Inflating&) = delete;
    ~Inflating() { inflateEnd(&stream); }
};
struct Deflating {
    z_stream stream{};
    bool begun =
        deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK;
    Deflating() = default;
    Deflating(const Deflating&) = delete;
    Deflating& operator=(const Deflating&) = delete;
    ~Deflating() { deflateEnd(&stream); }
};

Bytef* zlib_bytes(const void* bytes) { return static_cast<Bytef*>(const_cast<void*>(bytes)); }

// zlib counts in 32 bits.
constexpr std::size_t zlib_step = std::size_t{1} << 30;

/// The inflated bytes: exactly `size` of them, or nothing.
std::optional<std::vector<std::byte>> inflated(Bytes packed, std::size_t size) {
    Inflating inflating;
    if (!inflating.begun) return {};
    z_stream& stream = inflating.stream;
    std::vector<std::byte> result;
    // Grown as the bytes come, so that a lying size costs nothing.
    std::size_t filled = 0, taken = 0;
    for (;;) {
        if (filled == result.size()) {
            if (filled > size) return {};
            result.resize(std::min(size + 1, std::max<std::size_t>(2 * filled, 4 * packed.size() + 64)));
        }
        const std::size_t given = std::min(zlib_step, packed.size() - taken);
        const std::size_t room = std::min(zlib_step, result.size() - filled);
        stream.next_in = zlib_bytes(packed.data() + taken);
        stream.avail_in = static_cast<uInt>(given);
        stream.next_out = zlib_bytes(result.data() + filled);
        stream.avail_out = static_cast<uInt>(room);
        const int status = inflate(&stream, Z_NO_FLUSH);
        taken += given - stream.avail_in;
        filled += room - stream.avail_out;
        if (status == Z_STREAM_END) break;
        if (status != Z_OK) return {};
    }
    if (filled != size) return {};
    result.resize(size);
    return result;
}

std::string deflated_text(std::string_view content) {
    Deflating deflating;
    z_stream& stream = deflating.stream;
    OCTAVO_CHECK(deflating.begun, "zlib begins to deflate");
    std::string result;
    std::size_t taken = 0;
    for (int status = Z_OK; status != Z_STREAM_END;) {
        char step[1 << 16];
        const std::size_t given = std::min(zlib_step, content.size() - taken);
        stream.next_in = zlib_bytes(content.data() + taken);
        stream.avail_in = static_cast<uInt>(given);
        stream.next_out = zlib_bytes(step);
        stream.avail_out = sizeof step;
        status = deflate(&stream, taken + given == content.size() ? Z_FINISH : Z_NO_FLUSH);
        OCTAVO_CHECK(status == Z_OK || status == Z_STREAM_END, "deflate goes on");
        taken += given - stream.avail_in;
        result.append(step, sizeof step - stream.avail_out);
    }
    return result;
}

std::uint32_t checksum_of(Bytes bytes) {
    return crc32_of({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

/// The name in lower case and without a leading slash.
std::string comparable(std::string_view name) {
    std::string result(name.starts_with('/') ? name.substr(1) : name);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
}

}  // namespace

Result<ZipReader> ZipReader::open(Bytes archive) {
    ZipReader reader(archive);
    if (Status status = reader.read_directory(); !status) return status.error();
    return reader;
}

Status ZipReader::read_directory() {
    const std::optional<std::size_t> end = find_end(archive_);
    if (!end) return damaged(archive_.size(), "is no ZIP archive: it has no directory at its end");
    const std::size_t count = word_at(archive_, *end + 10);
    const std::size_t size = long_at(archive_, *end + 12);
    std::size_t at = long_at(archive_, *end + 16);
    if (count == 0xffff || at == in_zip64 || size == in_zip64)
        return unsupported("is a Zip64 archive, which Octavo does not read");
    if (word_at(archive_, *end + 4) != 0) return unsupported("is one part of a split ZIP archive");
    if (at > *end || size > *end - at)
        return damaged(*end, "the directory of the ZIP archive lies outside the file");
    for (std::size_t i = 0; i < count; ++i) {
        if (*end - at < directory_size || long_at(archive_, at) != directory_signature)
            return damaged(at, "the directory of the ZIP archive is damaged");
        const std::size_t name = word_at(archive_, at + 28);
        const std::size_t rest = std::size_t{word_at(archive_, at + 30)} + word_at(archive_, at + 32);
        if (*end - at - directory_size < name + rest)
            return damaged(at, "the directory of the ZIP archive is damaged");
        ZipEntry entry;
        entry.flags = word_at(archive_, at + 8);
        entry.method = word_at(archive_, at + 10);
        entry.checksum = long_at(archive_, at + 16);
        entry.packed_size = long_at(archive_, at + 20);
        entry.size = long_at(archive_, at + 24);
        entry.local_header = long_at(archive_, at + 42);
        entry.name = text_of(archive_.subspan(at + directory_size, name));
        entry_of_name_.try_emplace(comparable(entry.name), entries_.size());
        entries_.push_back(std::move(entry));
        at += directory_size + name + rest;
    }
    return Done{};
}

const ZipEntry* ZipReader::find(std::string_view name) const {
    const auto at = entry_of_name_.find(comparable(name));
    return at == entry_of_name_.end() ? nullptr : &entries_[at->second];
}

Result<Bytes> ZipReader::packed(const ZipEntry& entry) const {
    const std::size_t at = entry.local_header;
    if (archive_.size() < local_size || at > archive_.size() - local_size ||
        long_at(archive_, at) != local_signature)
        return damaged(at, "the entry " + entry.name + " is not where the directory says");
    const std::size_t skipped =
        local_size + std::size_t{word_at(archive_, at + 26)} + std::size_t{word_at(archive_, at + 28)};
    if (archive_.size() - at < skipped || archive_.size() - at - skipped < entry.packed_size)
        return damaged(at, "the entry " + entry.name + " runs past the end of the file");
    return archive_.subspan(at + skipped, entry.packed_size);
}

Result<std::vector<std::byte>> ZipReader::read(const ZipEntry& entry, std::uint64_t limit) const {
    if (entry.size == in_zip64 || entry.packed_size == in_zip64 || entry.local_header == in_zip64)
        return unsupported("the entry " + entry.name + " uses Zip64, which Octavo does not read");
    if ((entry.flags & encrypted_flag) != 0) return unsupported("the entry " + entry.name + " is encrypted");
    if (entry.method != stored && entry.method != deflated)
        return unsupported("the entry " + entry.name + " is compressed by method " +
                           std::to_string(entry.method) + ", not stored or deflated");
    if (entry.size > limit)
        return Error{ErrorCode::limit,
                     "the entry " + entry.name + " would unpack to " + std::to_string(entry.size) +
                         " bytes, more than " + std::to_string(limit),
                     {}};
    const Result<Bytes> bytes = packed(entry);
    if (!bytes) return bytes.error();
    std::optional<std::vector<std::byte>> content;
    if (entry.method == deflated) {
        content = inflated(*bytes, entry.size);
    } else if (entry.packed_size == entry.size) {
        content.emplace(bytes->begin(), bytes->end());
    }
    if (!content || checksum_of(*content) != entry.checksum)
        return damaged(entry.local_header, "the entry " + entry.name + " is damaged");
    return std::move(*content);
}

/// The fields that a local header and a directory entry share.
void ZipWriter::append_fields(const ZipEntry& entry) {
    output_.append_binary(std::uint16_t{20});  // version that can unpack it: 2.0
    output_.append_binary(entry.flags);
    output_.append_binary(entry.method);
    output_.append_binary(std::uint16_t{0});
    output_.append_binary(first_of_january_1980);
    output_.append_binary(entry.checksum);
    output_.append_binary(entry.packed_size);
    output_.append_binary(entry.size);
    output_.append_binary(static_cast<std::uint16_t>(entry.name.size()));
    output_.append_binary(std::uint16_t{0});
}

Status ZipWriter::add(std::string_view name, std::string_view content) {
    const std::string body = deflated_text(content);
    const std::uint64_t at = output_.size() - begin_;
    if (content.size() >= in_zip64 || at + local_size + name.size() + body.size() >= in_zip64)
        return Error{ErrorCode::limit, "a ZIP archive of more than 4 GiB would be needed", {}};
    ZipEntry entry;
    entry.name = name;
    entry.flags = names_are_utf8_flag;
    entry.method = deflated;
    entry.checksum = checksum_of(bytes_of(content));
    entry.packed_size = static_cast<std::uint32_t>(body.size());
    entry.size = static_cast<std::uint32_t>(content.size());
    entry.local_header = static_cast<std::uint32_t>(at);
    output_.append_binary(local_signature);
    append_fields(entry);
    output_.append(name);
    output_.append(body);
    entries_.push_back(std::move(entry));
    return Done{};
}

Status ZipWriter::finish() {
    const std::uint64_t begin = output_.size() - begin_;
    for (const ZipEntry& entry : entries_) {
        output_.append_binary(directory_signature);
        output_.append_binary(std::uint16_t{20});
        append_fields(entry);
        for (int i = 0; i < 3; ++i)
            output_.append_binary(std::uint16_t{0});  // comment, disk, internal attributes
        output_.append_binary(std::uint32_t{0});
        output_.append_binary(entry.local_header);
        output_.append(entry.name);
    }
    const std::uint64_t end = output_.size() - begin_;
    if (end >= in_zip64)
        return Error{ErrorCode::limit, "a ZIP archive of more than 4 GiB would be needed", {}};
    output_.append_binary(end_signature);
    output_.append_binary(std::uint32_t{0});
    for (int i = 0; i < 2; ++i) output_.append_binary(static_cast<std::uint16_t>(entries_.size()));
    output_.append_binary(static_cast<std::uint32_t>(end - begin));
    output_.append_binary(static_cast<std::uint32_t>(begin));
    output_.append_binary(std::uint16_t{0});
    return Done{};
}

}  // namespace octavo::io
