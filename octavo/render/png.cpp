// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include <cairo.h>

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

}  // namespace

Status write_png(const std::filesystem::path& path, const Image& image) {
    const Surface surface = surface_of(image);
    std::filesystem::path temporary = path;
    temporary += ".part";
    const cairo_status_t status = cairo_surface_write_to_png(surface.get(), temporary.c_str());
    std::error_code failed, ignored;
    if (status == CAIRO_STATUS_SUCCESS) std::filesystem::rename(temporary, path, failed);
    if (status == CAIRO_STATUS_SUCCESS && !failed) return Done{};
    std::filesystem::remove(temporary, ignored);
    Error error{ErrorCode::io, "cannot write the picture: ", {}};
    error.sentence += status != CAIRO_STATUS_SUCCESS ? cairo_status_to_string(status) : failed.message();
    error.place.file = path.string();
    return error;
}

}  // namespace octavo::render
