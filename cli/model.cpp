// SPDX-License-Identifier: Apache-2.0
#include "model.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <octavo/base/counted.hpp>
#include <octavo/boolean/expression.hpp>
#include <octavo/bp_octree/to_mesh.hpp>
#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/classic/to_mesh.hpp>
#include <octavo/io/assimp_import.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/vtu.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/octree/oct_format.hpp>

#include "interruption.hpp"

namespace octavo::cli {
namespace {

/// The error for a model of a kind that the verb does not take; that it cannot be opened at all comes first.
Error unsupported(const std::string& path, std::string sentence) {
    if (path != "-" && ::access(path.c_str(), R_OK) != 0)
        if (const Result<io::ByteBlock> file = io::read_bytes(path); !file) return file.error();
    return in_file({ErrorCode::unsupported, std::move(sentence), {}}, path);
}

Result<io::ReadMesh> polyhedron_of_csg(Session& session, const Context& context, const std::string& path,
                                       const SurfaceOptions& options) {
    Result<io::CsgFile> file = read_csg(session, context, path, {.faceted = true});
    if (!file) return std::move(file).error();
    Result<boolean::Evaluated> evaluated =
        session.timed("evaluate", [&] { return boolean::evaluate(file->expression, {}, context); });
    if (!evaluated) return in_file(std::move(evaluated).error(), path);
    session.warn(evaluated->report.warnings);
    io::ReadMesh read;
    read.format = "csg";
    read.mesh = std::move(evaluated->mesh);
    if (!options.keep_sources) read.mesh.sources.clear();
    read.polygons = read.mesh.triangles.size();
    return read;
}

Result<io::ReadMesh> boundary_of_octree(Session& session, const Context& context, const std::string& path) {
    Result<octree::Octree> tree = read_octree(session, context, path, "oct");
    if (!tree) return std::move(tree).error();
    Result<mesh::Mesh> boundary =
        session.timed("to_mesh", [&] { return classic::to_mesh(*tree, {}, context); });
    if (!boundary) return in_file(std::move(boundary).error(), path);
    if (boundary->triangles.empty()) session.warn("no cell of the octree is black, so its boundary is empty");
    io::ReadMesh read;
    read.format = "oct";
    read.mesh = std::move(*boundary);
    read.polygons = read.mesh.triangles.size();
    return read;
}

Result<io::ReadMesh> triangles_of_bp_octree(Session& session, const Context& context,
                                            const std::string& path) {
    Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, path);
    if (!file) return std::move(file).error();
    io::ReadMesh read;
    read.format = "bpo";
    read.mesh = bp_octree::exact_mesh(file->tree);
    read.polygons = read.mesh.triangles.size();
    return read;
}

Result<io::ReadMesh> faces_of_bsp_octree(Session& session, const Context& context, const std::string& path) {
    session.inputs.push_back(path);
    Result<bsp_octree::BspOctree> tree =
        session.timed("read", [&] { return bsp_octree::read_bso(path, context); });
    if (!tree) return std::move(tree).error();
    Result<bsp_octree::ToMesh> made =
        session.timed("to_mesh", [&] { return bsp_octree::to_mesh(*tree, context); });
    if (!made) return in_file(std::move(made).error(), path);
    io::ReadMesh read;
    read.format = "bso";
    read.mesh = std::move(made->mesh);
    read.polygons = read.mesh.triangles.size();
    return read;
}

std::string check_model_format(const std::string& text) {
    const std::string name = io::extension_of("." + text);
    if (io::mesh_format_named(name) || kind_of("", name) != ModelKind::mesh || io::assimp_reads(name))
        return "";
    return fmt::format("must be {}, csg, oct, bpo, bso, {}, not {}", io::mesh_format_names(),
                       fmt::join(io::assimp_formats(), ", "), text);
}

ModelKind kind_on_stdin() {
    Context context;
    context.cancel = &interruption();
    const Bytes begin = io::beginning_of_stdin(context);
    const std::span<const std::uint8_t> bytes(reinterpret_cast<const std::uint8_t*>(begin.data()),
                                              begin.size());
    if (octree::looks_like_oct(bytes)) return ModelKind::octree;
    if (bp_octree::looks_like_bpo(bytes)) return ModelKind::bp_octree;
    if (bsp_octree::looks_like_bso(bytes)) return ModelKind::bsp_octree;
    return ModelKind::mesh;
}

}  // namespace

ModelKind kind_of(const std::string& path, const std::string& format) {
    if (path == "-" && format.empty()) return kind_on_stdin();
    const std::string extension = io::extension_of(format.empty() ? path : "." + format);
    if (extension == "csg") return ModelKind::csg;
    if (extension == "oct") return ModelKind::octree;
    if (extension == "bpo") return ModelKind::bp_octree;
    if (extension == "bso") return ModelKind::bsp_octree;
    return ModelKind::mesh;
}

void add_from_option(Verb* verb, std::string& format, const std::string& what,
                     const std::vector<std::string>& formats) {
    const std::string help = "Format of " + what + ", instead of by its extension";
    std::string words;
    for (const io::Format& mesh : io::mesh_formats()) words += std::string(mesh.name) + "|";
    for (const auto& [name, heading] : {std::pair("--from", "Options"), std::pair("--format", "")}) {
        Option* option = verb->add_option(name, format, help)->group(heading);
        if (formats.empty())
            option->check(check_model_format)->type_name(words + "csg|oct|bpo|bso|...");
        else
            take_one_of(option, formats);
    }
}

Result<io::ReadMesh> read_mesh(Session& session, const Context& context, const std::string& path,
                               const std::string& format) {
    session.inputs.push_back(path);
    switch (kind_of(path, format)) {
        case ModelKind::csg:
            return unsupported(path, "is a CSG tree, not a mesh; octavo convert makes a mesh of it");
        case ModelKind::octree:
        case ModelKind::bp_octree:
        case ModelKind::bsp_octree:
            return unsupported(path,
                               "is an octree, not a mesh; octavo stats tells what is in it, octavo convert "
                               "makes a mesh of it");
        case ModelKind::mesh:
            break;
    }
    io::ReadOptions options;
    options.format = format;
    Result<io::ReadMesh> read = session.timed("read", [&] { return io::read_mesh(path, options, context); });
    if (!read) return read;
    if (Status apart = check_files_of(session, path, read->beside); !apart) return std::move(apart).error();
    session.warn(read->warnings);
    if (!read->polygon_of_triangle.empty()) session.polygon_of_triangle[path] = read->polygon_of_triangle;
    return read;
}

Result<io::ReadMesh> read_surface(Session& session, const Context& context, const std::string& path,
                                  const std::string& format, const SurfaceOptions& options) {
    switch (kind_of(path, format)) {
        case ModelKind::csg:
            return polyhedron_of_csg(session, context, path, options);
        case ModelKind::octree:
            return boundary_of_octree(session, context, path);
        case ModelKind::bp_octree:
            return triangles_of_bp_octree(session, context, path);
        case ModelKind::bsp_octree:
            return faces_of_bsp_octree(session, context, path);
        case ModelKind::mesh:
            break;
    }
    return read_mesh(session, context, path, format);
}

Result<io::ReadMesh> read_operand(Session& session, const Context& context, const std::string& path,
                                  const std::string& format) {
    return kind_of(path, format) == ModelKind::octree ? read_mesh(session, context, path, format)
                                                      : read_surface(session, context, path, format);
}

Result<io::CsgFile> read_csg(Session& session, const Context& context, const std::string& path,
                             const io::CsgReadOptions& options) {
    session.inputs.push_back(path);
    Result<io::CsgFile> file = session.timed("read", [&] { return io::read_csg(path, options, context); });
    if (!file) return file;
    if (Status apart = check_files_of(session, path, file->files); !apart) return std::move(apart).error();
    session.warn(file->warnings);
    return file;
}

Result<octree::Octree> read_octree(Session& session, const Context& context, const std::string& path,
                                   const std::string& format) {
    session.inputs.push_back(path);
    if (path != "-" && kind_of(path, format) != ModelKind::octree &&
        !(format.empty() && io::extension_of(path).empty()))
        return unsupported(
            path,
            "is no octree (.oct, .bpo or .bso); octavo octree and octavo build make them, octavo "
            "info tells about meshes");
    return session.timed("read", [&] { return io::read_octree(path, context); });
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

void warn_of_losses(Session& session, const io::ReadMesh& read, const std::string& format) {
    const std::size_t kinds = read.left_behind.size();
    std::string list;
    for (std::size_t i = 0; i < kinds; ++i) {
        if (i > 0) list += i + 1 == kinds ? " and " : ", ";
        list += read.left_behind[i];
    }
    if (kinds > 0) session.warn("not kept: " + list);
    if (read.triangulated > 0)
        session.warn(fmt::format("{} became {} triangles", counted(read.triangulated, "polygon", "polygons"),
                                 grouped(read.mesh.triangles.size() - (read.polygons - read.triangulated))));
    // Files that state no unit are taken for millimetres, here and elsewhere.
    if (!read.unit.empty() && read.unit != "millimeter" && format != "3mf")
        session.warn(fmt::format("the unit is not kept: {}; {} states none", read.unit, format));
}

Result<io::WriteReport> write_mesh(Session& session, const Context& context, const std::string& path,
                                   const mesh::Mesh& mesh, const io::WriteOptions& options) {
    if (path == "-") session.stdout_taken = true;
    Result<io::WriteReport> report =
        session.timed("write", [&] { return io::write_mesh(path, mesh, options, context); });
    if (report) session.warn(report->warnings);
    return report;
}

Result<io::WriteReport> write_octree(Session& session, const Context& context, const std::string& path,
                                     const octree::Octree& tree, const std::string& format) {
    if (path == "-") session.stdout_taken = true;
    Result<io::WriteReport> report = session.timed("write", [&] {
        if (format == "htg") return io::write_hyper_tree_grid(path, tree, {}, context);
        if (format == "vtu") return io::write_vtu(path, tree, {}, context);
        return io::write_octree(path, tree, context);
    });
    if (report) session.warn(report->warnings);
    return report;
}

Result<mesh::Snapped> snap(Session& session, const mesh::Mesh& mesh) {
    Result<mesh::Snapped> snapped = session.timed("snap", [&] { return mesh::snap(mesh); });
    if (!snapped) return std::move(snapped).error();
    // Inside is where the surface winds about a point at least once: inside out, it winds minus once, or not at all.
    if (!classic::check_some_have_area(snapped->mesh))
        session.warn("none of the facets has any area, so nothing is inside");
    // The volume of an open surface depends on where the origin is, and says nothing.
    if (mesh::exact_volume6(snapped->mesh) < 0 && classic::open_edges(snapped->mesh).empty())
        session.warn(
            "the facets point inwards, so hardly anything counts as inside; octavo repair turns them over");
    return snapped;
}

void warn_of_closing(Session& session, const mesh::LatticeMesh& mesh) {
    const std::vector<classic::OpenEdge> edges = classic::open_edges(mesh);
    if (edges.empty()) return;
    const mesh::LatticeMesh closed = classic::close_holes(mesh, edges);
    session.warn("the surface is open; " +
                 counted(closed.triangles.size() - mesh.triangles.size(), "facet was", "facets were") +
                 " added to close it");
    if (mesh::exact_volume6(closed) < 0)
        session.warn("the facets point inwards, so hardly anything counts as inside the closed surface");
}

std::string rounding_text(double largest_displacement) {
    if (largest_displacement == 0) return "";
    return fmt::format("rounding   moved vertices to the lattice by at most {}\n",
                       number_text(largest_displacement));
}

Result<OnLattice> read_on_lattice(Session& session, const Context& context, const std::string& path,
                                  const std::string& format) {
    if (kind_of(path, format) == ModelKind::bp_octree) {
        Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, path);
        if (!file) return std::move(file).error();
        return OnLattice{std::move(file->tree.mesh), 0};
    }
    Result<io::ReadMesh> read = read_surface(session, context, path, format);
    if (!read) return std::move(read).error();
    Result<mesh::Snapped> snapped = snap(session, read->mesh);
    if (!snapped) return in_file(std::move(snapped).error(), path);
    return OnLattice{std::move(snapped->mesh), snapped->report.largest_displacement};
}

Error in_file(Error error, const std::string& path) {
    if (error.place.file.empty()) error.place.file = path;
    return error;
}

Error in_its_file(Error error, const std::vector<std::string>& paths, const std::vector<std::string>& names) {
    if (!error.place.operand || *error.place.operand >= paths.size()) return error;
    const std::size_t operand = *error.place.operand;
    error.place.operand.reset();
    if (!names.empty()) error.sentence.insert(0, names[operand] + " ");
    return in_file(std::move(error), paths[operand]);
}

}  // namespace octavo::cli
