// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/classify.hpp>
#include <octavo/boolean/contacts.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/boolean/program.hpp>
#include <octavo/boolean/soup.hpp>
#include <octavo/boolean/stars.hpp>
#include <octavo/boolean/surface.hpp>
#include <octavo/bsp_octree/faces.hpp>

// Whether two engines made the same solid, to the last bit, however each of them cut its boundary to pieces.
//
// Moments of a solid are rational functions of its exact vertices; here they are computed modulo a prime near 2^61, so
// that nothing is rounded and no number grows. They are the integrals of (f · p)^k, k = 0 … 4, where f has random
// coordinates: two different solids agree in them by chance only, and the volume, k = 0, is one of them. Vertices are
// taken as the engines hold them, before any rounding to doubles.

namespace octavo::tests {

class Field {
  public:
    static constexpr std::uint64_t prime = (std::uint64_t{1} << 61) - 1;

    static std::uint64_t product(std::uint64_t a, std::uint64_t b) {
        return static_cast<std::uint64_t>(exact::uint128{a} * b % prime);
    }
    static std::uint64_t sum(std::uint64_t a, std::uint64_t b) { return (a + b) % prime; }
    static std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return (a + prime - b) % prime; }
    static std::uint64_t power(std::uint64_t base, std::uint64_t exponent) {
        std::uint64_t result = 1;
        for (; exponent; exponent >>= 1, base = product(base, base))
            if (exponent & 1) result = product(result, base);
        return result;
    }
    static std::uint64_t inverse(std::uint64_t a) { return power(a, prime - 2); }

    static std::uint64_t of(std::int64_t number) {
        const std::int64_t rest = number % static_cast<std::int64_t>(prime);
        return static_cast<std::uint64_t>(rest < 0 ? rest + static_cast<std::int64_t>(prime) : rest);
    }
    template <int Limbs>
    static std::uint64_t of(const exact::WideInt<Limbs>& number) {
        const exact::WideInt<Limbs> size = number.negative() ? -number : number;
        std::uint64_t rest = 0;
        for (int i = Limbs - 1; i >= 0; --i)
            rest = static_cast<std::uint64_t>(
                ((exact::uint128{rest} << 64) | size.limb[static_cast<std::size_t>(i)]) % prime);
        return number.negative() ? difference(0, rest) : rest;
    }
};

/// A point of the world in the field.
using FieldPoint = std::array<std::uint64_t, 3>;

/// Of points of a lattice.
class FieldPoints {
  public:
    explicit FieldPoints(const exact::Lattice& lattice)
        : origin_(lattice.origin()),
          unit_(lattice.exponent() >= 0
                    ? Field::power(2, static_cast<std::uint64_t>(lattice.exponent()))
                    : Field::inverse(Field::power(2, static_cast<std::uint64_t>(-lattice.exponent())))) {}

    template <class P>
    FieldPoint operator()(const P& point) const {
        const auto& p = exact::homogeneous(point);
        const std::uint64_t inverse = Field::inverse(Field::of(p.weight()));
        FieldPoint result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint64_t at = Field::product(Field::of(p.numerator(static_cast<int>(axis))), inverse);
            result[axis] = Field::product(Field::sum(at, Field::of(origin_[axis])), unit_);
        }
        return result;
    }

  private:
    std::array<std::int64_t, 3> origin_;
    std::uint64_t unit_;
};

class Fingerprint {
  public:
    /// The tetrahedron of the origin and a triangle that faces outwards.
    void add(const FieldPoint& a, const FieldPoint& b, const FieldPoint& c) {
        std::uint64_t size = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            size = Field::sum(size, Field::product(a[i], Field::difference(Field::product(b[j], c[k]),
                                                                           Field::product(b[k], c[j]))));
        }
        // The integral of (f · p)^k over a tetrahedron is its volume times a constant times the complete homogeneous
        // symmetric polynomial of the values at its corners, of which one is 0.
        const std::uint64_t u = value(a), v = value(b), w = value(c);
        std::uint64_t one = 1, two = 1, three = 1;  // of u; of u and v; of all, degree 0
        for (std::uint64_t& moment : moments_) {
            moment = Field::sum(moment, Field::product(size, three));
            one = Field::product(one, u);
            two = Field::sum(Field::product(two, v), one);
            three = Field::sum(Field::product(three, w), two);
        }
    }

    void add(const Fingerprint& other) {
        for (std::size_t k = 0; k < moments_.size(); ++k)
            moments_[k] = Field::sum(moments_[k], other.moments_[k]);
    }

    friend bool operator==(const Fingerprint&, const Fingerprint&) = default;
    bool is_zero() const { return *this == Fingerprint{}; }

  private:
    static std::uint64_t value(const FieldPoint& p) {
        constexpr FieldPoint f{0x1234567890ABCDE, 0x0FEDCBA98765432, 0x13579BDF2468ACE};
        std::uint64_t sum = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) sum = Field::sum(sum, Field::product(f[axis], p[axis]));
        return sum;
    }

    std::array<std::uint64_t, 5> moments_{};
};

inline Fingerprint fingerprint_of(const bsp_octree::BspOctree& solid) {
    const FieldPoints in_field(solid.lattice());
    const auto take = [&](const bsp::FragmentPool& pool, std::span<const bsp::Fragment> fragments,
                          Fingerprint& part) {
        std::vector<FieldPoint> ring;
        for (const bsp::Fragment& fragment : fragments) {
            ring.clear();
            for (const bsp::Corner& corner : pool.corners(fragment))
                ring.push_back(in_field(pool.constructed(corner.vertex)));
            for (std::size_t i = 2; i < ring.size(); ++i)
                fragment.facing.reversed() ? part.add(ring[0], ring[i], ring[i - 1])
                                           : part.add(ring[0], ring[i - 1], ring[i]);
        }
    };
    Fingerprint all;
    bsp_octree::for_each_boundary(solid, {}, Fingerprint{}, take, [&](std::span<const Fingerprint> parts) {
        for (const Fingerprint& part : parts) all.add(part);
    });
    return all;
}

/// Of what boolean/ makes, before it rounds.
inline Fingerprint fingerprint_of(std::span<const mesh::Mesh> operands, const boolean::Program& program) {
    std::vector<const mesh::Mesh*> pointers;
    for (const mesh::Mesh& operand : operands) pointers.push_back(&operand);
    const Context context;
    const Result<boolean::Soup> soup =
        boolean::make_soup(pointers, boolean::OpenOperands::reject, {}, context);
    EXPECT_TRUE(soup);
    const boolean::FacetTree tree(*soup, context);
    boolean::PointTable points(*soup);
    const boolean::Contacts contacts = boolean::find_contacts(*soup, tree, points, context);
    const boolean::Complex complex = boolean::arrange(*soup, contacts, points, context);
    const Result<boolean::Patches> patches =
        boolean::find_patches(complex, boolean::find_stars(*soup, 0, context), points, context);
    EXPECT_TRUE(patches);
    const Result<boolean::Classification> classification =
        boolean::classify(complex, points, tree, *patches, program, boolean::Dangling::dropped, context);
    EXPECT_TRUE(classification);
    const boolean::Surface surface = boolean::select(complex, *patches, *classification, context);
    const FieldPoints in_field(soup->lattice);
    Fingerprint all;
    const auto at = [&](boolean::PointId id) {
        return points.with(id, [&](const auto& point) { return in_field(point); });
    };
    for (const mesh::Triangle& t : surface.triangles) all.add(at(t[0]), at(t[1]), at(t[2]));
    return all;
}

}  // namespace octavo::tests
