// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/check.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>

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
    const Result<bsp_octree::BspOctree> nothing = solid.intersect(solid.complement());
    OCTAVO_CHECK(nothing || !nothing.error().sentence.empty(), "an error has a sentence");
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

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try_bytes({data, size});
    constexpr std::size_t checksum_at = 16;
    if (size < checksum_at + 4) return 0;
    std::vector<std::uint8_t> mended(data, data + size);
    store(&mended[checksum_at], crc32_around(mended, checksum_at));
    try_bytes(mended);
    return 0;
}
