// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <octavo/base/counted.hpp>
#include <octavo/io/three_mf.hpp>
#include <octavo/io/three_mf_parts.hpp>
#include <octavo/io/zip.hpp>

namespace octavo::io {
namespace {

// Deflate packs XML of meshes 5 to 20 times, and anything at most about 1000 times; 200 leaves room for very
// regular meshes. Small files may grow to 16 MB in any case.
constexpr std::uint64_t most_growth = 200, always_allowed = std::uint64_t{1} << 24;

// Components of components of …; real files use two or three levels.
constexpr int deepest_nesting = 64;

const std::string core_namespace = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
const std::string model_relationship = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

Error bad(std::string sentence) { return {ErrorCode::bad_input, std::move(sentence), {}}; }

/// Reads the parts that are needed and puts the objects of the build into place.
class Assembler {
  public:
    Assembler(const ZipReader& archive, std::uint64_t size, const ReadOptions& options,
              const Context& context)
        : archive_(archive),
          limit_(std::max(always_allowed, size * most_growth)),
          options_(options),
          context_(context) {}

    Result<FileMesh> read() {
        const std::string root = root_part();
        if (root.empty()) return bad("holds no 3D model");
        Result<const ThreeMfPart*> part = part_named(root);
        if (!part) return part.error();
        result_.unit = (*part)->unit;
        result_.millimetres_per_unit = millimetres_in((*part)->unit);
        std::vector<ThreeMfPlacement> build = (*part)->build;
        if (build.empty()) build = objects_of_no_other(**part);
        for (const ThreeMfPlacement& item : build) {
            Result<const Object*> object = resolve(item, (*part)->name, 0);
            if (!object) return object.error();
            if ((*object)->data->type == "support" || (*object)->data->type == "solidsupport") {
                ++supports_;
                continue;
            }
            triangles_ += (*object)->triangles;
            if (triangles_ > options_.max_triangles) return more_than_allowed("triangles");
            vertices_ += (*object)->vertices;
            if (vertices_ > options_.max_triangles) return more_than_allowed("vertices");
            if (std::optional<Error> trouble = place(**object, item.transform)) return *trouble;
        }
        if (supports_ > 0)
            result_.warnings.push_back(counted(supports_, "support structure is", "support structures are") +
                                       " left out");
        note_what_is_left_behind();
        return std::move(result_);
    }

  private:
    /// An object whose components are known to exist and to be no circle.
    struct Object {
        const ThreeMfObject* data = nullptr;
        std::vector<std::pair<const Object*, Affine>> components;
        std::uint64_t triangles = 0, vertices = 0;  ///< with all components, saturated
        bool complete = false;
    };

    void note_what_is_left_behind() {
        if (meshes_ > 1) result_.leave_behind("objects");
        for (const auto& [name, part] : parts_)
            for (const std::string_view kind : part.left_behind) result_.leave_behind(kind);
        for (const ZipEntry& entry : archive_.entries())
            for (const char* extension : {".png", ".jpg", ".jpeg"})
                if (entry.name.ends_with(extension)) result_.leave_behind("pictures");
    }

    Error more_than_allowed(const char* what) const {
        return {ErrorCode::limit, "has more than " + std::to_string(options_.max_triangles) + " " + what, {}};
    }

    std::string root_part() const {
        if (const ZipEntry* relationships = archive_.find("_rels/.rels")) {
            if (Result<std::vector<std::byte>> xml = archive_.read(*relationships, limit_)) {
                const std::string target = three_mf_model_part(text_of(*xml));
                if (archive_.find(target)) return target;
            }
        }
        for (const ZipEntry& entry : archive_.entries())
            if (entry.name.ends_with(".model")) return entry.name;
        return {};
    }

    Result<const ThreeMfPart*> part_named(const std::string& name) {
        // Known parts come first: looking through the archive for each of very many items takes for ever.
        const auto as_named = parts_.find(name.starts_with('/') ? name.substr(1) : name);
        if (as_named != parts_.end()) return &as_named->second;
        const ZipEntry* const entry = archive_.find(name);
        if (!entry) return bad("has no part " + name);
        const auto known = parts_.find(entry->name);
        if (known != parts_.end()) return &known->second;
        if (context_.cancelled()) return Context::cancelled_error();
        context_.report("read", 0);
        const Result<std::vector<std::byte>> xml = archive_.read(*entry, limit_ - unpacked_);
        if (!xml) return xml.error();
        unpacked_ += xml->size();
        Result<ThreeMfPart> part = read_three_mf_part(text_of(*xml), entry->name);
        if (!part) return part.error();
        return &parts_.emplace(entry->name, std::move(*part)).first->second;
    }

    /// The object that a placement in the part `home` means, with everything below it.
    Result<const Object*> resolve(const ThreeMfPlacement& placement, const std::string& home, int depth) {
        if (depth > deepest_nesting)
            return Error{ErrorCode::limit,
                         "nests components more than " + std::to_string(deepest_nesting) + " deep",
                         {}};
        Result<const ThreeMfPart*> part = part_named(placement.part.empty() ? home : placement.part);
        if (!part) return part.error();
        const auto [at, is_new] = objects_.try_emplace({(*part)->name, placement.object});
        Object& object = at->second;
        if (object.complete) return &object;
        if (!is_new)
            return bad("the object " + std::to_string(placement.object) + " is a component of itself");
        const ThreeMfObject* const data = (*part)->find(placement.object);
        if (!data)
            return bad("the part " + (*part)->name + " has no object " + std::to_string(placement.object));
        object.data = data;
        object.triangles = data->triangles.size();
        object.vertices = data->vertices.size();
        for (const ThreeMfPlacement& component : data->components) {
            Result<const Object*> below = resolve(component, (*part)->name, depth + 1);
            if (!below) return below.error();
            // What holds no triangles is left out here, or placing it could take for ever.
            if ((*below)->triangles == 0) continue;
            object.components.emplace_back(*below, component.transform);
            object.triangles = std::min(object.triangles + (*below)->triangles, options_.max_triangles + 1);
            object.vertices = std::min(object.vertices + (*below)->vertices, options_.max_triangles + 1);
        }
        object.complete = true;
        return &object;
    }

    std::optional<Error> place(const Object& object, const Affine& transform) {
        const std::size_t first = result_.vertices.size();
        if (first + object.data->vertices.size() > std::numeric_limits<mesh::VertexIndex>::max())
            return Error{ErrorCode::limit, "has more than 4294967295 vertices", {}};
        meshes_ += !object.data->triangles.empty();
        const bool stays = transform == Affine{};
        for (const Vec3& vertex : object.data->vertices) {
            const Vec3 point = stays ? vertex : transform(vertex);
            if (!is_finite(point)) return bad("a transform moves a vertex beyond the range of numbers");
            result_.vertices.push_back(point);
        }
        const bool mirrors = transform.mirrors();
        for (mesh::Triangle triangle : object.data->triangles) {
            if (mirrors) std::swap(triangle[1], triangle[2]);
            for (mesh::VertexIndex& corner : triangle) corner += static_cast<mesh::VertexIndex>(first);
            result_.faces.add_triangle(triangle[0], triangle[1], triangle[2]);
        }
        for (const auto& [component, inner] : object.components) {
            if (context_.cancelled()) return Context::cancelled_error();
            if (std::optional<Error> trouble = place(*component, compose(transform, inner))) return trouble;
        }
        return {};
    }

    /// For files without a build list: the objects that are no component of others.
    std::vector<ThreeMfPlacement> objects_of_no_other(const ThreeMfPart& part) {
        std::vector<std::uint32_t> used;
        for (const ThreeMfObject& object : part.objects)
            for (const ThreeMfPlacement& component : object.components) used.push_back(component.object);
        std::sort(used.begin(), used.end());
        std::vector<ThreeMfPlacement> result;
        for (const ThreeMfObject& object : part.objects)
            if (!std::binary_search(used.begin(), used.end(), object.id))
                result.push_back({{}, object.id, {}});
        if (!result.empty()) result_.warnings.push_back("the build list is empty: all objects are taken");
        return result;
    }

    const ZipReader& archive_;
    std::uint64_t limit_;  ///< of all unpacked parts together
    std::uint64_t unpacked_ = 0;
    const ReadOptions& options_;
    const Context& context_;
    std::map<std::string, ThreeMfPart> parts_;
    std::map<std::pair<std::string, std::uint32_t>, Object> objects_;
    std::uint64_t triangles_ = 0, vertices_ = 0;
    std::size_t supports_ = 0, meshes_ = 0;  ///< left out, and put into place
    FileMesh result_;
};

void append_model(Output& xml, const mesh::Mesh& mesh, const std::string& unit) {
    xml.append("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"" + unit +
               "\" xml:lang=\"en-US\" xmlns=\"" + core_namespace +
               "\">\n<metadata name=\"Application\">Octavo</metadata>\n<resources>\n");
    if (!mesh.triangles.empty()) {
        xml.append("<object id=\"1\" type=\"model\"><mesh>\n<vertices>\n");
        for (const Vec3& vertex : mesh.vertices) {
            xml.append("<vertex x=\""), xml.append_number(vertex.x);
            xml.append("\" y=\""), xml.append_number(vertex.y);
            xml.append("\" z=\""), xml.append_number(vertex.z);
            xml.append("\"/>\n");
        }
        xml.append("</vertices>\n<triangles>\n");
        for (const mesh::Triangle& triangle : mesh.triangles) {
            xml.append("<triangle v1=\""), xml.append_number(std::uint64_t{triangle[0]});
            xml.append("\" v2=\""), xml.append_number(std::uint64_t{triangle[1]});
            xml.append("\" v3=\""), xml.append_number(std::uint64_t{triangle[2]});
            xml.append("\"/>\n");
        }
        xml.append("</triangles>\n</mesh></object>\n");
    }
    xml.append("</resources>\n<build>");
    if (!mesh.triangles.empty()) xml.append("<item objectid=\"1\"/>");
    xml.append("</build>\n</model>\n");
}

}  // namespace

Result<FileMesh> read_three_mf(Bytes bytes, const ReadOptions& options, const Context& context) {
    const Result<ZipReader> archive = ZipReader::open(bytes);
    if (!archive) return archive.error();
    return Assembler(*archive, bytes.size(), options, context).read();
}

Result<WriteReport> write_three_mf(Output& output, const mesh::Mesh& mesh, const WriteOptions& options) {
    if (millimetres_in(options.unit) == 0)
        return Error{ErrorCode::unsupported,
                     "3MF has no unit \"" + options.unit +
                         "\"; it has micron, millimeter, centimeter, inch, foot and meter",
                     {}};
    Output model = Output::to_memory();
    append_model(model, mesh, options.unit);
    const std::vector<std::byte> model_xml = std::move(model).take_memory();

    ZipWriter archive(output);
    const std::pair<std::string_view, std::string> small_parts[] = {
        {"[Content_Types].xml",
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
         "<Default Extension=\"rels\" "
         "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
         "<Default Extension=\"model\" "
         "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n"
         "</Types>\n"},
        {"_rels/.rels",
         "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
         "<Relationship Target=\"/3D/3dmodel.model\" Id=\"rel0\" Type=\"" +
             model_relationship + "\"/>\n</Relationships>\n"}};
    for (const auto& [name, content] : small_parts)
        if (Status status = archive.add(name, content); !status) return status.error();
    if (Status status = archive.add("3D/3dmodel.model", text_of(model_xml)); !status) return status.error();
    if (Status status = archive.finish(); !status) return status.error();
    return WriteReport{};
}

}  // namespace octavo::io
