// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

#include <octavo/io/output.hpp>
#include <octavo/render/line_style.hpp>
#include <octavo/render/svg.hpp>

namespace octavo::render {
namespace {

std::string hex(Color color) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const float channel : {color.red, color.green, color.blue}) {
        const long byte = std::lround(std::clamp(channel, 0.0F, 1.0F) * 255);
        text += digits[static_cast<std::size_t>(byte / 16)];
        text += digits[static_cast<std::size_t>(byte % 16)];
    }
    return text;
}

/// Writes numbers and paths in as few characters as SVG needs.
class Writer {
  public:
    explicit Writer(io::Output& output) : output_(output) {}

    void text(std::string_view text) { output_.append(text); }
    void color(std::string_view attribute, Color value) {
        text(" "), text(attribute), text("=\""), text(hex(value)), text("\"");
    }
    void number(std::string_view attribute, double value) {
        text(" "), text(attribute), text("=\"");
        steps(static_cast<std::int32_t>(std::lround(value * steps_of_pixel)), false);
        text("\"");
    }

    /// The commands of a path through these points: the first as it is, the others from the one before.
    void path(const Polyline& line, bool is_closed) {
        output_.append('M');
        steps(line[0].x, false), steps(line[0].y, true);
        for (std::size_t i = 1; i < line.size(); ++i) {
            if (i == 1) output_.append('l');
            steps(line[i].x - line[i - 1].x, i > 1);
            steps(line[i].y - line[i - 1].y, true);
        }
        if (is_closed) output_.append('z');
    }

  private:
    /// `value` hundredths; a space comes before when the number before would go on otherwise.
    void steps(std::int32_t value, bool follows_number) {
        if (value < 0)
            output_.append('-');
        else if (follows_number)
            output_.append(' ');
        const std::uint32_t size = static_cast<std::uint32_t>(std::abs(value));
        const std::uint32_t whole = size / steps_of_pixel, rest = size % steps_of_pixel;
        if (whole > 0 || rest == 0) output_.append_number(std::uint64_t{whole});
        if (rest == 0) return;
        output_.append('.'), output_.append(static_cast<char>('0' + rest / 10));
        if (rest % 10) output_.append(static_cast<char>('0' + rest % 10));
    }

    io::Output& output_;
};

void write_regions(Writer& writer, const Drawing& drawing) {
    writer.text("<g id=\"faces\" stroke-linejoin=\"round\"");
    writer.number("stroke-width", line_style::seam_width);
    writer.text(">\n");
    for (std::size_t begin = 0, end; begin < drawing.regions.size(); begin = end) {
        const Color color = drawing.regions[begin].color;
        writer.text("<g");
        writer.color("fill", color), writer.color("stroke", color);
        writer.text(">\n");
        for (end = begin; end < drawing.regions.size() && drawing.regions[end].color == color; ++end) {
            writer.text("<path d=\"");
            for (const Polyline& loop : drawing.regions[end].loops) writer.path(loop, true);
            writer.text("\"/>\n");
        }
        writer.text("</g>\n");
    }
    writer.text("</g>\n");
}

void write_strokes(Writer& writer, const std::vector<Strokes>& groups) {
    for (const Strokes& strokes : groups) {
        writer.text("<g");
        writer.color("stroke", strokes.color);
        writer.text(">\n");
        for (const Polyline& line : strokes.lines) {
            const bool is_closed = line.size() > 3 && line.front() == line.back();
            writer.text("<path d=\"");
            writer.path(is_closed ? Polyline(line.begin(), line.end() - 1) : line, is_closed);
            writer.text("\"/>\n");
        }
        writer.text("</g>\n");
    }
}

}  // namespace

Status write_svg(const std::string& path, const Drawing& drawing, const Context& context) {
    Result<io::Output> output = io::Output::to_file(path, context);
    if (!output) return std::move(output).error();
    Writer writer(*output);
    writer.text("<svg xmlns=\"http://www.w3.org/2000/svg\"");
    writer.number("width", drawing.width), writer.number("height", drawing.height);
    writer.text(" viewBox=\"0 0 " + std::to_string(drawing.width) + " " + std::to_string(drawing.height) +
                "\">\n<rect width=\"100%\" height=\"100%\"");
    writer.color("fill", drawing.background);
    writer.text("/>\n");
    write_regions(writer, drawing);
    if (!drawing.hidden.empty()) {
        writer.text("<g id=\"hidden-lines\" fill=\"none\"");
        writer.number("stroke-width", line_style::hidden_share * drawing.line_width);
        const auto& dashes = line_style::dashes;
        writer.text(" stroke-dasharray=\"" + std::to_string(dashes[0] * drawing.line_width) + " " +
                    std::to_string(dashes[1] * drawing.line_width) + "\">\n");
        write_strokes(writer, drawing.hidden);
        writer.text("</g>\n");
    }
    writer.text("<g id=\"edges\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"");
    writer.number("stroke-width", drawing.line_width);
    writer.text(">\n");
    write_strokes(writer, drawing.edges);
    writer.text("</g>\n</svg>\n");
    return output->commit();
}

}  // namespace octavo::render
