// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include <octavo/base/result.hpp>
#include <octavo/render/image.hpp>

namespace octavo::render {

/// Writes 8-bit RGB, under a temporary name that is renamed at the end. Errors: io.
Status write_png(const std::filesystem::path& path, const Image& image);

}  // namespace octavo::render
