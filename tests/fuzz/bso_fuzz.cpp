// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/check.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/mesh/shapes.hpp>

// Any bytes are refused with a sentence or are a solid that can be asked, combined, meshed or refused as a lie, and
// written to bytes that give themselves again. They are tried as they are and with the checksum put right, which random
// changes never do.

namespace {

using namespace octavo;

void use(const bsp_octree::BspOctree& solid) {
    for (const Vec3& point :
         {Vec3{0, 0, 0}, Vec3{0.5, 0.25, 0.125}, solid.lattice().to_world({1 << 25, 5, 1 << 20})})
        (void)solid.classify(point);
    const Result<bsp_octree::ToMesh> made = bsp_octree::to_mesh(solid);
    if (!made) OCTAVO_CHECK(!made.error().sentence.empty(), "an error has a sentence");
    if (made)
        for (const mesh::Triangle& t : made->mesh.triangles)
            for (const mesh::VertexIndex corner : t)
                OCTAVO_CHECK(corner < made->mesh.vertices.size(), "corners are vertices");
    OCTAVO_CHECK(solid.subtract(solid)->is_empty(), "nothing is left of a solid without itself");
    constexpr std::int32_t half = exact::universe_side / 2, last = exact::universe_side - 2;
    for (const auto& [low, high] :
         {std::pair{exact::Point{1, 1, 1}, exact::Point{last, last, last}},
          std::pair{exact::Point{half - 5, half, 99}, exact::Point{last, last, half}}}) {
        const mesh::Mesh box = mesh::box(solid.lattice().to_world(low), solid.lattice().to_world(high));
        const Result<bsp_octree::Built> tool =
            bsp_octree::build(box, solid.lattice(), {}, {}, solid.shared_store());
        OCTAVO_CHECK(tool.has_value(), "a box on the lattice has an octree");
        for (const auto& made :
             {solid.subtract(tool->octree), solid.unite(tool->octree), tool->octree.subtract(solid)})
            OCTAVO_CHECK(made.has_value(), "solids of one lattice can be combined");
    }
}

void try_bytes(std::span<const std::uint8_t> bytes) {
    const Result<bsp_octree::BspOctree> solid = bsp_octree::decode(bytes);
    if (!solid) {
        OCTAVO_CHECK(!solid.error().sentence.empty(), "an error has a sentence");
        return;
    }
    const std::vector<std::uint8_t> written = bsp_octree::encode(*solid);
    const Result<bsp_octree::BspOctree> again = bsp_octree::decode(written);
    OCTAVO_CHECK(again.has_value(), "what was read can be written and read");
    OCTAVO_CHECK(bsp_octree::encode(*again) == written, "and is the same");
    use(*solid);
}

/// Puts all checksums right, of a header and of the blocks whose lengths fit.
void mend(std::vector<std::uint8_t>& file) {
    constexpr std::size_t header = 52, most_block = 16384;
    if (file.size() < header + 4) return;
    store(&file[header], crc32_of(std::span(file).first(header)));
    for (std::size_t at = header + 4; at + 8 < file.size();) {
        auto length = load<std::uint32_t>(&file[at]);
        const std::size_t left = file.size() - at - 8;
        // A block that is too long or empty is made to end with the file, or the rest would never be read.
        if (length == 0 || length > std::min(left, most_block)) {
            length = static_cast<std::uint32_t>(std::min(left, most_block));
            store(&file[at], length);
        }
        store(&file[at + 4 + length], crc32_of(std::span(file).subspan(at - 4, length + 8)));
        at += length + 8;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try_bytes({data, size});
    std::vector<std::uint8_t> mended(data, data + size);
    mend(mended);
    try_bytes(mended);
    return 0;
}
