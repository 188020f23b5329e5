// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <span>

#include <octavo/io/input.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/output.hpp>
#include <octavo/octree/oct_format.hpp>

namespace octavo::io {
namespace {

Error in_file(Error error, const std::string& path) {
    error.place.file = path;
    return error;
}

}  // namespace

Result<octree::Octree> read_octree(const std::string& path, const Context& context) try {
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return block.error();
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(block->bytes().data()),
                                              block->size());
    Result<octree::Octree> octree = octree::decode(bytes);
    if (!octree) return in_file(std::move(octree).error(), path);
    return octree;
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<WriteReport> write_octree(const std::string& path, const octree::Octree& octree,
                                 const Context& context) {
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    const std::vector<std::uint8_t> bytes = octree::encode(octree);
    output->append(Bytes(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()));
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    WriteReport report;
    report.format = "oct";
    report.bytes = bytes.size();
    return report;
}

}  // namespace octavo::io
