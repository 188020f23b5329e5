// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>

#include <cairo.h>

#include <octavo/io/output.hpp>
#include <octavo/render/png.hpp>

namespace octavo::render {
namespace {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

std::uint32_t byte_of(float channel) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255));
}

Surface surface_of(const Image& image) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height),
                    cairo_surface_destroy);
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return surface;
    cairo_surface_flush(surface.get());
    unsigned char* bytes = cairo_image_surface_get_data(surface.get());
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface.get());
    for (int row = 0; row < image.height; ++row) {
        std::uint32_t* pixels = reinterpret_cast<std::uint32_t*>(bytes + row * stride);
        for (int column = 0; column < image.width; ++column) {
            const Color& c = image.at(column, row);
            pixels[column] = byte_of(c.red) << 16 | byte_of(c.green) << 8 | byte_of(c.blue);
        }
    }
    cairo_surface_mark_dirty(surface.get());
    return surface;
}

cairo_status_t append(void* output, const unsigned char* bytes, unsigned int size) {
    static_cast<io::Output*>(output)->append(
        std::string_view(reinterpret_cast<const char*>(bytes), std::size_t{size}));
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Status write_png(const std::string& path, const Image& image, const Context& context) {
    Result<io::Output> output = io::Output::to_file(path, context);
    if (!output) return std::move(output).error();
    const Surface surface = surface_of(image);
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &*output);
    if (status == CAIRO_STATUS_SUCCESS) return output->commit();
    Error error{
        ErrorCode::io, std::string("cannot write the picture: ") + cairo_status_to_string(status), {}};
    error.place.file = path;
    return error;
}

}  // namespace octavo::render
