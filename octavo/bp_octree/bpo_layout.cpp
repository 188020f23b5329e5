// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bp_octree/bpo_layout.hpp>

namespace octavo::bp_octree {
namespace {

/// Appends numbers, little-endian.
class Writer {
  public:
    explicit Writer(std::vector<std::uint8_t>& out) : out_(out) {}
    template <class T>
    Writer& operator<<(T value) {
        std::array<std::byte, sizeof(T)> bytes;
        octavo::store(bytes.data(), value);
        for (const std::byte byte : bytes) out_.push_back(static_cast<std::uint8_t>(byte));
        return *this;
    }

  private:
    std::vector<std::uint8_t>& out_;
};

class Reader {
  public:
    explicit Reader(std::span<const std::uint8_t> bytes) : at_(bytes.data()) {}
    template <class T>
    T get() {
        const T value = octavo::load<T>(at_);
        at_ += sizeof(T);
        return value;
    }

  private:
    const std::uint8_t* at_;
};

Error damaged(std::string sentence, std::uint64_t byte) {
    Error error{ErrorCode::bad_input, "the .bpo file is damaged: " + std::move(sentence), {}};
    error.place.byte = byte;
    return error;
}

// Of head and levels.
constexpr std::size_t checksum_at = 12;

}  // namespace

void put_head(const BpoHead& head, std::span<const LevelFigures> levels, std::vector<std::uint8_t>& out) {
    Writer writer(out);
    for (const std::uint8_t byte : bpo_magic) writer << byte;
    writer << bpo_version << std::uint32_t{0};
    writer << std::uint32_t{head.is_solid ? 1U : 0U} << std::int32_t{head.lattice.exponent()};
    for (const std::int64_t origin : head.lattice.origin()) writer << origin;
    for (const std::int32_t low : head.frame.low()) writer << low;
    for (const std::int32_t side : head.frame.side()) writer << side;
    writer << static_cast<std::uint32_t>(head.frame.depth()) << head.levels << head.solid_volume;
    writer << head.nodes << head.planes << head.leaves << head.triangles << head.points << head.file_size;
    writer << head.chunks << std::uint32_t{0};
    while (out.size() < BpoHead::size) writer << std::uint8_t{0};
    for (const LevelFigures& level : levels)
        writer << level.split << level.gray << level.white << level.black << level.planes << level.volume;
    const std::uint32_t checksum = crc32_around(out, checksum_at);
    octavo::store(&out[checksum_at], checksum);
}

void put_index(std::span<const ChunkEntry> entries, std::vector<std::uint8_t>& out) {
    for (std::size_t begin = 0; begin < entries.size(); begin += entries_a_page) {
        const std::size_t page = out.size();
        const std::size_t count = std::min(entries_a_page, entries.size() - begin);
        Writer writer(out);
        writer << std::uint32_t{0} << static_cast<std::uint32_t>(count) << std::uint64_t{0};
        for (const ChunkEntry& entry : entries.subspan(begin, count)) {
            writer << entry.offset << entry.size << entry.checksum << static_cast<std::uint8_t>(entry.kind)
                   << entry.level << std::uint16_t{0} << entry.first << entry.count << entry.splits_before
                   << entry.leaves_before << std::uint32_t{0} << entry.first_key;
        }
        out.resize(page + page_size, 0);
        const std::uint32_t checksum = crc32_of(std::span(out).subspan(page + 4, page_size - 4));
        octavo::store(&out[page], checksum);
    }
}

Result<HeadAndLevels> get_head(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < bpo_magic.size() || !std::equal(bpo_magic.begin(), bpo_magic.end(), bytes.begin()))
        return Error{ErrorCode::bad_input, "this is no .bpo file", {}};
    if (bytes.size() < BpoHead::size) return damaged("it ends within its head", bytes.size());
    Reader reader(bytes.subspan(bpo_magic.size()));
    if (const auto version = reader.get<std::uint32_t>(); version != bpo_version)
        return Error{
            ErrorCode::unsupported, "version " + std::to_string(version) + " of .bpo is not known", {}};
    const auto checksum = reader.get<std::uint32_t>();
    HeadAndLevels result;
    BpoHead& head = result.head;
    const auto flags = reader.get<std::uint32_t>();
    head.is_solid = flags & 1;
    const auto exponent = reader.get<std::int32_t>();
    std::array<std::int64_t, 3> origin;
    for (std::int64_t& value : origin) value = reader.get<std::int64_t>();
    std::array<std::int32_t, 3> low, side;
    for (std::int32_t& value : low) value = reader.get<std::int32_t>();
    for (std::int32_t& value : side) value = reader.get<std::int32_t>();
    const auto depth = reader.get<std::uint32_t>();
    head.levels = reader.get<std::uint32_t>();
    if (head.levels < 1 || head.levels > max_depth + 1)
        return damaged("the number of levels is not 1 to 19", 76);
    if (bytes.size() < head.index_at()) return damaged("it ends within its table of levels", bytes.size());
    if (checksum != crc32_around(bytes.first(head.index_at()), checksum_at))
        return damaged("the checksum of its head is wrong", 12);
    if (flags > 1) return damaged("a reserved flag is set", 16);
    head.solid_volume = reader.get<double>();
    for (std::uint64_t* count :
         {&head.nodes, &head.planes, &head.leaves, &head.triangles, &head.points, &head.file_size})
        *count = reader.get<std::uint64_t>();
    head.chunks = reader.get<std::uint32_t>();
    // A liar can compute checksums too.
    auto lattice = exact::Lattice::from_parts(exponent, origin);
    if (!lattice) return damaged(lattice.error().sentence, 20);
    head.lattice = *lattice;
    auto frame = Frame::from_parts(low, side, static_cast<int>(std::min(depth, 99U)));
    if (!frame) return damaged(frame.error().sentence, 48);
    head.frame = *frame;
    if (head.levels > depth + 1) return damaged("it has levels below its depth", 76);
    if (!std::isfinite(head.solid_volume)) return damaged("the volume is not finite", 80);
    Reader level_reader(bytes.subspan(BpoHead::size));
    std::uint64_t nodes = 0, planes = 0, leaves = 0, parents = 0;
    for (std::uint32_t i = 0; i < head.levels; ++i) {
        LevelFigures level;
        for (std::uint64_t* count : {&level.split, &level.gray, &level.white, &level.black, &level.planes}) {
            *count = level_reader.get<std::uint64_t>();
            if (*count > 0xffffffff)
                return damaged("a level has too many nodes", BpoHead::size + i * BpoHead::level_size);
        }
        level.volume = level_reader.get<double>();
        const std::uint64_t all = level.split + level.gray + level.white + level.black;
        if (all != (i == 0 ? 1 : 8 * parents) || !std::isfinite(level.volume))
            return damaged("the figures of its levels disagree", BpoHead::size + i * BpoHead::level_size);
        parents = level.split;
        nodes += all, planes += level.planes, leaves += level.gray;
        result.levels.push_back(level);
    }
    if (parents != 0 || nodes != head.nodes || planes != head.planes || leaves != head.leaves ||
        nodes > 0xffffffff || head.triangles > 0xffffffff || head.points > 0xffffffff)
        return damaged("the figures of its levels disagree with its head", 88);
    return result;
}

Result<std::vector<ChunkEntry>> get_index(const BpoHead& head, std::span<const std::uint8_t> bytes) {
    const std::uint64_t pages = (std::uint64_t{head.chunks} + entries_a_page - 1) / entries_a_page;
    std::uint64_t at = head.index_at();
    if (bytes.size() < head.chunks_at()) return damaged("it ends within its index", bytes.size());
    std::uint64_t next_chunk = head.chunks_at();
    std::vector<ChunkEntry> entries;
    for (std::uint64_t page = 0; page < pages; ++page, at += page_size) {
        const auto content = bytes.subspan(at, page_size);
        Reader reader(content);
        const auto checksum = reader.get<std::uint32_t>();
        if (checksum != crc32_of(content.subspan(4)))
            return damaged("the checksum of a page of its index is wrong", at);
        const std::uint32_t expected = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(entries_a_page, head.chunks - page * entries_a_page));
        if (reader.get<std::uint32_t>() != expected) return damaged("a page of its index is not full", at);
        reader.get<std::uint64_t>();
        for (std::uint32_t i = 0; i < expected; ++i) {
            ChunkEntry entry;
            entry.offset = reader.get<std::uint64_t>();
            entry.size = reader.get<std::uint32_t>();
            entry.checksum = reader.get<std::uint32_t>();
            const auto kind = reader.get<std::uint8_t>();
            entry.level = reader.get<std::uint8_t>();
            reader.get<std::uint16_t>();
            entry.first = reader.get<std::uint32_t>();
            entry.count = reader.get<std::uint32_t>();
            entry.splits_before = reader.get<std::uint32_t>();
            entry.leaves_before = reader.get<std::uint32_t>();
            reader.get<std::uint32_t>();
            entry.first_key = reader.get<std::uint64_t>();
            entry.kind = static_cast<ChunkKind>(kind);
            if (kind > 1 || entry.offset != next_chunk || entry.level >= head.levels)
                return damaged("an entry of its index is wrong",
                               at + page_head + i * ChunkEntry::size_in_file);
            next_chunk += entry.size;
            entries.push_back(entry);
        }
    }
    if (next_chunk != head.file_size) return damaged("its chunks do not end where it does", 128);
    return entries;
}

}  // namespace octavo::bp_octree
