// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace octavo::cli {

/// `text` in which control characters and bytes that are no UTF-8 are written out, as \x1b: a terminal would obey them,
/// and the names of files, which others choose, come into messages. Those of `kept` stay.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace octavo::cli
