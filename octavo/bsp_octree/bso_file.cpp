// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <span>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/output.hpp>

namespace octavo::bsp_octree {
namespace {

Error in_file(Error error, const std::string& path) {
    error.place.file = path;
    return error;
}

}  // namespace

Result<BspOctree> read_bso(const std::string& path, const Context& context) try {
    const Result<io::ByteBlock> block = io::read_bytes(path, context);
    if (!block) return block.error();
    Result<BspOctree> octree =
        decode({reinterpret_cast<const std::uint8_t*>(block->bytes().data()), block->size()});
    if (!octree) return in_file(std::move(octree).error(), path);
    return octree;
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<io::WriteReport> write_bso(const std::string& path, const BspOctree& octree, const Context& context) {
    Result<io::Output> output = io::Output::to_file(path);
    if (!output) return output.error();
    const std::vector<std::uint8_t> bytes = encode(octree);
    output->append(octavo::Bytes(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()));
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    io::WriteReport report;
    report.format = "bso";
    report.bytes = bytes.size();
    return report;
}

}  // namespace octavo::bsp_octree
