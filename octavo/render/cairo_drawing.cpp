// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include <cairo-pdf.h>
#include <cairo.h>

#include <octavo/io/output.hpp>
#include <octavo/render/cairo_drawing.hpp>
#include <octavo/render/line_style.hpp>

namespace octavo::render {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void set_color(cairo_t* cairo, Color color) {
    cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
}

void add_path(cairo_t* cairo, const Polyline& line, bool is_closed) {
    constexpr double step = 1.0 / steps_of_pixel;
    cairo_move_to(cairo, line[0].x * step, line[0].y * step);
    for (std::size_t i = 1; i < line.size(); ++i) cairo_line_to(cairo, line[i].x * step, line[i].y * step);
    if (is_closed) cairo_close_path(cairo);
}

/// Whether a line can be seen in the current clip.
bool is_near(const Polyline& line, double left, double top, double right, double bottom) {
    const auto [low_x, high_x] =
        std::minmax_element(line.begin(), line.end(), [](auto a, auto b) { return a.x < b.x; });
    const auto [low_y, high_y] =
        std::minmax_element(line.begin(), line.end(), [](auto a, auto b) { return a.y < b.y; });
    const double reach = 100 * steps_of_pixel;  // wider than any line
    return low_x->x - reach <= right * steps_of_pixel && high_x->x + reach >= left * steps_of_pixel &&
           low_y->y - reach <= bottom * steps_of_pixel && high_y->y + reach >= top * steps_of_pixel;
}

void draw_regions(cairo_t* cairo, const Drawing& drawing) {
    double left = 0, top = 0, right = 0, bottom = 0;
    cairo_clip_extents(cairo, &left, &top, &right, &bottom);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_fill_rule(cairo, CAIRO_FILL_RULE_WINDING);
    for (const Region& region : drawing.regions) {
        cairo_new_path(cairo);
        bool is_seen = false;
        for (const Polyline& loop : region.loops) is_seen |= is_near(loop, left, top, right, bottom);
        if (!is_seen) continue;
        for (const Polyline& loop : region.loops) add_path(cairo, loop, true);
        set_color(cairo, region.color);
        cairo_fill_preserve(cairo);
        cairo_stroke(cairo);
    }
}

void draw_strokes(cairo_t* cairo, const std::vector<Strokes>& groups) {
    double left = 0, top = 0, right = 0, bottom = 0;
    cairo_clip_extents(cairo, &left, &top, &right, &bottom);
    for (const Strokes& strokes : groups) {
        set_color(cairo, strokes.color);
        for (const Polyline& line : strokes.lines) {
            if (!is_near(line, left, top, right, bottom)) continue;
            const bool is_closed = line.size() > 3 && line.front() == line.back();
            add_path(cairo, line, is_closed);
            cairo_stroke(cairo);
        }
    }
}

void draw_lines(cairo_t* cairo, const Drawing& drawing) {
    cairo_set_line_width(cairo, line_style::hidden_share * drawing.line_width);
    const std::array<double, 2> dashes{line_style::dashes[0] * drawing.line_width,
                                       line_style::dashes[1] * drawing.line_width};
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    cairo_set_dash(cairo, dashes.data(), 2, 0);
    draw_strokes(cairo, drawing.hidden);
    cairo_set_dash(cairo, nullptr, 0, 0);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_width(cairo, drawing.line_width);
    draw_strokes(cairo, drawing.edges);
}

cairo_status_t append(void* output, const unsigned char* bytes, unsigned int size) {
    static_cast<io::Output*>(output)->append(
        std::string_view(reinterpret_cast<const char*>(bytes), std::size_t{size}));
    return CAIRO_STATUS_SUCCESS;
}

Error cairo_error(ErrorCode code, cairo_status_t status) {
    return {code, std::string("cannot draw: ") + cairo_status_to_string(status), {}};
}

/// A square of the picture, `samples` times finer.
constexpr int samples = 4, tile_side = 1024;

/// Draws the part of the picture from a pixel on, and averages it into the image.
Status paint_tile(const Drawing& drawing, int left, int top, Image& image) {
    const int width = std::min(tile_side, image.width - left),
              height = std::min(tile_side, image.height - top);
    const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width * samples, height * samples),
                          cairo_surface_destroy);
    const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
    cairo_scale(cairo.get(), samples, samples);
    cairo_translate(cairo.get(), -left, -top);
    set_color(cairo.get(), drawing.background);
    cairo_paint(cairo.get());
    cairo_set_antialias(cairo.get(), CAIRO_ANTIALIAS_NONE);
    // Half a sample on either side is enough here.
    cairo_set_line_width(cairo.get(), 1.0 / samples);
    draw_regions(cairo.get(), drawing);
    cairo_set_antialias(cairo.get(), CAIRO_ANTIALIAS_DEFAULT);
    draw_lines(cairo.get(), drawing);
    if (cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS)
        return cairo_error(ErrorCode::limit, cairo_status(cairo.get()));

    cairo_surface_flush(surface.get());
    const unsigned char* bytes = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    constexpr float share = 1.0F / (255 * samples * samples);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            std::uint32_t red = 0, green = 0, blue = 0;
            for (int y = 0; y < samples; ++y) {
                const auto* line =
                    reinterpret_cast<const std::uint32_t*>(bytes + (row * samples + y) * stride) +
                    column * samples;
                for (int x = 0; x < samples; ++x) {
                    red += line[x] >> 16 & 255, green += line[x] >> 8 & 255, blue += line[x] & 255;
                }
            }
            image.at(left + column, top + row) = {static_cast<float>(red) * share,
                                                  static_cast<float>(green) * share,
                                                  static_cast<float>(blue) * share};
        }
    return Done{};
}

}  // namespace

Status write_pdf(const std::string& path, const Drawing& drawing, const Context& context) {
    Result<io::Output> output = io::Output::to_file(path, context);
    if (!output) return std::move(output).error();
    constexpr double points_of_pixel = 0.75;
    const Surface surface(
        cairo_pdf_surface_create_for_stream(append, &*output, drawing.width * points_of_pixel,
                                            drawing.height * points_of_pixel),
        cairo_surface_destroy);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
    {
        const Cairo cairo(cairo_create(surface.get()), cairo_destroy);
        cairo_scale(cairo.get(), points_of_pixel, points_of_pixel);
        set_color(cairo.get(), drawing.background);
        cairo_paint(cairo.get());
        cairo_set_line_width(cairo.get(), line_style::seam_width);
        draw_regions(cairo.get(), drawing);
        cairo_set_line_join(cairo.get(), CAIRO_LINE_JOIN_ROUND);
        draw_lines(cairo.get(), drawing);
    }
    cairo_surface_finish(surface.get());
    const cairo_status_t status = cairo_surface_status(surface.get());
    if (status == CAIRO_STATUS_SUCCESS) return output->commit();
    Error error = cairo_error(ErrorCode::io, status);
    error.place.file = path;
    return error;
}

Result<Image> paint(const Drawing& drawing, const Context& context) {
    Image image{drawing.width, drawing.height, {}};
    image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
    for (int top = 0; top < image.height; top += tile_side)
        for (int left = 0; left < image.width; left += tile_side) {
            if (context.cancelled()) return Context::cancelled_error();
            context.report("paint", static_cast<double>(top) / image.height);
            if (Status painted = paint_tile(drawing, left, top, image); !painted)
                return std::move(painted).error();
        }
    return image;
}

}  // namespace octavo::render
