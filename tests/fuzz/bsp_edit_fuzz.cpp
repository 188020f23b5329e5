// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/check.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/mesh/measure.hpp>

// Any bytes are a chain of set operations with tetrahedra and boxes on a small grid, where everything touches and
// coincides all the time. Where points lie that are in no plane of any of them, whole numbers say; the octree must say
// the same after every step. In the end it gives a mesh of its volume, and a file that gives itself again.

namespace {

using namespace octavo;
using bsp_octree::BspOctree;
using Grid = std::array<int, 3>;

constexpr int side = 6;   ///< of the grid
constexpr int finer = 8;  ///< points that are asked about are eighths
constexpr int lattice_bits = 4;

class Bytes {
  public:
    Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}
    int next(int below) {
        if (left_.empty()) return 0;
        const int value = left_[0] % below;
        left_ = left_.subspan(1);
        return value;
    }
    Grid point() { return {next(side + 1), next(side + 1), next(side + 1)}; }
    bool done() const { return left_.empty(); }

  private:
    std::span<const std::uint8_t> left_;
};

/// n · x <= d.
struct HalfSpace {
    std::array<std::int64_t, 3> n;
    std::int64_t d;

    /// Of a point in eighths.
    std::int64_t value(const Grid& eighths) const {
        return n[0] * eighths[0] + n[1] * eighths[1] + n[2] * eighths[2] - finer * d;
    }
};

struct Body {
    mesh::Mesh mesh;
    std::vector<HalfSpace> sides;
    bool has_volume = true;
};

HalfSpace half_space(const Grid& a, const Grid& b, const Grid& c) {
    std::array<std::int64_t, 3> u, v, n;
    for (std::size_t i = 0; i < 3; ++i) u[i] = b[i] - a[i], v[i] = c[i] - a[i];
    for (std::size_t i = 0; i < 3; ++i)
        n[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    return {n, n[0] * a[0] + n[1] * a[1] + n[2] * a[2]};
}

Body body_of(std::span<const Grid> corners, std::span<const mesh::Triangle> triangles) {
    Body body;
    for (const Grid& p : corners)
        body.mesh.vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    body.mesh.triangles.assign(triangles.begin(), triangles.end());
    for (const mesh::Triangle& t : triangles)
        body.sides.push_back(half_space(corners[t[0]], corners[t[1]], corners[t[2]]));
    return body;
}

Body read_tetrahedron(Bytes& bytes) {
    std::array<Grid, 4> p{bytes.point(), bytes.point(), bytes.point(), bytes.point()};
    const HalfSpace base = half_space(p[0], p[1], p[2]);
    const std::int64_t height = base.n[0] * p[3][0] + base.n[1] * p[3][1] + base.n[2] * p[3][2] - base.d;
    if (height > 0) std::swap(p[1], p[2]);
    constexpr mesh::Triangle sides[] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    Body body = body_of(p, sides);
    body.has_volume = height != 0;
    return body;
}

Body read_box(Bytes& bytes) {
    const Grid low{bytes.next(side), bytes.next(side), bytes.next(side)};
    Grid high;
    for (std::size_t axis = 0; axis < 3; ++axis) high[axis] = low[axis] + 1 + bytes.next(side - low[axis]);
    std::array<Grid, 8> p;
    for (std::size_t i = 0; i < 8; ++i)
        p[i] = {i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]};
    constexpr mesh::Triangle sides[] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                        {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    return body_of(p, sides);
}

/// Points that are in no plane so far, and whether they are in the solid.
struct Witnesses {
    std::vector<Grid> points;
    std::vector<char> inside;

    Witnesses() {
        for (int x = -3; x <= finer * side; x += 9)
            for (int y = -1; y <= finer * side; y += 7)
                for (int z = -2; z <= finer * side; z += 11) points.push_back({x, y, z});
        inside.resize(points.size());
    }

    void edit(const Body& body, int operation) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            bool is_in = body.has_volume, is_on = false;
            for (const HalfSpace& half : body.sides) {
                const std::int64_t value = half.value(points[i]);
                is_on = is_on || value == 0;
                is_in = is_in && value < 0;
            }
            if (is_on && body.has_volume) continue;
            const bool was = inside[i];
            points[kept] = points[i];
            inside[kept++] = operation == 0 ? was || is_in : operation == 1 ? was && !is_in : was && is_in;
        }
        points.resize(kept), inside.resize(kept);
    }

    void check(const BspOctree& solid) const {
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto eighth = [&](std::size_t axis) { return points[i][axis] / double{finer}; };
            const bsp::Position at = solid.classify({eighth(0), eighth(1), eighth(2)});
            OCTAVO_CHECK(at == (inside[i] ? bsp::Position::in : bsp::Position::out),
                         "a point is where the operands say");
        }
    }
};

void check_outcome(const BspOctree& solid) {
    const Result<bsp_octree::ToMesh> made = bsp_octree::to_mesh(solid);
    OCTAVO_CHECK(made.has_value(), "a solid has a mesh");
    const double volume = mesh::measure(made->mesh).volume, expected = bsp_octree::measure(solid).volume;
    OCTAVO_CHECK(std::abs(volume - expected) < 1e-6, "of its volume");
    const std::vector<std::uint8_t> bytes = bsp_octree::encode(solid);
    const Result<BspOctree> read = bsp_octree::decode(bytes);
    OCTAVO_CHECK(read && bsp_octree::encode(*read) == bytes, "and a file that gives itself again");
    OCTAVO_CHECK(solid.subtract(*read)->is_empty() && read->subtract(solid)->is_empty(), "and it");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    constexpr std::size_t most_bytes = 400;
    if (size > most_bytes) return 0;
    Bytes bytes(data, size);
    constexpr std::int64_t origin = -(std::int64_t{1} << 25);
    const exact::Lattice lattice = *exact::Lattice::from_parts(-lattice_bits, {origin, origin, origin});
    bsp_octree::MeshOptions options;
    options.octree.planes = static_cast<std::uint32_t>(1 + bytes.next(16));
    BspOctree solid(lattice, options.octree);
    Witnesses witnesses;
    while (!bytes.done()) {
        const int operation = bytes.next(3);
        const Body body = bytes.next(2) ? read_box(bytes) : read_tetrahedron(bytes);
        const Result<bsp_octree::Built> built =
            bsp_octree::build(body.mesh, lattice, options, {}, solid.shared_store());
        OCTAVO_CHECK(built.has_value(), "a convex body has an octree");
        const BspOctree& other = built->octree;
        solid = operation == 0   ? *solid.unite(other)
                : operation == 1 ? *solid.subtract(other)
                                 : *solid.intersect(other);
        witnesses.edit(body, operation);
        witnesses.check(solid);
    }
    check_outcome(solid);
    return 0;
}
