// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {

Error TextScanner::error_at(const char* where, std::string sentence) const {
    Place place;
    place.line = 1;
    const char* line_begin = begin_;
    for (const char* p = begin_; p != where; ++p) {
        if (*p == '\n' || (*p == '\r' && (p + 1 == end_ || p[1] != '\n'))) {
            ++place.line;
            line_begin = p + 1;
        }
    }
    place.column = static_cast<std::uint64_t>(where - line_begin) + 1;
    return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
}

std::string TextScanner::quoted() const {
    TextScanner ahead = *this;
    const std::string_view word = ahead.word();
    if (word.empty()) return "the end of the file";
    constexpr std::size_t longest = 32;
    std::string text = "\"";
    for (const char c : word.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '?';
    return text + (word.size() > longest ? "…\"" : "\"");
}

bool equals_ignoring_case(std::string_view text, std::string_view lower) {
    if (text.size() != lower.size()) return false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i] >= 'A' && text[i] <= 'Z' ? static_cast<char>(text[i] - 'A' + 'a') : text[i];
        if (c != lower[i]) return false;
    }
    return true;
}

}  // namespace octavo::io
