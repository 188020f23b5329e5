// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string_view>

#include <cairo.h>

#include <octavo/render/color_scale.hpp>
#include <octavo/render/palette.hpp>

namespace octavo::render {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Cairo = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// A character as lines: two digits a point, x to the right in 0 … 4 and y down in 0 … 6; blanks between lines.
struct Glyph {
    char character;
    std::string_view lines;
    int width;
};

constexpr std::array<Glyph, 14> glyphs{{{'0', "103041453616050110", 4},
                                        {'1', "012026 0646", 4},
                                        {'2', "01103041420646", 4},
                                        {'3', "004022324345361605", 4},
                                        {'4', "36300444", 4},
                                        {'5', "400002324345361605", 4},
                                        {'6', "402002051636454433 3303", 4},
                                        {'7', "004016", 4},
                                        {'8', "103041423313020110 1304051636454433", 4},
                                        {'9', "43130201103041442606", 4},
                                        {'.', "0606", 0},
                                        {'-', "0343", 4},
                                        {'+', "0343 2125", 4},
                                        {'e', "044443321203051646", 4}}};

constexpr double glyph_unit = 1.9, glyph_gap = 1.6 * glyph_unit, glyph_height = 6 * glyph_unit;  // in pixels

void draw_glyph(cairo_t* cairo, const Glyph& glyph, double x, double y) {
    bool is_first = true;
    for (std::string_view rest = glyph.lines; rest.size() >= 2;) {
        if (rest.front() == ' ') {
            is_first = true;
            rest.remove_prefix(1);
        }
        const double to_x = x + (rest[0] - '0') * glyph_unit, to_y = y + (rest[1] - '0') * glyph_unit;
        rest.remove_prefix(2);
        if (is_first)
            cairo_move_to(cairo, to_x, to_y);
        else
            cairo_line_to(cairo, to_x, to_y);
        is_first = false;
    }
    cairo_stroke(cairo);
}

/// Five digits of the number, its middle at `y`.
void draw_number(cairo_t* cairo, double number, double x, double y) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.5g", number);
    for (const char character : std::string_view(text.data())) {
        const auto glyph = std::find_if(glyphs.begin(), glyphs.end(),
                                        [&](const Glyph& one) { return one.character == character; });
        if (glyph == glyphs.end()) continue;
        draw_glyph(cairo, *glyph, x, y - glyph_height / 2);
        x += glyph->width * glyph_unit + glyph_gap;
    }
}

/// Where the bar is within the strip, in pixels.
constexpr int bar_left = 20, bar_right = 44, numbers_left = 54;

void draw_scale(cairo_t* cairo, int height, double least, double greatest) {
    const int top = height / 8, bottom = height - height / 8;
    for (int y = top; y < bottom; ++y) {
        const Color color = color_of_value((bottom - y - 0.5) / (bottom - top));
        cairo_set_source_rgb(cairo, color.red, color.green, color.blue);
        cairo_rectangle(cairo, bar_left, y, bar_right - bar_left, 1);
        cairo_fill(cairo);
    }
    cairo_set_source_rgb(cairo, palette::ink.red, palette::ink.green, palette::ink.blue);
    cairo_set_line_width(cairo, 1.2);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_rectangle(cairo, bar_left, top, bar_right - bar_left, bottom - top);
    cairo_stroke(cairo);
    constexpr int steps = 4;
    for (int i = 0; i <= (greatest > least ? steps : 0); ++i) {
        const double share = static_cast<double>(i) / steps, y = bottom - share * (bottom - top);
        cairo_move_to(cairo, bar_right, y), cairo_line_to(cairo, bar_right + 5, y);
        cairo_stroke(cairo);
        draw_number(cairo, (1 - share) * least + share * greatest, numbers_left, y);
    }
}

std::uint32_t byte_of(float channel) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255));
}

}  // namespace

Color color_of_value(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * (palette::values.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), palette::values.size() - 2);
    return mix(palette::values[below], palette::values[below + 1],
               static_cast<float>(place - static_cast<double>(below)));
}

Status add_color_scale(Image& image, double least, double greatest) {
    OCTAVO_CHECK(has_room_for_color_scale(image.width, image.height), "the picture has room for the scale");
    const int left = image.width - color_scale_width;
    const Surface strip(cairo_image_surface_create(CAIRO_FORMAT_RGB24, color_scale_width, image.height),
                        cairo_surface_destroy);
    const auto row_of = [&](int row) {
        return reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(strip.get()) +
                                                row * cairo_image_surface_get_stride(strip.get()));
    };
    if (cairo_surface_status(strip.get()) != CAIRO_STATUS_SUCCESS)
        return Error{ErrorCode::limit, "there is no memory for the scale of colours", {}};
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < color_scale_width; ++column) {
            const Color& c = image.at(left + column, row);
            row_of(row)[column] = byte_of(c.red) << 16 | byte_of(c.green) << 8 | byte_of(c.blue);
        }
    cairo_surface_mark_dirty(strip.get());
    const Cairo cairo(cairo_create(strip.get()), cairo_destroy);
    draw_scale(cairo.get(), image.height, least, greatest);
    cairo_surface_flush(strip.get());
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < color_scale_width; ++column) {
            const auto channel = [&](int shift) {
                return static_cast<float>(row_of(row)[column] >> shift & 255) / 255;
            };
            image.at(left + column, row) = {channel(16), channel(8), channel(0)};
        }
    return Done{};
}

}  // namespace octavo::render
