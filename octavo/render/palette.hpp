// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <octavo/render/image.hpp>

// The colours of Octavo's pictures, in one place so that all pictures of the documentation match.

namespace octavo::render::palette {

inline constexpr Color paper{1.0F, 1.0F, 1.0F};
inline constexpr Color ink{0.10F, 0.13F, 0.18F};
inline constexpr Color solid{0.62F, 0.70F, 0.79F};  ///< the outside of a solid
inline constexpr Color inner{0.88F, 0.55F, 0.36F};  ///< the inside of a surface, seen through a cut
inline constexpr Color black_cell{0.27F, 0.42F, 0.60F};
inline constexpr Color gray_cell{0.95F, 0.72F, 0.30F};

/// Solids of a mesh, one after the other.
inline constexpr std::array<Color, 6> solids{Color{0.45F, 0.60F, 0.76F}, Color{0.95F, 0.72F, 0.30F},
                                             Color{0.55F, 0.72F, 0.45F}, Color{0.80F, 0.50F, 0.48F},
                                             Color{0.62F, 0.53F, 0.74F}, Color{0.60F, 0.60F, 0.58F}};
/// Leaves of a BSP-octree by the planes in them: one, two, up to four, up to eight, more.
inline constexpr std::array<Color, 5> planes_of_leaf{Color{0.62F, 0.70F, 0.79F}, Color{0.55F, 0.72F, 0.45F},
                                                     Color{0.95F, 0.72F, 0.30F}, Color{0.90F, 0.52F, 0.30F},
                                                     Color{0.74F, 0.32F, 0.36F}};
/// From the least to the greatest value.
inline constexpr std::array<Color, 5> values{Color{0.19F, 0.31F, 0.63F}, Color{0.40F, 0.68F, 0.78F},
                                             Color{0.93F, 0.92F, 0.70F}, Color{0.96F, 0.62F, 0.33F},
                                             Color{0.74F, 0.11F, 0.16F}};

}  // namespace octavo::render::palette
