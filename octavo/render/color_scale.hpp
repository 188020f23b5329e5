// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/result.hpp>
#include <octavo/render/image.hpp>

// What the colours of a picture mean, when they stand for numbers.

namespace octavo::render {

/// `share` of the way from the least value to the greatest.
Color color_of_value(double share);

/// Pixels at the right of the picture that the scale takes: what is drawn should leave them free.
constexpr int color_scale_width = 170;
constexpr bool has_room_for_color_scale(int width, int height) {
    return width >= 2 * color_scale_width && height >= 120;
}

/// Draws a bar in the colours from `least`, below, to `greatest`, with numbers beside it, to the right of the picture.
/// Digits are drawn as lines, so that the picture is the same wherever it is made, whatever fonts there are.
/// Precondition: there is room for it. Error: limit when there is no memory.
Status add_color_scale(Image& image, double least, double greatest);

}  // namespace octavo::render
