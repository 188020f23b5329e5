// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octavo/boolean/evaluate.hpp>

#include "solids.hpp"

// Any bytes as two closed operands on a small grid, where everything coincides all the time, and what set operations on
// them must obey. Results must be closed, oriented, manifolds, the same however the operands are ordered, and their
// volumes must agree: |A ∪ B| + |A ∩ B| = |A| + |B|, |A ⊕ B| = |A ∪ B| - |A ∩ B|, |A \ B| = |A| - |A ∩ B|, where |X| is
// the volume of where X winds at least once. For the fuzzer, and for inputs that it has found.

namespace octavo::tests {

class Bytes {
  public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : rest_(bytes) {}
    /// 0 once they are used up.
    unsigned next(unsigned below) {
        if (rest_.empty()) return 0;
        const unsigned byte = rest_[0];
        rest_ = rest_.subspan(1);
        return byte % below;
    }

  private:
    std::span<const std::uint8_t> rest_;
};

inline Vec3 read_point(Bytes& bytes) {
    const unsigned x = bytes.next(4), y = bytes.next(4), z = bytes.next(4);
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

inline void add_tetrahedron(Bytes& bytes, mesh::Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 4; ++corner) mesh.vertices.push_back(read_point(bytes));
    for (const mesh::Triangle& t : {mesh::Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// Quadrilaterals all round, each cut in two along either diagonal. With corners anywhere they are not flat; of a
/// parallelepiped they are.
inline void add_hexahedron(Bytes& bytes, mesh::Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const Vec3 corner = read_point(bytes), a = read_point(bytes), b = read_point(bytes),
               c = read_point(bytes);
    for (unsigned k = 0; k < 8; ++k)
        mesh.vertices.push_back(corner + (k & 1 ? a : Vec3{}) + (k & 2 ? b : Vec3{}) + (k & 4 ? c : Vec3{}));
    const unsigned diagonals = bytes.next(256);
    if (diagonals & 64) mesh.vertices[first + 7] = read_point(bytes);
    constexpr std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (unsigned side = 0; side < 6; ++side) {
        const std::uint32_t(&q)[4] = sides[side];
        const unsigned k = diagonals >> side & 1;
        mesh.triangles.push_back({first + q[k], first + q[k + 1], first + q[k + 2]});
        mesh.triangles.push_back({first + q[k + 2], first + q[(k + 3) % 4], first + q[k]});
    }
}

/// Bodies with corners on a small grid; closed however they overlap, and of either orientation.
inline mesh::Mesh read_operand(Bytes& bytes) {
    mesh::Mesh mesh;
    const unsigned parts = 1 + bytes.next(4);
    for (unsigned part = 0; part < parts; ++part) {
        bytes.next(2) ? add_hexahedron(bytes, mesh) : add_tetrahedron(bytes, mesh);
    }
    return mesh;
}

/// Carries out set operations, and keeps what the first that went wrong has done.
class LawTest {
  public:
    boolean::Options options;

    double volume(auto operation, std::span<const mesh::Mesh> operands, const char* name) {
        Context context;
        context.threads = 1;
        const Result<boolean::Evaluated> result = operation(operands, options, context);
        require(result.has_value(), name, result ? "" : result.error().sentence);
        if (!result) return 0;
        const std::string defect = manifold_defect(result->mesh);
        require(defect.empty(), name, defect);
        return defect.empty() ? volume_of(result->mesh) : 0;
    }
    void require_equal(double x, double y, const char* law) {
        require(std::fabs(x - y) < 1e-6, law, std::to_string(x) + " is not " + std::to_string(y));
    }
    const std::string& broken() const { return broken_; }

  private:
    void require(bool holds, const std::string& what, const std::string& why) {
        if (!holds && broken_.empty()) broken_ = what + ": " + why;
    }
    std::string broken_;
};

/// The first law that operations on what the bytes stand for break, and how; empty where all hold.
inline std::string broken_law(std::span<const std::uint8_t> data) {
    Bytes bytes(data);
    LawTest test;
    test.options.simplify = bytes.next(2) ? boolean::Simplify::coplanar : boolean::Simplify::none;
    const mesh::Mesh first = read_operand(bytes), second = read_operand(bytes);
    const std::vector<mesh::Mesh> pair{first, second}, swapped{second, first};
    const auto unite = boolean::unite, intersect = boolean::intersect, subtract = boolean::subtract,
               symmetric_difference = boolean::symmetric_difference;
    const double a = test.volume(unite, {&first, 1}, "A"), b = test.volume(unite, {&second, 1}, "B"),
                 either = test.volume(unite, pair, "A + B"), both = test.volume(intersect, pair, "A * B");
    test.require_equal(either + both, a + b, "|A + B| + |A * B| = |A| + |B|");
    test.require_equal(test.volume(subtract, pair, "A - B"), a - both, "|A - B| = |A| - |A * B|");
    test.require_equal(test.volume(symmetric_difference, pair, "A xor B"), either - both,
                       "|A xor B| = |A + B| - |A * B|");
    test.require_equal(test.volume(unite, swapped, "B + A"), either, "|B + A| = |A + B|");
    test.require_equal(test.volume(intersect, swapped, "B * A"), both, "|B * A| = |A * B|");
    // A tolerance moves surfaces, but opens nothing.
    test.options.tolerance = {0.001 * (1 + bytes.next(50)), boolean::Tolerance::Of::size};
    test.volume(unite, pair, "A + B with a tolerance");
    test.volume(subtract, pair, "A - B with a tolerance");
    return test.broken();
}

}  // namespace octavo::tests
