// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <octavo/base/grouped.hpp>

// One of a thing, or several.

namespace octavo {

/// "1 edge has" or "12 edges have".
inline std::string counted(std::uint64_t count, std::string_view one, std::string_view many) {
    return grouped(count).append(" ").append(count == 1 ? one : many);
}

}  // namespace octavo
