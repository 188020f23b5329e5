// SPDX-License-Identifier: Apache-2.0
#include "printable.hpp"

#include <fmt/format.h>

namespace octavo::cli {
namespace {

unsigned byte_at(std::string_view text, std::size_t at) { return static_cast<unsigned char>(text[at]); }

/// Bytes of the character of UTF-8 that `text` begins with; 0 when it is none, or a control character.
std::size_t size_of_printable(std::string_view text) {
    const unsigned first = byte_at(text, 0);
    if (first < 0x80) return first >= 0x20 && first != 0x7f ? 1 : 0;
    const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < size) return 0;
    for (std::size_t i = 1; i < size; ++i)
        if ((byte_at(text, i) & 0xc0) != 0x80) return 0;
    // The second half of the control characters, U+0080 to U+009F.
    return first == 0xc2 && byte_at(text, 1) < 0xa0 ? 0 : size;
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        std::size_t size = size_of_printable(text);
        if (size == 0 && kept.find(text[0]) != kept.npos) size = 1;
        if (size > 0) {
            result += text.substr(0, size);
        } else {
            size = 1;
            result += text[0] == '\n' ? "\\n" : fmt::format("\\x{:02x}", byte_at(text, 0));
        }
        text.remove_prefix(size);
    }
    return result;
}

}  // namespace octavo::cli
