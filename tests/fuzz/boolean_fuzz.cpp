// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <vector>

#include <octavo/boolean/evaluate.hpp>

// Any bytes as closed operands on a small grid, where everything coincides all the time, and a set operation on them.
// The result must be closed, oriented, a manifold, the same however the operands are ordered, and its volume must
// agree with that of the other operations: |A ∪ B| + |A ∩ B| = |A| + |B|, |A ⊕ B| = |A ∪ B| - |A ∩ B|,
// |A \ B| = |A| - |A ∩ B|, where |X| is the volume of where X winds at least once.

namespace {

using namespace octavo;

class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    unsigned next(unsigned below) { return at_ == end_ ? 0 : *at_++ % below; }
    bool done() const { return at_ == end_; }

  private:
    const std::uint8_t *at_, *end_;
};

Vec3 read_point(Bytes& bytes) {
    const unsigned x = bytes.next(4), y = bytes.next(4), z = bytes.next(4);
    return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

void add_tetrahedron(Bytes& bytes, mesh::Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int corner = 0; corner < 4; ++corner) mesh.vertices.push_back(read_point(bytes));
    for (const mesh::Triangle& t : {mesh::Triangle{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}})
        mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

/// Quadrilaterals all round, each cut in two along either diagonal. With corners anywhere they are not flat; of a
/// parallelepiped they are.
void add_hexahedron(Bytes& bytes, mesh::Mesh& mesh) {
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
mesh::Mesh read_operand(Bytes& bytes) {
    mesh::Mesh mesh;
    const unsigned parts = 1 + bytes.next(4);
    for (unsigned part = 0; part < parts; ++part) {
        bytes.next(2) ? add_hexahedron(bytes, mesh) : add_tetrahedron(bytes, mesh);
    }
    return mesh;
}

double volume_of(const mesh::Mesh& mesh) {
    double volume = 0;
    for (const mesh::Triangle& t : mesh.triangles)
        volume += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    return volume;
}

void require(bool condition) {
    if (!condition) std::abort();
}

void require_manifold(const mesh::Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> next;  // directed edge → third corner
    std::vector<std::uint32_t> corners(mesh.vertices.size(), 0);
    for (const mesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            ++corners.at(t[k]);
            require(next.emplace(std::pair{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]).second);
        }
    std::vector<char> seen(mesh.vertices.size(), 0);
    for (const auto& [edge, third] : next) {
        require(next.count({edge.second, edge.first}) == 1);
        if (seen[edge.first]++) continue;
        std::uint32_t fan = 0, at = edge.second;
        do {
            at = next.at({edge.first, at});
        } while (++fan < corners[edge.first] && at != edge.second);
        require(at == edge.second && fan == corners[edge.first]);
    }
}

double evaluate(Result<boolean::Evaluated> result) {
    require(result.has_value());
    require_manifold(result->mesh);
    return volume_of(result->mesh);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    if (size < 26) return 0;
    boolean::Options options;
    options.simplify = bytes.next(2) ? boolean::Simplify::coplanar : boolean::Simplify::none;
    Context context;
    context.threads = 1;
    const std::vector<mesh::Mesh> pair{read_operand(bytes), read_operand(bytes)};
    const std::vector<mesh::Mesh> swapped{pair[1], pair[0]};
    const auto volume = [&](auto operation, std::span<const mesh::Mesh> operands) {
        return evaluate(operation(operands, options, context));
    };
    const double a = volume(boolean::unite, {&pair[0], 1}), b = volume(boolean::unite, {&pair[1], 1});
    const double either = volume(boolean::unite, pair), both = volume(boolean::intersect, pair);
    const auto near = [](double x, double y) { return std::fabs(x - y) < 1e-6; };
    require(near(either + both, a + b));
    require(near(volume(boolean::subtract, pair), a - both));
    require(near(volume(boolean::symmetric_difference, pair), either - both));
    require(near(volume(boolean::unite, swapped), either) && near(volume(boolean::intersect, swapped), both));
    // A tolerance moves surfaces, but opens nothing.
    options.tolerance = {0.001 * (1 + bytes.next(50)), boolean::Tolerance::Of::size};
    volume(boolean::unite, pair);
    volume(boolean::subtract, pair);
    return 0;
}
