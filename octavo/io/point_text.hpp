// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>

// Points as text, a line each; points.hpp says what is understood.

namespace octavo::io {

Result<std::vector<Vec3>> read_point_text(Bytes bytes, const Context& context);

}  // namespace octavo::io
