// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/ply.hpp>

namespace octavo::io {
namespace {

bool holds_floats_only(const mesh::Mesh& mesh) {
    for (const Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis)
            if (double{static_cast<float>(vertex[axis])} != vertex[axis]) return false;
    return true;
}

template <class Real>
void write_binary(Output& output, const mesh::Mesh& mesh) {
    for (const Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) output.append_binary(static_cast<Real>(vertex[axis]));
    for (const mesh::Triangle& triangle : mesh.triangles) {
        output.append_binary(std::uint8_t{3});
        for (const mesh::VertexIndex vertex : triangle) output.append_binary(vertex);
    }
}

void write_text(Output& output, const mesh::Mesh& mesh) {
    for (const Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) {
            output.append_number(vertex[axis]);
            output.append(axis < 2 ? ' ' : '\n');
        }
    for (const mesh::Triangle& triangle : mesh.triangles) {
        output.append('3');
        for (const mesh::VertexIndex vertex : triangle) {
            output.append(' ');
            output.append_number(std::uint64_t{vertex});
        }
        output.append('\n');
    }
}

}  // namespace

Result<WriteReport> write_ply(Output& output, const mesh::Mesh& mesh, const WriteOptions& options) {
    const bool floats = holds_floats_only(mesh);
    const char* const real = floats ? "float" : "double";
    // Some readers know "int" only, so "uint" is used only where it is needed.
    const char* const index = mesh.vertices.size() > 0x80000000u ? "uint" : "int";
    output.append(options.encoding == Encoding::ascii ? "ply\nformat ascii 1.0\n"
                                                      : "ply\nformat binary_little_endian 1.0\n");
    output.append("comment " + std::string(own_comment) + "\nelement vertex ");
    output.append_number(std::uint64_t{mesh.vertices.size()});
    for (const char* const axis : {"x", "y", "z"}) {
        output.append(std::string("\nproperty ") + real + ' ' + axis);
    }
    output.append("\nelement face ");
    output.append_number(std::uint64_t{mesh.triangles.size()});
    output.append(std::string("\nproperty list uchar ") + index + " vertex_indices\nend_header\n");
    if (options.encoding == Encoding::ascii) {
        write_text(output, mesh);
    } else if (floats) {
        write_binary<float>(output, mesh);
    } else {
        write_binary<double>(output, mesh);
    }
    return WriteReport{};
}

}  // namespace octavo::io
