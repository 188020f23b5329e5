// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <octavo/base/result.hpp>
#include <octavo/io/number.hpp>

// Walks over the text of a file, word by word or line by line. Line numbers are not kept on the way: an error
// counts the line ends before it once, so that the common case pays nothing. Lines end with LF, CR LF or CR;
// every character up to 32 is space, NUL too, because writers pad with it.

namespace octavo::io {

class TextScanner {
  public:
    explicit TextScanner(std::string_view text)
        : begin_(text.data()), at_(text.data()), end_(text.data() + text.size()) {}

    const char* position() const { return at_; }
    std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
    bool at_end() const { return at_ == end_; }
    char peek() const { return at_ == end_ ? '\0' : *at_; }
    void advance() { ++at_; }
    void go_to(const char* position) { at_ = position; }

    static bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }
    static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

    void skip_space() {
        while (at_ != end_ && is_space(*at_)) ++at_;
    }
    /// Skips space but stays in the line.
    void skip_blanks() {
        while (at_ != end_ && is_space(*at_) && !is_line_end(*at_)) ++at_;
    }
    bool at_line_end() const { return at_ == end_ || is_line_end(*at_); }
    /// Goes to the line end, or to the end of the text.
    void skip_line() {
        while (at_ != end_ && !is_line_end(*at_)) ++at_;
    }
    /// Skips space and everything from `mark` to the end of its line.
    void skip_space_and_comments(char mark = '#') {
        for (skip_space(); at_ != end_ && *at_ == mark; skip_space()) skip_line();
    }

    /// The characters up to the next space; empty at the end of the text.
    std::string_view word() {
        skip_space();
        const char* const first = at_;
        while (at_ != end_ && !is_space(*at_)) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }
    /// The rest of the line, without blanks around it.
    std::string_view rest_of_line() {
        skip_blanks();
        const char* const first = at_;
        skip_line();
        const char* last = at_;
        while (last != first && is_space(last[-1])) --last;
        return {first, static_cast<std::size_t>(last - first)};
    }

    /// The next number, which must end at space, at a comment or continuation mark (# or \) or with the text;
    /// the scanner does not move when there is none.
    std::optional<double> number() {
        skip_space();
        const ParsedNumber parsed = parse_number(at_, end_);
        if (!parsed.end) return {};
        if (parsed.end != end_ && !is_space(*parsed.end) && *parsed.end != '#' && *parsed.end != '\\')
            return {};
        at_ = parsed.end;
        return parsed.value;
    }
    /// The next number when it is a whole one below 2^53.
    std::optional<std::uint64_t> count() {
        const char* const before = at_;
        const std::optional<double> value = number();
        if (value && *value >= 0 && *value < 0x1p53 && *value == std::floor(*value))
            return static_cast<std::uint64_t>(*value);
        at_ = before;
        return {};
    }

    /// An error at `where`, a position in the text.
    Error error_at(const char* where, std::string sentence) const;
    /// An error at the next word that is not space.
    Error error_here(std::string sentence) {
        skip_space();
        return error_at(at_, std::move(sentence));
    }
    /// The word at the position, shortened, in quotes, for a message; "the end of the file" at the end.
    std::string quoted() const;

  private:
    const char* begin_;
    const char* at_;
    const char* end_;
};

/// Whether `text` begins as numbers do, though it may be none ("1,5"): such a text is no name of a column.
bool starts_like_number(std::string_view text);

/// Whether `text` is `lower`, a word in lower case, in any case.
bool equals_ignoring_case(std::string_view text, std::string_view lower);

}  // namespace octavo::io
