// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_solids.hpp"

#include <span>
#include <utility>

#include <fmt/format.h>

#include <octavo/boolean/expression.hpp>
#include <octavo/mesh/measure.hpp>

#include "file_faces.hpp"
#include "model.hpp"
#include "number_text.hpp"

namespace octavo::cli {
namespace {

Result<mesh::Mesh> read_csg_solid(Session& session, const Context& context, const std::string& path,
                                  const io::CsgReadOptions& csg) {
    const Result<io::CsgFile> file = read_csg(session, context, path, csg);
    if (!file) return file.error();
    Result<boolean::Evaluated> evaluated =
        session.timed("evaluate", [&] { return boolean::evaluate(file->expression, {}, context); });
    if (!evaluated) return in_file(std::move(evaluated).error(), path);
    session.warn(evaluated->report.warnings);
    return std::move(evaluated->mesh);
}

/// What the user should know of a solid that was made anew.
std::string united_text(Session& session, const std::string& path, const Error& refusal, double before,
                        double after) {
    const std::vector<std::uint32_t> near =
        faces_of_file(refusal.place.faces, session.polygon_of_triangle[path]);
    std::string text = fmt::format(
        "{}: the surface overlaps itself or has parts inside out{}; the mesh is of its exact union, of "
        "volume "
        "{}",
        path, near.empty() ? "" : fmt::format(", near facet {}", near.front()), number_text(after));
    if (number_text(before) != number_text(after))
        text += fmt::format(" (its integral, which counts overlaps twice, is {})", number_text(before));
    return text;
}

}  // namespace

Result<std::vector<mesh::Mesh>> read_solids(Session& session, const Context& context,
                                            const std::vector<std::string>& paths,
                                            const io::CsgReadOptions& csg) {
    std::vector<mesh::Mesh> solids;
    for (const std::string& path : paths) {
        if (kind_of(path, "") == ModelKind::csg) {
            Result<mesh::Mesh> solid = read_csg_solid(session, context, path, csg);
            if (!solid) return std::move(solid).error();
            solids.push_back(std::move(*solid));
            continue;
        }
        Result<io::ReadMesh> read = read_surface(session, context, path);
        if (!read) return std::move(read).error();
        solids.push_back(std::move(read->mesh));
    }
    return solids;
}

Result<bool> unite_with_nothing(Session& session, const Context& context, const std::string& path,
                                const Error& refusal, const boolean::Options& options, mesh::Mesh& solid) {
    const double before = mesh::moments(solid).volume;
    if (before <= 0) return false;
    Result<boolean::Evaluated> united = session.timed(
        "unite", [&] { return boolean::unite(std::span<const mesh::Mesh>(&solid, 1), options, context); });
    if (!united && united.error().code == ErrorCode::cancelled) return united.error();
    if (!united || united->mesh.triangles.empty()) return false;
    session.warn(united_text(session, path, refusal, before, mesh::moments(united->mesh).volume));
    session.warn(united->report.warnings);
    solid = std::move(united->mesh);
    return true;
}

}  // namespace octavo::cli
