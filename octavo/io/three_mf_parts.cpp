// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>
#include <optional>

#include <pugixml.hpp>

#include <octavo/io/text_scanner.hpp>
#include <octavo/io/three_mf_parts.hpp>

namespace octavo::io {
namespace {

/// The name without its namespace prefix. Files choose prefixes freely; no two namespaces of 3MF use one name
/// for different things where we look.
std::string_view local_name(const char* name) {
    const char* const colon = std::strchr(name, ':');
    return colon ? colon + 1 : name;
}

pugi::xml_node child(pugi::xml_node node, std::string_view name) {
    for (pugi::xml_node candidate = node.first_child(); candidate; candidate = candidate.next_sibling())
        if (local_name(candidate.name()) == name) return candidate;
    return {};
}

pugi::xml_attribute attribute(pugi::xml_node node, std::string_view name) {
    for (pugi::xml_attribute candidate = node.first_attribute(); candidate;
         candidate = candidate.next_attribute())
        if (local_name(candidate.name()) == name) return candidate;
    return {};
}

class PartReader {
  public:
    PartReader(std::string_view xml, const std::string& name) : xml_(xml) { part_.name = name; }

    Result<ThreeMfPart> read() {
        // Text between elements means nothing in 3MF, so only attributes are kept.
        const pugi::xml_parse_result parsed =
            document_.load_buffer(xml_.data(), xml_.size(), pugi::parse_escapes);
        if (!parsed)
            return error(parsed.offset, std::string("is not well-formed XML: ") + parsed.description());
        const pugi::xml_node model = child(document_, "model");
        if (!model) return error(0, "has no element model");
        part_.unit = attribute(model, "unit") ? attribute(model, "unit").value() : "millimeter";
        if (millimetres_in(part_.unit) == 0)
            return error(model.offset_debug(), "has an unknown unit of length");
        if (std::optional<Error> trouble = check_extensions(model)) return *trouble;
        note_metadata(model);
        for (pugi::xml_node node = child(model, "resources").first_child(); node;
             node = node.next_sibling()) {
            if (local_name(node.name()) != "object") {
                part_.left_behind.insert(kind_of_resource(local_name(node.name())));
                continue;
            }
            if (std::optional<Error> trouble = read_object(node)) return *trouble;
        }
        for (pugi::xml_node node = child(model, "build").first_child(); node; node = node.next_sibling()) {
            if (local_name(node.name()) != "item") continue;
            Result<ThreeMfPlacement> item = read_placement(node);
            if (!item) return item.error();
            part_.build.push_back(std::move(*item));
        }
        return std::move(part_);
    }

  private:
    Error error(std::ptrdiff_t offset, const std::string& sentence) const {
        const std::size_t at = offset < 0 ? 0 : std::min(static_cast<std::size_t>(offset), xml_.size());
        return TextScanner(xml_).error_at(xml_.data() + at, "the part " + part_.name + " " + sentence);
    }

    /// Extensions may be ignored unless the file says that they are required.
    std::optional<Error> check_extensions(pugi::xml_node model) const {
        TextScanner prefixes(attribute(model, "requiredextensions").value());
        for (std::string_view prefix = prefixes.word(); !prefix.empty(); prefix = prefixes.word()) {
            const std::string_view space = model.attribute(("xmlns:" + std::string(prefix)).c_str()).value();
            const bool harmless = space.find("/production/") != space.npos ||
                                  space.find("/material/") != space.npos ||
                                  space.find("/core/") != space.npos;
            if (harmless) continue;
            Error refusal = error(model.offset_debug(), "requires the extension \"" + std::string(prefix) +
                                                            "\", which Octavo does not read");
            refusal.code = ErrorCode::unsupported;
            return refusal;
        }
        return {};
    }

    static std::string_view kind_of_resource(std::string_view name) {
        if (name.starts_with("texture2d")) return "textures";
        if (name == "slicestack") return "slices";
        for (const char* material : {"basematerials", "colorgroup", "compositematerials", "multiproperties"})
            if (name == material) return "materials";
        return "other resources";
    }

    /// Every writer names itself as the application, we too.
    void note_metadata(pugi::xml_node model) {
        for (pugi::xml_node node = model.first_child(); node; node = node.next_sibling())
            if (local_name(node.name()) == "metadata" &&
                std::string_view(node.attribute("name").value()) != "Application")
                part_.left_behind.insert("metadata");
    }

    void note_what_is_left_behind(pugi::xml_node object) {
        if (attribute(object, "name") || attribute(object, "partnumber"))
            part_.left_behind.insert("names of objects");
        if (child(object, "metadatagroup")) part_.left_behind.insert("metadata");
        const pugi::xml_node mesh = child(object, "mesh");
        for (pugi::xml_node node = mesh.first_child(); node; node = node.next_sibling()) {
            const std::string_view name = local_name(node.name());
            if (name == "vertices" || name == "triangles") continue;
            part_.left_behind.insert(name == "beamlattice" ? "beam lattices" : "other data of meshes");
        }
    }

    std::optional<std::uint32_t> index(pugi::xml_node node, const char* name) const {
        TextScanner scanner(attribute(node, name).value());
        const std::optional<std::uint64_t> value = scanner.count();
        scanner.skip_space();
        if (!value || *value > 0xffffffffu || !scanner.at_end()) return {};
        return static_cast<std::uint32_t>(*value);
    }

    std::optional<Error> read_object(pugi::xml_node node) {
        ThreeMfObject object;
        const std::optional<std::uint32_t> id = index(node, "id");
        if (!id) return error(node.offset_debug(), "has an object without an id");
        object.id = *id;
        note_what_is_left_behind(node);
        object.type = attribute(node, "type") ? attribute(node, "type").value() : "model";
        if (const pugi::xml_node mesh = child(node, "mesh")) {
            if (std::optional<Error> trouble = read_mesh(mesh, object)) return trouble;
        }
        const pugi::xml_node components = child(node, "components");
        for (pugi::xml_node part = components.first_child(); part; part = part.next_sibling()) {
            if (local_name(part.name()) != "component") continue;
            Result<ThreeMfPlacement> component = read_placement(part);
            if (!component) return component.error();
            object.components.push_back(std::move(*component));
        }
        if (!part_.object_of_id.try_emplace(object.id, part_.objects.size()).second)
            return error(node.offset_debug(), "has two objects of the id " + std::to_string(object.id));
        part_.objects.push_back(std::move(object));
        return {};
    }

    std::optional<Error> read_mesh(pugi::xml_node mesh, ThreeMfObject& object) const {
        for (pugi::xml_node node = child(mesh, "vertices").first_child(); node; node = node.next_sibling()) {
            if (std::strcmp(node.name(), "vertex") != 0 && local_name(node.name()) != "vertex") continue;
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const char name[] = {static_cast<char>('x' + axis), '\0'};
                TextScanner scanner(node.attribute(name).value());
                const std::optional<double> value = scanner.number();
                scanner.skip_space();
                if (!value || !std::isfinite(*value) || !scanner.at_end())
                    return error(node.offset_debug(),
                                 std::string("has a vertex whose ") + name + " is not a finite number");
                point[axis] = *value;
            }
            object.vertices.push_back(point);
        }
        for (pugi::xml_node node = child(mesh, "triangles").first_child(); node; node = node.next_sibling()) {
            if (std::strcmp(node.name(), "triangle") != 0 && local_name(node.name()) != "triangle") continue;
            mesh::Triangle triangle{};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const char name[] = {'v', static_cast<char>('1' + corner), '\0'};
                const std::optional<std::uint32_t> vertex = index(node, name);
                if (!vertex || *vertex >= object.vertices.size())
                    return error(node.offset_debug(), "has a triangle whose " + std::string(name) +
                                                          " names none of the object's " +
                                                          std::to_string(object.vertices.size()) +
                                                          " vertices");
                triangle[corner] = *vertex;
            }
            object.triangles.push_back(triangle);
        }
        return {};
    }

    /// Twelve numbers are the rows of a 4×3 matrix that row vectors are multiplied with from the left, so our
    /// columns are its rows.
    Result<ThreeMfPlacement> read_placement(pugi::xml_node node) const {
        ThreeMfPlacement placement;
        const std::optional<std::uint32_t> id = index(node, "objectid");
        if (!id) return error(node.offset_debug(), "places an object without naming its id");
        placement.object = *id;
        placement.part = attribute(node, "path").value();
        const pugi::xml_attribute transform = attribute(node, "transform");
        if (!transform) return placement;
        TextScanner scanner(transform.value());
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column < 3; ++column) {
                const std::optional<double> value = scanner.number();
                if (!value || !std::isfinite(*value))
                    return error(node.offset_debug(), "has a transform that is not twelve finite numbers");
                placement.transform.m[column][row] = *value;
            }
        scanner.skip_space();
        if (!scanner.at_end())
            return error(node.offset_debug(), "has a transform that is not twelve finite numbers");
        return placement;
    }

    std::string_view xml_;
    pugi::xml_document document_;
    ThreeMfPart part_;
};

}  // namespace

Result<ThreeMfPart> read_three_mf_part(std::string_view xml, const std::string& name) {
    return PartReader(xml, name).read();
}

std::string three_mf_model_part(std::string_view relationships_xml) {
    pugi::xml_document document;
    if (!document.load_buffer(relationships_xml.data(), relationships_xml.size())) return {};
    const pugi::xml_node list = child(document, "Relationships");
    for (pugi::xml_node node = list.first_child(); node; node = node.next_sibling())
        if (std::string_view(node.attribute("Type").value()).ends_with("/3dmodel"))
            return node.attribute("Target").value();
    return {};
}

double millimetres_in(std::string_view unit) {
    if (unit == "micron") return 0.001;
    if (unit == "millimeter") return 1;
    if (unit == "centimeter") return 10;
    if (unit == "inch") return 25.4;
    if (unit == "foot") return 304.8;
    if (unit == "meter") return 1000;
    return 0;
}

}  // namespace octavo::io
