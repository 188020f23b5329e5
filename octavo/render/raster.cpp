// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <octavo/base/any_scale.hpp>
#include <octavo/render/raster.hpp>
#include <octavo/render/shading.hpp>

namespace octavo::render {
namespace {

struct Sample {
    float depth = std::numeric_limits<float>::infinity();
    Color color;
    bool capped = false;  // a facet seen from behind, through the cut
};

/// The samples of the whole picture, `samples` times finer than its pixels.
struct Buffer {
    int width, height;
    std::vector<Sample> samples;

    Sample& at(int column, int row) { return samples[static_cast<std::size_t>(row) * width + column]; }
};

struct Corner {
    Vec3 p;      // in samples, with depth
    double cut;  // world coordinate along the cut's axis
};

/// Twice the signed area in the picture, whose y points down: negative for a facet seen from the front.
double turn(Vec3 a, Vec3 b, Vec3 c) { return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y); }

int clamped(double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
}

/// Fills one facet by barycentric coordinates at the sample centres.
void fill(Buffer& buffer, const std::array<Corner, 3>& v, double area, Color color, bool capped,
          double cut_at) {
    const Vec3 a = v[0].p, b = v[1].p, c = v[2].p;
    const int left = clamped(std::floor(std::min({a.x, b.x, c.x})), buffer.width);
    const int right = clamped(std::ceil(std::max({a.x, b.x, c.x})), buffer.width);
    const int top = clamped(std::floor(std::min({a.y, b.y, c.y})), buffer.height);
    const int bottom = clamped(std::ceil(std::max({a.y, b.y, c.y})), buffer.height);
    const bool may_be_cut = std::max({v[0].cut, v[1].cut, v[2].cut}) > cut_at;
    for (int row = top; row < bottom; ++row)
        for (int column = left; column < right; ++column) {
            const Vec3 p{column + 0.5, row + 0.5, 0};
            const double of_b = turn(a, p, c) / area, of_c = turn(a, b, p) / area, of_a = 1 - of_b - of_c;
            if (of_a < 0 || of_b < 0 || of_c < 0) continue;
            if (may_be_cut && of_a * v[0].cut + of_b * v[1].cut + of_c * v[2].cut > cut_at) continue;
            const float depth = static_cast<float>(of_a * a.z + of_b * b.z + of_c * c.z);
            Sample& sample = buffer.at(column, row);
            if (depth < sample.depth) sample = {depth, color, capped};
        }
}

/// Draws a line as a row of squares `width` samples wide, tested `bias` nearer to the viewer than it is.
void trace(Buffer& buffer, const Corner& from, const Corner& to, Color color, double width, double bias,
           double cut_at) {
    const double span = std::max(std::fabs(to.p.x - from.p.x), std::fabs(to.p.y - from.p.y));
    if (!std::isfinite(span)) return;
    const int steps = static_cast<int>(std::min(std::ceil(span), 1e6)) + 1;
    const int side = std::max(1, static_cast<int>(std::lround(width)));
    for (int step = 0; step <= steps; ++step) {
        const double t = static_cast<double>(step) / steps;
        if (from.cut * (1 - t) + to.cut * t > cut_at) continue;
        const Vec3 p = from.p + t * (to.p - from.p);
        const float depth = static_cast<float>(p.z - bias);
        const int left = clamped(std::floor(p.x - side / 2.0 + 0.5), buffer.width);
        const int top = clamped(std::floor(p.y - side / 2.0 + 0.5), buffer.height);
        for (int row = top; row < std::min(buffer.height, top + side); ++row)
            for (int column = left; column < std::min(buffer.width, left + side); ++column) {
                Sample& sample = buffer.at(column, row);
                if (depth < sample.depth && !sample.capped) sample.color = color;
            }
    }
}

/// Draws the outline of what is capped: the samples within `width` / 2 of a neighbour that is not.
void outline_cap(Buffer& buffer, double width) {
    std::vector<std::pair<int, int>> rim;
    for (int row = 0; row < buffer.height; ++row)
        for (int column = 0; column < buffer.width; ++column) {
            const bool capped = buffer.at(column, row).capped;
            if ((column + 1 < buffer.width && buffer.at(column + 1, row).capped != capped) ||
                (row + 1 < buffer.height && buffer.at(column, row + 1).capped != capped))
                rim.emplace_back(column, row);
        }
    const int side = std::max(1, static_cast<int>(std::lround(width)));
    for (const auto& [column, row] : rim)
        for (int y = std::max(0, row - side / 2); y < std::min(buffer.height, row - side / 2 + side); ++y)
            for (int x = std::max(0, column - side / 2); x < std::min(buffer.width, column - side / 2 + side);
                 ++x)
                buffer.at(x, y).color = palette::ink;
}

Image average(Buffer& buffer, int samples) {
    Image image{buffer.width / samples, buffer.height / samples, {}};
    image.pixels.resize(static_cast<std::size_t>(image.width) * image.height);
    const float share = 1.0F / static_cast<float>(samples * samples);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            Color sum;
            for (int k = 0; k < samples * samples; ++k) {
                const Color& c = buffer.at(column * samples + k % samples, row * samples + k / samples).color;
                sum = {sum.red + c.red, sum.green + c.green, sum.blue + c.blue};
            }
            image.at(column, row) = {sum.red * share, sum.green * share, sum.blue * share};
        }
    return image;
}

}  // namespace

Result<Image> draw(const Scene& scene, const Camera& camera, const DrawOptions& options,
                   const Context& context) {
    if (Status size = check_size(options.width, options.height); !size) return std::move(size).error();
    if (options.samples < 1 || options.samples > 8)
        return Error{ErrorCode::bad_input, "samples must lie between 1 and 8", {}};

    Buffer buffer{options.width * options.samples, options.height * options.samples, {}};
    buffer.samples.assign(static_cast<std::size_t>(buffer.width) * buffer.height,
                          Sample{std::numeric_limits<float>::infinity(), options.background, false});
    const auto project = [&](Vec3 world) {
        const Vec3 p = camera.project(world);
        return Corner{{p.x * options.samples, p.y * options.samples, p.z}, world[options.cut_axis]};
    };

    for (std::size_t i = 0; i < scene.facets.size(); ++i) {
        if (i % 65536 == 0) {
            if (context.cancelled()) return Context::cancelled_error();
            context.report("drawing", static_cast<double>(i) / static_cast<double>(scene.facets.size()));
        }
        const Facet& facet = scene.facets[i];
        const Vec3 normal =
            cross_direction(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
        const double size = length(normal);
        const std::array<Corner, 3> v{project(facet.corners[0]), project(facet.corners[1]),
                                      project(facet.corners[2])};
        const double area = turn(v[0].p, v[1].p, v[2].p);
        if (size == 0 || area == 0 || !std::isfinite(area)) continue;
        const bool front = area < 0;
        const bool capped = !front && options.cut_at < Box3::infinity;
        const float light =
            capped || facet.is_cap ? cap_light : lightness((front ? 1 : -1) / size * normal, camera);
        fill(buffer, v, area, shade(front ? facet.front : facet.back, light), capped, options.cut_at);
    }

    // Far enough to clear the facets that meet in the line, near enough not to shine through thin walls.
    const Box3 bounds = scene.bounds();
    const double bias =
        bounds.empty() ? 0 : length(camera.scaled(bounds.high) - camera.scaled(bounds.low)) * 2e-3;
    for (const Line& line : scene.lines)
        trace(buffer, project(line.from), project(line.to), line.color, options.line_width * options.samples,
              bias, options.cut_at);
    if (options.cut_at < Box3::infinity && options.outline_cap)
        outline_cap(buffer, options.line_width * options.samples);
    return average(buffer, options.samples);
}

}  // namespace octavo::render
