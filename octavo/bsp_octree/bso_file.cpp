// SPDX-License-Identifier: Apache-2.0
#include <new>
#include <span>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/io/input_stream.hpp>
#include <octavo/io/output.hpp>

namespace octavo::bsp_octree {
namespace {

Error in_file(Error error, const std::string& path) {
    error.place.file = path;
    return error;
}

}  // namespace

Result<BspOctree> read_bso(const std::string& path, const Context& context) try {
    Result<io::InputStream> stream = io::InputStream::open(path, context);
    if (!stream) return in_file(std::move(stream).error(), path);
    Result<BspOctree> octree = decode(
        [&](std::span<std::uint8_t> room) { return stream->read(std::as_writable_bytes(room), context); },
        context);
    if (!octree) return in_file(std::move(octree).error(), path);
    return octree;
} catch (const std::bad_alloc&) {
    return in_file({ErrorCode::limit, "does not fit into memory", {}}, path);
}

Result<io::WriteReport> write_bso(const std::string& path, const BspOctree& octree, const Context& context) {
    Result<io::Output> output = io::Output::to_file(path, context);
    if (!output) return output.error();
    encode(octree, [&](std::span<const std::uint8_t> bytes) { output->append(std::as_bytes(bytes)); });
    if (context.cancelled()) return Context::cancelled_error();
    io::WriteReport report;
    report.format = "bso";
    report.bytes = output->size();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

}  // namespace octavo::bsp_octree
