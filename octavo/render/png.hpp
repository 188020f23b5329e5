// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/render/image.hpp>

namespace octavo::render {

/// Writes 8-bit RGB to the file `path`, which appears whole or not at all, or to standard output when it is "-".
/// Errors: io, cancelled.
Status write_png(const std::string& path, const Image& image, const Context& context = {});

}  // namespace octavo::render
