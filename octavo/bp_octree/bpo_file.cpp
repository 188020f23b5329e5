// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
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

/// What is no file on disk cannot be read in parts.
Result<std::unique_ptr<io::ByteSource>> source_at(const std::string& path, const Context& context) {
    std::error_code unknown;
    if (path != "-" && std::filesystem::is_regular_file(path, unknown)) return io::open_file(path);
    Result<io::ByteBlock> block = io::read_bytes(path, context);
    if (!block) return std::move(block).error();
    return io::source_of(std::move(*block), path);
}

}  // namespace

Result<BpoReader> open_bpo(const std::string& path, const Context& context) try {
    auto source = source_at(path, context);
    if (!source) return std::move(source).error();
    return BpoReader::open(std::move(*source));
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<ReadBpo> read_bpo(const std::string& path, const ReadBpoOptions& options, const Context& context) try {
    Result<BpoReader> reader = open_bpo(path, context);
    if (!reader) return std::move(reader).error();
    const bool is_partial = reader->is_partial();
    const bool accepts = options.partial == ReadBpoOptions::Partial::accept;
    const bool reads_levels = options.levels || (is_partial && accepts);
    Result<BpOctree> tree = reads_levels && (!is_partial || accepts)
                                ? reader->read_levels(options.levels.value_or(max_depth))
                                : reader->read_all(context);
    if (!tree) return in_file(std::move(tree).error(), path);
    std::vector<std::uint64_t> to_level = reader->bytes_to_level();
    to_level.resize(tree->levels.size());
    return ReadBpo{std::move(*tree), reader->arrived().bytes, reader->bytes_read(), std::move(to_level),
                   is_partial};
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<io::WriteReport> write_bpo(const std::string& path, std::span<const std::uint8_t> bytes,
                                  const Context& context) {
    Result<io::Output> output = io::Output::to_file(path, context);
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
