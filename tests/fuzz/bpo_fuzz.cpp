// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/check.hpp>
#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/bp_octree/figures.hpp>
#include <octavo/bp_octree/to_mesh.hpp>

#include "../bp_octree/sign_bpo.hpp"

// Any bytes are refused with a sentence or are a tree that can be walked, drawn, certified or refuted, and written
// again. They are tried as they are and with all checksums put right, which random changes never do.

namespace {

using namespace octavo;

void walk(const bp_octree::BpOctree& tree) {
    OCTAVO_CHECK(bp_octree::measure_levels(tree).size() == tree.levels.size(), "all levels are measured");
    bp_octree::ToMeshOptions drawing;
    drawing.level = tree.deepest();
    const mesh::Mesh mesh = bp_octree::to_mesh(tree, drawing);
    for (const mesh::Triangle& t : mesh.triangles)
        for (const mesh::VertexIndex corner : t)
            OCTAVO_CHECK(corner < mesh.vertices.size(), "corners are vertices");
}

void try_bytes(std::span<const std::uint8_t> bytes) {
    if (auto part = bp_octree::decode_beginning(bytes.first(bytes.size() / 2))) walk(*part);
    const Result<bp_octree::BpOctree> tree = bp_octree::decode(bytes);
    if (!tree) {
        OCTAVO_CHECK(!tree.error().sentence.empty(), "an error has a sentence");
        return;
    }
    walk(*tree);
    const Status certified = bp_octree::certify(*tree);
    OCTAVO_CHECK(certified || !certified.error().sentence.empty(), "an error has a sentence");
    const auto again = bp_octree::decode(bp_octree::encode(*tree));
    OCTAVO_CHECK(again.has_value(), "what was read can be written and read");
    OCTAVO_CHECK(again->nodes == tree->nodes && again->planes == tree->planes &&
                     again->leaf_triangles.size() == tree->leaf_triangles.size(),
                 "and is the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try_bytes({data, size});
    if (size < bp_octree::BpoHead::size) return 0;
    std::vector<std::uint8_t> mended(data, data + size);
    tests::sign_bpo(mended);
    try_bytes(mended);
    return 0;
}
