// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string_view>
#include <system_error>
#include <vector>

#include <octavo/io/openfoam.hpp>
#include <octavo/io/openfoam_case.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/part_folder.hpp>
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

struct Location {
    std::string_view folder = "constant/polyMesh", note = "";
};

void begin(Output& output, std::string_view type, std::string_view object, const Location& location = {}) {
    output.append("FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       ");
    output.append(type);
    output.append(";\n");
    if (!location.note.empty()) output.append("    note        \"" + std::string(location.note) + "\";\n");
    output.append("    location    \"" + std::string(location.folder) + "\";\n    object      ");
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
    begin(output, "labelList", object, {.note = note});
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

struct File {
    const char* name;
    std::function<void(Output&)> write;
};

/// The files of a mesh, as its folder has them.
std::vector<File> files_of(const mesh::PolyhedralMesh& mesh) {
    std::vector<File> files{
        {"points", [&](Output& output) { write_points(output, mesh); }},
        {"faces", [&](Output& output) { write_faces(output, mesh); }},
        {"owner", [&](Output& output) { write_labels(output, "owner", mesh.owner, note_of(mesh)); }},
        {"neighbour",
         [&](Output& output) { write_labels(output, "neighbour", mesh.neighbour, note_of(mesh)); }},
        {"boundary", [&](Output& output) { write_boundary(output, mesh); }},
        {"cellZones", [&](Output& output) { write_zones(output, mesh); }}};
    if (mesh.cell_level.size() == mesh.cells)
        files.push_back({"cellLevel", [&](Output& output) { write_levels(output, mesh); }});
    return files;
}

/// Whether a mesh has such a file, packed or not: those of another mesh must go.
bool is_of_mesh(std::string_view name) {
    if (name.ends_with(".gz")) name.remove_suffix(3);
    constexpr std::array<std::string_view, 7> names{"points",   "faces",     "owner",    "neighbour",
                                                    "boundary", "cellZones", "cellLevel"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

Status write_file(const fs::path& path, const std::function<void(Output&)>& write, WriteReport& report,
                  const Context& context) {
    Result<Output> output = Output::to_file(path.string(), context);
    if (!output) return std::move(output).error();
    write(*output);
    report.bytes += output->size();
    if (context.cancelled()) return Context::cancelled_error();
    return output->commit();
}

std::string warning_of(const std::vector<std::string>& kept, const fs::path& place) {
    std::string names;
    for (const std::string& name : kept) names += (names.empty() ? "" : ", ") + name;
    return place.string() + " keeps what others put there: " + names + "; it may be of another mesh";
}

/// Those that the case does not have.
Status write_dictionaries(const fs::path& system, PartFolder& part, WriteReport& report,
                          const Context& context) {
    if (Status made = part.make_folder(system); !made) return made;
    for (const OpenfoamDictionary& dictionary : openfoam_dictionaries()) {
        const fs::path path = system / dictionary.name;
        std::error_code ignored;
        if (fs::exists(fs::symlink_status(path, ignored))) continue;
        const auto write = [&](Output& output) {
            begin(output, "dictionary", dictionary.name, {.folder = "system"});
            output.append(dictionary.content);
        };
        if (Status written = write_file(path, write, report, context); !written) return written;
        part.made(path);
    }
    return Done{};
}

}  // namespace

Result<WriteReport> write_openfoam(const std::string& path, const mesh::PolyhedralMesh& mesh,
                                   const Context& context) {
    if (path == "-")
        return Error{
            ErrorCode::unsupported, "an OpenFOAM mesh is a folder and cannot go to standard output", {}};
    const fs::path place = fs::path(path) / "constant" / "polyMesh";
    PartFolder part(place);
    if (Status made = part.make(); !made) return std::move(made).error();
    WriteReport report;
    report.format = "openfoam";
    for (const File& file : files_of(mesh))
        if (Status written = write_file(part.path() / file.name, file.write, report, context); !written)
            return std::move(written).error();
    if (Status written = write_dictionaries(fs::path(path) / "system", part, report, context); !written)
        return std::move(written).error();
    const Result<std::vector<std::string>> kept = part.commit(is_of_mesh);
    if (!kept) return kept.error();
    if (!kept->empty()) report.warnings.push_back(warning_of(*kept, place));
    return report;
}

}  // namespace octavo::io
