// SPDX-License-Identifier: Apache-2.0
#include "model.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <octavo/mesh/measure.hpp>

namespace octavo::cli {

ModelKind kind_of(const std::string& path, const std::string& format) {
    std::string extension = format.empty() ? std::filesystem::path(path).extension().string() : "." + format;
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".csg") return ModelKind::csg;
    if (extension == ".oct") return ModelKind::octree;
    if (extension == ".bpo") return ModelKind::bp_octree;
    return ModelKind::mesh;
}

Result<io::ReadMesh> read_mesh(Session& session, const Context& context, const std::string& path,
                               const std::string& format) {
    session.inputs.push_back(path);
    io::ReadOptions options;
    options.format = format;
    Result<io::ReadMesh> read = session.timed("read", [&] { return io::read_mesh(path, options, context); });
    if (read) session.warn(read->warnings);
    return read;
}

Result<io::WriteReport> write_mesh(Session& session, const Context& context, const std::string& path,
                                   const mesh::Mesh& mesh, const io::WriteOptions& options) {
    if (path == "-") session.stdout_taken = true;
    Result<io::WriteReport> report =
        session.timed("write", [&] { return io::write_mesh(path, mesh, options, context); });
    if (report) session.warn(report->warnings);
    return report;
}

Result<mesh::Snapped> snap(Session& session, const mesh::Mesh& mesh) {
    Result<mesh::Snapped> snapped = session.timed("snap", [&] { return mesh::snap(mesh); });
    if (!snapped) return std::move(snapped).error();
    // Inside is where the surface winds about a point at least once: inside out, it winds minus once, or not at all.
    if (mesh::exact_volume6(snapped->mesh) < 0)
        session.warn(
            "the facets point inwards, so hardly anything counts as inside; octavo repair turns them over");
    return snapped;
}

Result<bp_octree::ReadBpo> read_bp_octree(Session& session, const Context& context, const std::string& path,
                                          const bp_octree::ReadBpoOptions& options) {
    session.inputs.push_back(path);
    Result<bp_octree::ReadBpo> read =
        session.timed("read", [&] { return bp_octree::read_bpo(path, options, context); });
    if (read && read->is_partial)
        session.warn(fmt::format("the file ends early; levels 0 to {} are there", read->tree.deepest()));
    return read;
}

Result<mesh::LatticeMesh> read_on_lattice(Session& session, const Context& context, const std::string& path,
                                          const std::string& format) {
    if (kind_of(path, format) == ModelKind::bp_octree) {
        Result<bp_octree::ReadBpo> read = read_bp_octree(session, context, path);
        if (!read) return std::move(read).error();
        return std::move(read->tree.mesh);
    }
    Result<io::ReadMesh> read = read_mesh(session, context, path, format);
    if (!read) return std::move(read).error();
    Result<mesh::Snapped> snapped = snap(session, read->mesh);
    if (!snapped) return in_file(std::move(snapped).error(), path);
    if (snapped->report.moved_vertices)
        session.warn(fmt::format(
            "{} of {} vertices were rounded to the lattice, by at most {:.3g}; the answers are exact for "
            "the rounded solid",
            grouped(snapped->report.moved_vertices), grouped(read->mesh.vertices.size()),
            snapped->report.largest_displacement));
    return std::move(snapped->mesh);
}

Error in_file(Error error, const std::string& path) {
    if (error.place.file.empty()) error.place.file = path;
    return error;
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return a != "-" && b != "-" && std::filesystem::equivalent(a, b, ignored);
}

Error would_overwrite(const std::string& path) {
    Error error{ErrorCode::io, "the output would overwrite the input; name another file", {}};
    error.place.file = path;
    return error;
}

std::string grouped(std::uint64_t number) {
    std::string digits = std::to_string(number);
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, " ");
    return digits;
}

}  // namespace octavo::cli
