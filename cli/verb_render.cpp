// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <optional>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/render/cairo_drawing.hpp>
#include <octavo/render/hidden_parts.hpp>
#include <octavo/render/png.hpp>
#include <octavo/render/raster.hpp>
#include <octavo/render/svg.hpp>

#include "program.hpp"
#include "render_subject.hpp"

// `octavo render MODEL -o OUT`: a picture of a model, shaded, with feature lines, from any side, whole or cut open; as
// pixels or as a drawing of which every line is a line.

namespace octavo::cli {
namespace {

struct RenderOptions {
    SubjectOptions subject;
    std::string output, to, size = "1200x900", cut, method = "auto";
    bool hidden_lines = false;
    double line_width = 1.2;
    render::View view;
};

struct Size {
    int width, height;
};

std::optional<Size> parse_size(const std::string& text) {
    Size size{};
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest) != 2) return std::nullopt;
    if (!render::check_size(size.width, size.height)) return std::nullopt;
    return size;
}

std::string check_size_text(const std::string& text) {
    if (parse_size(text)) return "";
    return fmt::format("must be WIDTHxHEIGHT, each 1 to {}, for example 1200x900, not {}",
                       render::largest_picture, text);
}

/// What was drawn, for people and scripts.
struct Drawn {
    std::size_t regions = 0, strokes = 0;
};

Result<Drawn> draw_by_order(Session& session, const Context& context, const RenderOptions& options, Size size,
                            const std::string& format, const Subject& subject, const render::Camera& camera) {
    if (subject.uncut) {
        Error error = *subject.uncut;
        error.sentence += "; --method depth draws a surface cut open that bounds no solid";
        return error;
    }
    render::DrawingOptions style{
        .width = size.width, .height = size.height, .line_width = options.line_width};
    if (options.hidden_lines) style.hidden_lines = render::HiddenLines::dash;
    const Result<render::Drawing> drawing = session.timed("draw", [&]() -> Result<render::Drawing> {
        if (!subject.bsp_octree) return render::remove_hidden_parts(subject.scene, camera, style, context);
        const render::BspOctreePaint paint{subject.bsp_octree_colors, subject.bsp_octree->cut};
        const Result<render::Patches> patches =
            render::patches_of(subject.bsp_octree->solid, camera, paint, context);
        if (!patches) return patches.error();
        return render::remove_hidden_parts(*patches, subject.scene.lines, camera, style, context);
    });
    if (!drawing) return drawing.error();
    Status written = session.timed("write", [&]() -> Status {
        if (format == "svg") return render::write_svg(options.output, *drawing, context);
        if (format == "pdf") return render::write_pdf(options.output, *drawing, context);
        const Result<render::Image> image = render::paint(*drawing, context);
        if (!image) return image.error();
        return render::write_png(options.output, *image, context);
    });
    if (!written) return std::move(written).error();
    Drawn drawn{drawing->regions.size(), 0};
    for (const auto* groups : {&drawing->hidden, &drawing->edges})
        for (const render::Strokes& strokes : *groups) drawn.strokes += strokes.lines.size();
    return drawn;
}

Status draw_by_depth(Session& session, const Context& context, const RenderOptions& options, Size size,
                     const Subject& subject, const render::Camera& camera) {
    render::DrawOptions drawing{.width = size.width, .height = size.height, .line_width = options.line_width};
    drawing.cut_axis = subject.cut_axis;
    drawing.cut_at = subject.cut_at;
    drawing.outline_cap = options.subject.edges != "none";
    const Result<render::Image> image =
        session.timed("draw", [&] { return render::draw(subject.scene, camera, drawing, context); });
    if (!image) return image.error();
    return session.timed("write", [&] { return render::write_png(options.output, *image, context); });
}

/// The engine: "order" or "depth".
Result<std::string> settle_method(Session& session, const RenderOptions& options, const std::string& format) {
    const bool needs_order = format != "png" || options.hidden_lines || options.subject.color == "node";
    if (options.method == "auto") return std::string(needs_order ? "order" : "depth");
    if (options.method == "depth" && format != "png")
        return session.usage_error(fmt::format("a depth buffer makes pixels, not .{}; name a .png", format));
    if (options.method == "depth" && options.hidden_lines)
        return session.usage_error(
            "a depth buffer forgets what is hidden; --hidden-lines needs --method order");
    return options.method;
}

Result<ExitCode> render_model(Session& session, const RenderOptions& options) {
    const Context context = session.context();
    SubjectOptions wanted = options.subject;
    wanted.cut = *parse_cut(options.cut);
    const Result<std::string> format =
        settle_output(session, {wanted.input}, options.output, options.to, picture_outputs());
    if (!format) return format.error();
    const Result<std::string> method = settle_method(session, options, *format);
    if (!method) return method.error();
    const Size size = *parse_size(options.size);

    Result<Subject> subject = read_subject(session, context, wanted);
    if (!subject) return std::move(subject).error();
    const std::vector<Vec3> in_view = subject->scene.corners(subject->cut_axis, subject->cut_at);
    const Result<render::Camera> camera =
        render::Camera::look_at(in_view, options.view, size.width, size.height);
    if (!camera) return in_file(camera.error(), wanted.input);
    // Contours lie hardly before what they border, and a depth buffer's lines shine through that far: only when asked.
    if (subject->wants_contours && (*method == "order" || wanted.edges == "contours"))
        for (const render::Line& line : render::contours_of(subject->surface, *camera))
            subject->scene.lines.push_back(line);

    session.stdout_taken = options.output == "-";
    session.result = {{"polygons", subject->scene.facets.size()},
                      {"lines", subject->scene.lines.size()},
                      {"width", size.width},
                      {"height", size.height},
                      {"method", *method}};
    session.text = fmt::format("{}: {} × {} pixels, {}", options.output, size.width, size.height,
                               counted(subject->scene.facets.size(), "polygon", "polygons"));
    if (*method == "depth") {
        if (Status drawn = draw_by_depth(session, context, options, size, *subject, *camera); !drawn)
            return std::move(drawn).error();
    } else {
        const Result<Drawn> drawn =
            draw_by_order(session, context, options, size, *format, *subject, *camera);
        if (!drawn) return drawn.error();
        session.result["areas"] = drawn->regions;
        session.result["strokes"] = drawn->strokes;
        session.text += ", " + counted(drawn->regions, "visible area", "visible areas") + ", " +
                        counted(drawn->strokes, "stroke", "strokes");
    }
    session.text += "\n";
    return ExitCode::ok;
}

void add_view_options(Verb* verb, RenderOptions& options) {
    verb->add_option("--size", options.size, "Pixels of the picture; in a .pdf, 3/4 of a point each")
        ->check(check_size_text)
        ->type_name("WxH")
        ->capture_default_str();
    verb->add_option("--azimuth", options.view.azimuth_degrees,
                     "Where the viewer stands: 0 in front, 90 right, -360 to 360")
        ->check(number_between(-360, 360))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option("--elevation", options.view.elevation_degrees,
                     "How high: 0 level, 90 from above, -90 to 90")
        ->check(number_between(-90, 90))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option("--perspective", options.view.perspective, "Field of view, 0 to 120; 0 is orthographic")
        ->check(number_between(0, render::widest_view))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_option(
            "--cut", options.cut,
            "Cut open: AXIS[:FROM[:TO]] is taken away, in shares of the bounds; x:0.5,y:0:0.5 a quarter")
        ->check(check_cut)
        ->type_name("AXIS");
}

void add_style_options(Verb* verb, RenderOptions& options) {
    take_one_of(
        verb->add_option("--edges", options.subject.edges,
                         "Lines to draw: where round things end (contours), sharp edges and contours, or all "
                         "edges; auto is sharp for surfaces and all for octrees"),
        {"auto", "none", "contours", "sharp", "all"});
    verb->add_option("--sharp", options.subject.sharp_degrees, "Edges that turn by more are sharp, 0 to 180")
        ->check(number_between(0, 180))
        ->type_name("DEGREES")
        ->capture_default_str();
    verb->add_flag("--hidden-lines", options.hidden_lines, "Draw what of the lines is hidden dashed");
    verb->add_option("--line-width", options.line_width, "Width of lines in pixels, 0.1 to 50")
        ->check(number_between(0.1, 50))
        ->type_name("PIXELS")
        ->capture_default_str();
    take_one_of(
        verb->add_option("--paint", options.subject.color,
                         "Colours: of one solid, of the part of a .csg that a face came from (source), or of "
                         "an octree's nodes (node)"),
        {"auto", "solid", "source", "node"});
    take_one_of(verb->add_option(
                    "--method", options.method,
                    "How hidden parts go: by a depth buffer, or by the exact order of an octree; auto is "
                    "depth for .png where that can do it"),
                {"auto", "depth", "order"});
}

}  // namespace

void add_render(Program& program) {
    const auto options = std::make_shared<RenderOptions>();
    Verb* verb = program.verb("render", "Inspect", "Draw a picture of a model, whole or cut open",
                              [options](Session& session) { return render_model(session, *options); });
    verb->add_option("MODEL", options->subject.input,
                     "A mesh (- is stdin), a CSG tree (.csg), or an octree (.oct, .bpo, .bso)")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output, "The picture to write: png, svg or pdf; - is stdout")
        ->required()
        ->type_name("FILE");
    add_from_option(verb, options->subject.format, "MODEL");
    add_to_option(verb, options->to, picture_outputs());
    add_view_options(verb, *options);
    add_style_options(verb, *options);
}

}  // namespace octavo::cli
