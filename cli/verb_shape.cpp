// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>

#include "model.hpp"
#include "option_checks.hpp"
#include "program.hpp"
#include "suggestion.hpp"

// `octavo shape NAME -o OUT`: a generated solid, to try things on and to make test cases from.

namespace octavo::cli {
namespace {

struct ShapeOptions {
    std::string name, output, to;
    std::optional<std::uint32_t> detail;
    double size = 1;
};

/// Shapes by name; `detail` is the number of segments, or whatever the shape is divided into.
struct Shape {
    const char* description;
    std::uint32_t detail, least_detail, most_detail;
    mesh::Mesh (*make)(std::uint32_t detail);
};

mesh::Mesh gear_of(std::uint32_t teeth) {
    mesh::GearOptions options;
    options.teeth = teeth;
    return mesh::gear(options);
}

mesh::Mesh housing_of(std::uint32_t segments) {
    mesh::HousingOptions options;
    options.segments = segments;
    options.bolt_segments = std::max(8U, segments / 3 / 8 * 8);
    return mesh::bearing_housing(options);
}

const std::map<std::string, Shape>& shapes() {
    static const std::map<std::string, Shape> all{
        {"cube", {"unit cube", 1, 1, 1, [](std::uint32_t) { return mesh::cube(1); }}},
        {"tetrahedron", {"regular tetrahedron", 1, 1, 1, [](std::uint32_t) { return mesh::tetrahedron(1); }}},
        {"sphere",
         {"icosphere of radius 1", 16, 1, 2000, [](std::uint32_t d) { return mesh::icosphere(1, d); }}},
        {"cylinder",
         {"radius 1, height 2", 64, 3, 100000, [](std::uint32_t d) { return mesh::cylinder(1, 2, d); }}},
        {"cone",
         {"radius 1, height 2", 64, 3, 100000, [](std::uint32_t d) { return mesh::cone(1, 0, 2, d); }}},
        {"torus",
         {"radii 1 and 0.35", 96, 3, 5000,
          [](std::uint32_t d) { return mesh::torus(1, 0.35, d, (d + 1) / 2 + 1); }}},
        {"knot",
         {"tube round a trefoil knot", 256, 16, 5000,
          [](std::uint32_t d) { return mesh::knot_tube(2, 3, 0.3, d, std::max(3U, d / 8)); }}},
        {"gear", {"spur gear with holes; detail is its teeth", 24, 12, 200, gear_of}},
        {"housing", {"flanged bearing housing", 96, 24, 2400, housing_of}},
        {"rock",
         {"sphere displaced by noise", 64, 1, 2000,
          [](std::uint32_t d) { return mesh::displaced_sphere(d); }}},
        {"menger",
         {"Menger sponge; detail is its level", 3, 0, 5,
          [](std::uint32_t d) { return mesh::menger_sponge(d); }}},
    };
    return all;
}

std::string names(const char* separator) {
    std::string list;
    for (const auto& [name, shape] : shapes()) list += (list.empty() ? "" : separator) + name;
    return list;
}

std::string check_name(const std::string& name) {
    if (shapes().count(name)) return "";
    std::vector<std::string> known;
    for (const auto& [one, shape] : shapes()) known.push_back(one);
    const std::string meant = nearest_word(name, known);
    return fmt::format("must be one of {}, not {}{}", names(", "), name,
                       meant.empty() ? "" : "; did you mean " + meant + "?");
}

Result<ExitCode> make_shape(Session& session, const ShapeOptions& options) {
    const Context context = session.context();
    const Shape& shape = shapes().at(options.name);
    const std::uint32_t detail = options.detail.value_or(shape.detail);
    if (options.detail && shape.least_detail == shape.most_detail)
        return session.usage_error(fmt::format("--detail: a {} has none to choose", options.name));
    if (detail < shape.least_detail || detail > shape.most_detail)
        return session.usage_error(fmt::format("--detail of a {} must be {} to {}, not {}", options.name,
                                               shape.least_detail, shape.most_detail, detail));
    const Result<std::string> format = settle_output(session, {}, options.output, options.to, mesh_outputs());
    if (!format) return format.error();
    mesh::Mesh mesh = session.timed("generate", [&] { return shape.make(detail); });
    if (options.size != 1) {
        Affine scale;
        for (int axis = 0; axis < 3; ++axis) scale.m[axis][axis] = options.size;
        mesh = mesh::transform(mesh, scale);
    }
    Result<io::WriteReport> report = write_mesh(session, context, options.output, mesh, {.format = *format});
    if (!report) return std::move(report).error();
    session.result = {
        {"vertices", mesh.vertices.size()}, {"triangles", mesh.triangles.size()}, {"bytes", report->bytes}};
    session.text = fmt::format("{}: {} ({}), {} triangles\n", options.output, options.name, shape.description,
                               grouped(mesh.triangles.size()));
    return ExitCode::ok;
}

}  // namespace

void add_shape(Program& program) {
    const auto options = std::make_shared<ShapeOptions>();
    Verb* verb = program.verb("shape", "Make", "Generate a solid to try things on",
                              [options](Session& session) { return make_shape(session, *options); });
    verb->add_option("NAME", options->name, "One of " + names(", "))
        ->required()
        ->check(check_name)
        ->type_name(names("|"));
    verb->add_option("-o,--output", options->output,
                     "The mesh to write: " + one_of(mesh_outputs().names) + "; - is stdout")
        ->required()
        ->type_name("FILE");
    verb->add_option("--detail", options->detail,
                     "How finely it is divided: segments, teeth or levels; each shape has its default")
        ->check(whole_number(0, 1'000'000'000))
        ->type_name("N");
    verb->add_option("--size", options->size, "Factor by which it is scaled")
        ->check(check_positive)
        ->type_name("FACTOR")
        ->capture_default_str();
    add_to_option(verb, options->to, mesh_outputs());
}

}  // namespace octavo::cli
