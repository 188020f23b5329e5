// SPDX-License-Identifier: Apache-2.0
#include <bit>

#include <octavo/mesh/weld.hpp>

namespace octavo::mesh {
namespace {

std::uint64_t mix(std::uint64_t hash) {
    hash ^= hash >> 32;
    hash *= 0xd6e8feb86659fd93ULL;
    return hash ^ (hash >> 32);
}

std::uint64_t hash_of(Vec3 p) {
    // Adding +0 turns −0 into +0, so equal values have equal bits.
    return mix(std::bit_cast<std::uint64_t>(p.x + 0.0) +
               mix(std::bit_cast<std::uint64_t>(p.y + 0.0) + mix(std::bit_cast<std::uint64_t>(p.z + 0.0))));
}

std::uint64_t hash_of(exact::Point p) {
    const auto word = [](std::int32_t c) {
        return static_cast<std::uint64_t>(static_cast<std::uint32_t>(c));
    };
    return mix((word(p.x) << 32 | word(p.y)) + mix(word(p.z)));
}

template <class Position>
WeldMap group(std::span<const Position> positions) {
    constexpr VertexIndex free_slot = ~VertexIndex{0};
    WeldMap map;
    map.index.resize(positions.size());
    map.kept.reserve(positions.size());
    const std::size_t slots = std::bit_ceil(2 * positions.size() + 1);
    std::vector<VertexIndex> table(slots, free_slot);  // new indices
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (!(positions[i] == positions[i])) {
            // What is not a number equals nothing, itself included; in the table, very many would all meet at one slot.
            map.index[i] = static_cast<VertexIndex>(map.kept.size());
            map.kept.push_back(static_cast<VertexIndex>(i));
            continue;
        }
        std::size_t slot = hash_of(positions[i]) & (slots - 1);
        while (table[slot] != free_slot && !(positions[map.kept[table[slot]]] == positions[i]))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == free_slot) {
            table[slot] = static_cast<VertexIndex>(map.kept.size());
            map.kept.push_back(static_cast<VertexIndex>(i));
        }
        map.index[i] = table[slot];
    }
    return map;
}

template <class Position>
std::vector<Position> gather(const std::vector<Position>& positions, const std::vector<VertexIndex>& kept) {
    std::vector<Position> result;
    result.reserve(kept.size());
    for (const VertexIndex vertex : kept) result.push_back(positions[vertex]);
    return result;
}

}  // namespace

WeldMap equal_vertices(std::span<const Vec3> positions) { return group(positions); }
WeldMap equal_vertices(std::span<const exact::Point> points) { return group(points); }

std::vector<Triangle> renamed(std::span<const Triangle> triangles, const WeldMap& map) {
    std::vector<Triangle> result;
    result.reserve(triangles.size());
    for (const Triangle& t : triangles) result.push_back({map.index[t[0]], map.index[t[1]], map.index[t[2]]});
    return result;
}

Mesh weld(const Mesh& mesh) {
    const WeldMap map = equal_vertices(mesh.vertices);
    return {gather(mesh.vertices, map.kept), renamed(mesh.triangles, map), mesh.sources};
}

LatticeMesh weld(const LatticeMesh& mesh) {
    const WeldMap map = equal_vertices(mesh.points);
    return {mesh.lattice, gather(mesh.points, map.kept), renamed(mesh.triangles, map)};
}

}  // namespace octavo::mesh
