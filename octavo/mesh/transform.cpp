// SPDX-License-Identifier: Apache-2.0
#include <numbers>
#include <utility>

#include <octavo/base/check.hpp>
#include <octavo/mesh/transform.hpp>

namespace octavo::mesh {

Mesh transform(const Mesh& mesh, const Affine& map) {
    Mesh result = mesh;
    for (Vec3& vertex : result.vertices) vertex = map(vertex);
    return map.mirrors() ? flipped(std::move(result)) : result;
}

Mesh flipped(Mesh mesh) {
    for (Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
}

Mesh join(std::span<const Mesh> meshes) {
    Mesh result;
    std::size_t vertices = 0, triangles = 0;
    for (const Mesh& mesh : meshes) vertices += mesh.vertices.size(), triangles += mesh.triangles.size();
    OCTAVO_CHECK(vertices < ~VertexIndex{0}, "the joined mesh has more vertices than an index can name");
    result.vertices.reserve(vertices);
    result.triangles.reserve(triangles);
    result.sources.reserve(triangles);
    for (std::size_t operand = 0; operand < meshes.size(); ++operand) {
        const Mesh& mesh = meshes[operand];
        const auto base = static_cast<VertexIndex>(result.vertices.size());
        result.vertices.insert(result.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
            const Triangle& t = mesh.triangles[face];
            result.triangles.push_back({base + t[0], base + t[1], base + t[2]});
            result.sources.push_back(mesh.sources.empty() ? Source{static_cast<std::uint32_t>(operand),
                                                                   static_cast<FaceIndex>(face)}
                                                          : mesh.sources[face]);
        }
    }
    return result;
}

Affine translation(Vec3 offset) {
    Affine map;
    for (int row = 0; row < 3; ++row) map.m[row][3] = offset[row];
    return map;
}

Affine scaling(Vec3 factors) {
    Affine map;
    for (int row = 0; row < 3; ++row) map.m[row][row] = factors[row];
    return map;
}

Affine rotation(Vec3 axis, double degrees) {
    OCTAVO_CHECK(length(axis) > 0, "a rotation needs an axis that is not zero");
    const Vec3 u = (1 / length(axis)) * axis;
    // Quarter turns are taken off before the sine sees them: sin and cos of multiples of 90° come out exact.
    const double quarters = std::nearbyint(degrees / 90);
    const double rest = (degrees - 90 * quarters) * std::numbers::pi / 180;
    double c = std::cos(rest), s = std::sin(rest);
    for (int turn = static_cast<int>(std::fmod(quarters, 4) + 4) % 4; turn > 0; --turn)
        c = std::exchange(s, c) * -1;
    const double k = 1 - c;
    Affine map;
    map.m[0] = {c + k * u.x * u.x, k * u.x * u.y - s * u.z, k * u.x * u.z + s * u.y, 0};
    map.m[1] = {k * u.x * u.y + s * u.z, c + k * u.y * u.y, k * u.y * u.z - s * u.x, 0};
    map.m[2] = {k * u.x * u.z - s * u.y, k * u.y * u.z + s * u.x, c + k * u.z * u.z, 0};
    return map;
}

}  // namespace octavo::mesh
