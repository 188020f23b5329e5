// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Joins the corners of a facet soup that are the same point bit for bit (where -0 is +0), and only those:
// any tolerance would be a geometric decision. Vertices are numbered in the order in which they first appear.
//
// Idea: an open-addressed hash table of 8-byte slots, a vertex index and 32 further bits of the hash, so that
// a probe that misses does not touch the vertices. Real (float or double) is the type that the file stores;
// comparing floats halves the memory touched. Sorting the corners (radix) was considered: it makes about 10
// passes over the corners, the table one.
// Cost: about 10 ns a corner while the table fits the caches.

namespace octavo::io {

template <class Real>
class VertexWelder {
  public:
    /// `corners` is how many are expected; a closed mesh has about six corners a vertex.
    explicit VertexWelder(std::size_t corners) {
        const std::size_t vertices = corners / 6 + 16;
        vertices_.reserve(vertices);
        slots_.assign(std::bit_ceil(2 * vertices), Slot{});
    }

    struct Key {
        Real x, y, z;
        std::uint64_t hash;
    };

    /// Prepares a point for add and starts to fetch its slot, so that the caller can prepare several points
    /// before the first add waits for memory.
    Key prepare(Real x, Real y, Real z) const {
        // Adding +0 turns -0 into +0 and changes nothing else.
        const Key key{x + Real(0), y + Real(0), z + Real(0), 0};
        const std::uint64_t hash = hash_of(key);
        __builtin_prefetch(&slots_[hash & (slots_.size() - 1)]);
        return {key.x, key.y, key.z, hash};
    }

    /// The index of the vertex at the point of `key`.
    mesh::VertexIndex add(const Key& key) {
        const auto tag = static_cast<std::uint32_t>(key.hash >> 32);
        std::size_t at = key.hash & (slots_.size() - 1);
        for (; slots_[at].vertex != none; at = (at + 1) & (slots_.size() - 1)) {
            if (slots_[at].tag != tag) continue;
            const Point& point = vertices_[slots_[at].vertex];
            if (point.x == key.x && point.y == key.y && point.z == key.z) return slots_[at].vertex;
        }
        const auto vertex = static_cast<mesh::VertexIndex>(vertices_.size());
        slots_[at] = {vertex, tag};
        vertices_.push_back({key.x, key.y, key.z});
        if (2 * vertices_.size() > slots_.size()) grow();
        return vertex;
    }

    std::vector<Vec3> vertices() const {
        std::vector<Vec3> result;
        result.reserve(vertices_.size());
        for (const Point& point : vertices_) result.push_back({point.x, point.y, point.z});
        return result;
    }

  private:
    static constexpr mesh::VertexIndex none = std::numeric_limits<mesh::VertexIndex>::max();
    struct Point {
        Real x, y, z;
    };
    struct Slot {
        mesh::VertexIndex vertex = none;
        std::uint32_t tag = 0;
    };

    template <class P>
    static std::uint64_t hash_of(const P& point) {
        using Word = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
        // Multiplying carries differences up, the shifts bring them down again (after MurmurHash3's
        // finaliser, Appleby, 2011); coordinates differ in a few middle bits only, so both are needed.
        std::uint64_t h = std::bit_cast<Word>(point.x) * 0x9e3779b97f4a7c15ULL;
        h = (h ^ (h >> 32) ^ std::bit_cast<Word>(point.y)) * 0xff51afd7ed558ccdULL;
        h = (h ^ (h >> 29) ^ std::bit_cast<Word>(point.z)) * 0xc4ceb9fe1a85ec53ULL;
        return h ^ (h >> 32);
    }

    void grow() {
        std::vector<Slot> larger(2 * slots_.size());
        for (std::size_t i = 0; i < vertices_.size(); ++i) {
            const std::uint64_t hash = hash_of(vertices_[i]);
            std::size_t at = hash & (larger.size() - 1);
            while (larger[at].vertex != none) at = (at + 1) & (larger.size() - 1);
            larger[at] = {static_cast<mesh::VertexIndex>(i), static_cast<std::uint32_t>(hash >> 32)};
        }
        slots_ = std::move(larger);
    }

    std::vector<Point> vertices_;
    std::vector<Slot> slots_;
};

}  // namespace octavo::io
