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

bool starts_like_number(std::string_view text) {
    if (text.empty()) return false;
    if (std::string_view("+-.0123456789").find(text.front()) != std::string_view::npos) return true;
    const char* const last = text.data() + text.size();
    return parse_number(text.data(), last).end == last;  // nan and inf, but not names that begin so
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
