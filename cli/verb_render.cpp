// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <optional>

#include <fmt/format.h>

#include <octavo/render/png.hpp>
#include <octavo/render/raster.hpp>

#include "model.hpp"
#include "program.hpp"

// `octavo render MODEL -o OUT.png`: a picture of a mesh or of an octree's cells, shaded, with feature lines, from any
// side, whole or cut open.

namespace octavo::cli {
namespace {

struct RenderOptions {
    std::string input, output, format, size = "1200x900", cut, edges = "auto";
    render::View view;
};

struct Size {
    int width, height;
};

std::optional<Size> parse_size(const std::string& text) {
    Size size{};
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2) return std::nullopt;
    const auto possible = [](int pixels) { return pixels >= 1 && pixels <= render::largest_picture; };
    if (!possible(size.width) || !possible(size.height)) return std::nullopt;
    return size;
}

/// A plane across an axis; what lies beyond is not drawn.
struct Cut {
    int axis = 0;
    double at = Box3::infinity;
};

/// `text` is AXIS or AXIS:SHARE, with the share of the bounds that is kept; empty cuts nothing.
std::optional<Cut> parse_cut(const std::string& text, const Box3& bounds) {
    if (text.empty()) return Cut{};
    char axis = 0, rest = 0;
    double share = 0.5;
    const int parts = std::sscanf(text.c_str(), "%c:%lf%c", &axis, &share, &rest);
    if ((parts != 2 && text.size() != 1) || axis < 'x' || axis > 'z' || !(share >= 0 && share <= 1))
        return std::nullopt;
    const int index = axis - 'x';
    return Cut{index, bounds.low[index] + share * (bounds.high[index] - bounds.low[index])};
}

std::string check_size(const std::string& text) {
    if (parse_size(text)) return "";
    return fmt::format("must be WIDTHxHEIGHT, each 1 to {}, for example 1200x900, not {}",
                       render::largest_picture, text);
}

std::string check_cut(const std::string& text) {
    if (parse_cut(text, {})) return "";
    return fmt::format(
        "must be x, y or z, and perhaps a share from 0 to 1: y:0.4 keeps the first 40 %; not {}", text);
}

render::EdgeLines lines_of(const std::string& word, render::EdgeLines automatic) {
    if (word == "none") return render::EdgeLines::none;
    if (word == "sharp") return render::EdgeLines::sharp;
    if (word == "all") return render::EdgeLines::all;
    return automatic;
}

/// What is drawn, and where it is cut.
struct Subject {
    render::Scene scene;
    Cut cut;
};

Result<Subject> surface_subject(Session& session, const Context& context, const RenderOptions& options) {
    Result<io::ReadMesh> read = read_surface(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    render::MeshSceneOptions scene;
    scene.edges = lines_of(options.edges, render::EdgeLines::sharp);
    return Subject{render::scene_of(read->mesh, scene), *parse_cut(options.cut, read->mesh.bounds())};
}

Result<Subject> octree_subject(Session& session, const Context& context, const RenderOptions& options) {
    Result<octree::Octree> tree = read_octree(session, context, options.input, options.format);
    if (!tree) return std::move(tree).error();
    render::OctreeSceneOptions scene;
    scene.edges = lines_of(options.edges, render::EdgeLines::all);
    const Box3 bounds = render::scene_of(*tree, {.edges = render::EdgeLines::none}).bounds();
    const Cut cut = *parse_cut(options.cut, bounds);
    scene.cut_axis = cut.axis;
    scene.cut_at = cut.at;
    // The scene leaves out whole cells, so the drawing must not cut through those that stay.
    return Subject{render::scene_of(*tree, scene), Cut{}};
}

Result<ExitCode> render_model(Session& session, const RenderOptions& options) {
    const Context context = session.context();
    const Result<std::string> format =
        settle_output(session, {options.input}, options.output, "", picture_outputs());
    if (!format) return format.error();
    const Size size = *parse_size(options.size);

    Result<Subject> subject = kind_of(options.input, options.format) == ModelKind::octree
                                  ? octree_subject(session, context, options)
                                  : surface_subject(session, context, options);
    if (!subject) return std::move(subject).error();
    const std::vector<Vec3> in_view = subject->scene.corners(subject->cut.axis, subject->cut.at);
    Result<render::Camera> camera = render::Camera::look_at(in_view, options.view, size.width, size.height);
    if (!camera) return in_file(std::move(camera).error(), options.input);
    render::DrawOptions drawing{.width = size.width, .height = size.height};
    drawing.cut_axis = subject->cut.axis;
    drawing.cut_at = subject->cut.at;
    drawing.outline_cap = options.edges != "none";
    Result<render::Image> image =
        session.timed("draw", [&] { return render::draw(subject->scene, *camera, drawing, context); });
    if (!image) return std::move(image).error();
    session.stdout_taken = options.output == "-";
    Status written = session.timed("write", [&] { return render::write_png(options.output, *image); });
    if (!written) return std::move(written).error();

    session.result = {{"polygons", subject->scene.facets.size()},
                      {"lines", subject->scene.lines.size()},
                      {"width", size.width},
                      {"height", size.height}};
    session.text = fmt::format("{}: {} × {} pixels, {} polygons\n", options.output, size.width, size.height,
                               grouped(subject->scene.facets.size()));
    return ExitCode::ok;
}

}  // namespace

void add_render(Program& program) {
    const auto options = std::make_shared<RenderOptions>();
    Verb* verb = program.verb("render", "Inspect", "Draw a picture of a model, whole or cut open",
                              [options](Session& session) { return render_model(session, *options); });
    verb->add_option("MODEL", options->input, "A mesh (- is stdin), a CSG tree (.csg), or an octree (.oct)")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output, "The picture to write: png; - is stdout")
        ->required()
        ->type_name("FILE");
    verb->add_option("--format", options->format, "Format of MODEL, instead of by its extension")
        ->check(check_model_format)
        ->type_name("FORMAT");
    verb->add_option("--size", options->size, "Pixels of the picture")
        ->check(check_size)
        ->type_name("WxH")
        ->capture_default_str();
    verb->add_option("--azimuth", options->view.azimuth_degrees,
                     "Where the viewer stands: 0 in front, 90 right, -360 to 360")
        ->check(number_between(-360, 360))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option("--elevation", options->view.elevation_degrees,
                     "How high: 0 level, 90 from above, -90 to 90")
        ->check(number_between(-90, 90))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option("--perspective", options->view.perspective, "Field of view, 0 to 120; 0 is orthographic")
        ->check(number_between(0, render::widest_view))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option("--cut", options->cut,
                     "Cut open across an axis: x, y or z, or for example x:0.4 to keep 40 %")
        ->check(check_cut)
        ->type_name("AXIS");
    take_one_of(verb->add_option("--edges", options->edges,
                                 "Lines to draw; auto is sharp for surfaces and all for octrees"),
                {"auto", "none", "sharp", "all"});
}

}  // namespace octavo::cli
