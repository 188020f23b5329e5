// SPDX-License-Identifier: Apache-2.0
#include <new>

#include <octavo/bp_octree/bpo_file.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/output.hpp>

namespace octavo::bp_octree {
namespace {

Error in_file(Error error, const std::string& path) {
    error.place.file = path;
    return error;
}

}  // namespace

Result<ReadBpo> read_bpo(const std::string& path, const ReadBpoOptions& options, const Context& context) try {
    const Result<io::ByteBlock> block = io::read_bytes(path, context);
    if (!block) return block.error();
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(block->bytes().data()),
                                              block->size());
    auto to_level = bytes_to_level(bytes);
    if (!to_level) return in_file(std::move(to_level).error(), path);
    auto file_size = size_in_head(bytes);
    if (!file_size) return in_file(std::move(file_size).error(), path);
    const bool is_partial = options.partial == ReadBpoOptions::Partial::accept && bytes.size() < *file_size;
    DecodeOptions decoding;
    decoding.levels = options.levels;
    Result<BpOctree> tree = is_partial ? decode_beginning(bytes, decoding) : decode(bytes, decoding, context);
    if (!tree) return in_file(std::move(tree).error(), path);
    to_level->resize(tree->levels.size());
    return ReadBpo{std::move(*tree), bytes.size(), std::move(*to_level), is_partial};
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<io::WriteReport> write_bpo(const std::string& path, std::span<const std::uint8_t> bytes,
                                  const Context& context) {
    Result<io::Output> output = io::Output::to_file(path);
    if (!output) return output.error();
    output->append(octavo::Bytes(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()));
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    io::WriteReport report;
    report.format = "bpo";
    report.bytes = bytes.size();
    return report;
}

}  // namespace octavo::bp_octree
