// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <system_error>
#include <utility>

#include <unistd.h>

#include <octavo/io/openfoam.hpp>
#include <octavo/io/output.hpp>
#include <octavo/mesh/material_names.hpp>

namespace octavo::io {
namespace {

namespace fs = std::filesystem;

/// The words that name patches and zones: one for each name that occurs, of zones first.
std::map<std::string, std::string> words_of(const mesh::PolyhedralMesh& mesh) {
    std::vector<std::string> names;
    for (const mesh::PolyhedralMesh::Zone& zone : mesh.zones) names.push_back(zone.name);
    for (const mesh::PolyhedralMesh::Patch& patch : mesh.patches)
        if (std::find(names.begin(), names.end(), patch.name) == names.end()) names.push_back(patch.name);
    const std::vector<std::string> words = mesh::distinct_names(names, mesh::word_rules());
    std::map<std::string, std::string> word_of;
    for (std::size_t i = 0; i < names.size(); ++i) word_of[names[i]] = words[i];
    return word_of;
}

void begin(Output& output, const char* type, const char* object, const std::string& note = {}) {
    output.append("FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ");
    output.append(type);
    output.append(";\n");
    if (!note.empty()) output.append("    note        \"" + note + "\";\n");
    output.append("    location    \"constant/polyMesh\";\n    object      ");
    output.append(object);
    output.append(";\n}\n\n");
}

template <class List, class WriteOne>
void write_list(Output& output, const List& list, const WriteOne& write_one) {
    output.append_number(std::uint64_t{list.size()});
    output.append("\n(\n");
    for (const auto& entry : list) {
        write_one(entry);
        output.append('\n');
    }
    output.append(")\n");
}

std::string note_of(const mesh::PolyhedralMesh& mesh) {
    return "nPoints:" + std::to_string(mesh.points.size()) + "  nCells:" + std::to_string(mesh.cells) +
           "  nFaces:" + std::to_string(mesh.owner.size()) +
           "  nInternalFaces:" + std::to_string(mesh.neighbour.size());
}

void write_points(Output& output, const mesh::PolyhedralMesh& mesh) {
    begin(output, "vectorField", "points");
    write_list(output, mesh.points, [&](const Vec3& p) {
        output.append('(');
        output.append_number(p.x);
        output.append(' ');
        output.append_number(p.y);
        output.append(' ');
        output.append_number(p.z);
        output.append(')');
    });
}

void write_faces(Output& output, const mesh::PolyhedralMesh& mesh) {
    begin(output, "faceList", "faces");
    std::size_t face = 0;
    write_list(output, mesh.owner, [&](std::uint32_t) {
        const std::uint32_t first = mesh.face_begin[face], end = mesh.face_begin[face + 1];
        ++face;
        output.append_number(std::uint64_t{end - first});
        for (std::uint32_t i = first; i < end; ++i) {
            output.append(i == first ? '(' : ' ');
            output.append_number(std::uint64_t{mesh.face_points[i]});
        }
        output.append(')');
    });
}

void write_labels(Output& output, const char* object, const std::vector<std::uint32_t>& labels,
                  const std::string& note) {
    begin(output, "labelList", object, note);
    write_list(output, labels, [&](std::uint32_t label) { output.append_number(std::uint64_t{label}); });
}

void write_boundary(Output& output, const mesh::PolyhedralMesh& mesh) {
    const std::map<std::string, std::string> words = words_of(mesh);
    begin(output, "polyBoundaryMesh", "boundary");
    write_list(output, mesh.patches, [&](const mesh::PolyhedralMesh::Patch& patch) {
        output.append("    " + words.at(patch.name) +
                      "\n    {\n        type            patch;\n        nFaces          " +
                      std::to_string(patch.faces) + ";\n        startFace       " +
                      std::to_string(patch.first_face) + ";\n    }");
    });
}

void write_zones(Output& output, const mesh::PolyhedralMesh& mesh) {
    const std::map<std::string, std::string> words = words_of(mesh);
    begin(output, "regIOobject", "cellZones");
    write_list(output, mesh.zones, [&](const mesh::PolyhedralMesh::Zone& zone) {
        output.append(words.at(zone.name) + "\n{\n    type cellZone;\n    cellLabels      List<label>\n");
        write_list(output, zone.cells,
                   [&](std::uint32_t cell) { output.append_number(std::uint64_t{cell}); });
        output.append(";\n}");
    });
}

void write_levels(Output& output, const mesh::PolyhedralMesh& mesh) {
    begin(output, "labelList", "cellLevel");
    write_list(output, mesh.cell_level,
               [&](int level) { output.append_number(static_cast<std::uint64_t>(level)); });
}

Error trouble(const fs::path& path, const std::error_code& code) {
    Place place;
    place.file = path.string();
    return {ErrorCode::io, "cannot be written: " + code.message(), std::move(place)};
}

/// A folder that is written to, with those on the way to it. Unless it is moved to its place it is removed, and those that
/// were made for it.
class PartFolder {
  public:
    explicit PartFolder(fs::path path) : path_(std::move(path)) {
        std::error_code ignored;
        for (fs::path above = path_.parent_path(); !above.empty() && !fs::exists(above, ignored);
             above = above.parent_path())
            made_.push_back(above);
    }
    PartFolder(const PartFolder&) = delete;
    PartFolder& operator=(const PartFolder&) = delete;
    ~PartFolder() {
        if (is_moved_) return;
        std::error_code ignored;
        fs::remove_all(path_, ignored);
        for (const fs::path& folder : made_)
            fs::remove(folder, ignored);  // fails where others wrote meanwhile
    }

    const fs::path& path() const { return path_; }
    std::error_code make() const {
        std::error_code code;
        fs::create_directories(path_, code);
        return code;
    }
    /// What is at the place stays whole until the folder is there instead.
    std::error_code move_to(const fs::path& place) {
        std::error_code code, ignored;
        fs::path old = path_;
        old += ".old";
        const bool replaces = fs::exists(fs::symlink_status(place, ignored));
        if (replaces) fs::rename(place, old, code);
        if (code) return code;
        fs::rename(path_, place, code);
        is_moved_ = !code;
        if (!replaces) return code;
        if (code)
            fs::rename(old, place, ignored);
        else
            fs::remove_all(old, ignored);
        return code;
    }

  private:
    fs::path path_;
    std::vector<fs::path> made_;  ///< from the innermost
    bool is_moved_ = false;
};

}  // namespace

Result<WriteReport> write_openfoam(const std::string& path, const mesh::PolyhedralMesh& mesh,
                                   const Context& context) {
    if (path == "-")
        return Error{
            ErrorCode::unsupported, "an OpenFOAM mesh is a folder and cannot go to standard output", {}};
    const fs::path constant = fs::path(path) / "constant", final = constant / "polyMesh";
    PartFolder part(constant / ("polyMesh." + std::to_string(::getpid()) + ".part"));
    if (const std::error_code code = part.make()) return trouble(part.path(), code);

    WriteReport report;
    report.format = "openfoam";
    const std::string note = note_of(mesh);
    const std::array<std::pair<const char*, std::function<void(Output&)>>, 7> files{{
        {"points", [&](Output& output) { write_points(output, mesh); }},
        {"faces", [&](Output& output) { write_faces(output, mesh); }},
        {"owner", [&](Output& output) { write_labels(output, "owner", mesh.owner, note); }},
        {"neighbour", [&](Output& output) { write_labels(output, "neighbour", mesh.neighbour, note); }},
        {"boundary", [&](Output& output) { write_boundary(output, mesh); }},
        {"cellZones", [&](Output& output) { write_zones(output, mesh); }},
        {"cellLevel", [&](Output& output) { write_levels(output, mesh); }},
    }};
    for (const auto& [name, write] : files) {
        const bool has_levels = mesh.cell_level.size() == mesh.cells;
        if (!has_levels && std::string_view(name) == "cellLevel") continue;
        Result<Output> output = Output::to_file((part.path() / name).string());
        Status status = Done{};
        if (output) {
            write(*output);
            report.bytes += output->size();
            status = output->commit();
        } else {
            status = output.error();
        }
        if (context.cancelled()) status = Context::cancelled_error();
        if (!status) return status.error();
    }
    if (const std::error_code code = part.move_to(final)) return trouble(final, code);
    return report;
}

}  // namespace octavo::io
