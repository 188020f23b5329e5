// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <octavo/classic/csg_build.hpp>
#include <octavo/io/openscad_csg.hpp>

// Any bytes as a .csg file. What is accepted must give valid octrees, the same by both methods; what is not must
// say where. The first byte chooses facets and skipping.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace octavo;
    if (size == 0) return 0;
    io::CsgReadOptions options;
    options.faceted = data[0] & 1;
    options.skip_unsupported = data[0] & 2;
    options.most_nodes = 300;
    options.most_values = 3000;
    options.most_vertices = 3000;
    options.most_segments = 100;
    const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
    const Result<io::CsgFile> file = io::read_csg_text(text, "/nonexistent", options);
    if (!file) {
        if (file.error().sentence.empty() || file.error().place.line == 0) std::abort();
        return 0;
    }
    classic::CsgBuildOptions build_options;
    build_options.depth = 3;
    Context context;
    context.threads = 1;
    const Result<classic::CsgOctree> top_down = classic::build(file->expression, build_options, context);
    build_options.method = classic::CsgMethod::classic;
    const Result<classic::CsgOctree> classic = classic::build(file->expression, build_options, context);
    if (top_down.has_value() != classic.has_value()) std::abort();
    if (!top_down) return 0;
    if (!top_down->octree.validate() || !(top_down->octree == classic->octree)) std::abort();
    return 0;
}
