// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <octavo/base/vec3.hpp>

// What `render --cut` takes away: what lies between two shares of the bounds, on one axis or on several at once.

namespace octavo::cli {

struct CutRange {
    int axis = 0;
    double from = 0.5, to = 1;  ///< shares of the bounds; 0 and 1 are infinite
};

/// An empty list cuts nothing.
using Cut = std::vector<CutRange>;

/// From AXIS[:FROM[:TO]], several with commas between; none when `text` is not that.
std::optional<Cut> parse_cut(const std::string& text);

/// For the option: empty when the text is one, else what is wrong.
std::string check_cut(const std::string& text);

/// What the cut takes away of something with these bounds; sides may be infinite.
Box3 removed_box(const Cut& cut, const Box3& bounds);

}  // namespace octavo::cli
