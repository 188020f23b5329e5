// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/render/image.hpp>

// The colours of Octavo's pictures, in one place so that all pictures of the documentation match.

namespace octavo::render::palette {

inline constexpr Color paper{1.0F, 1.0F, 1.0F};
inline constexpr Color ink{0.10F, 0.13F, 0.18F};
inline constexpr Color solid{0.62F, 0.70F, 0.79F};  ///< the outside of a solid
inline constexpr Color inner{0.88F, 0.55F, 0.36F};  ///< the inside of a surface, seen through a cut
inline constexpr Color black_cell{0.27F, 0.42F, 0.60F};
inline constexpr Color gray_cell{0.95F, 0.72F, 0.30F};

}  // namespace octavo::render::palette
