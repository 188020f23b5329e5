// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include <octavo/io/file_mesh.hpp>
#include <octavo/io/point_text.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

std::string_view trimmed(std::string_view field) {
    while (!field.empty() && TextScanner::is_space(field.front())) field.remove_prefix(1);
    while (!field.empty() && TextScanner::is_space(field.back())) field.remove_suffix(1);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
        field = field.substr(1, field.size() - 2);
    return field;
}

std::optional<double> number_in(std::string_view field) {
    const char* const last = field.data() + field.size();
    const ParsedNumber parsed = parse_number(field.data(), last);
    return parsed.end == last && !field.empty() ? std::optional(parsed.value) : std::nullopt;
}

class PointTextReader {
  public:
    PointTextReader(std::string_view text, const Context& context)
        : scanner_(text), pace_(context, text.size() + 1) {
        points_.reserve(text.size() / 64);
    }

    Result<std::vector<Vec3>> read() {
        bool is_first = true;
        for (scanner_.skip_space_and_comments(); !scanner_.at_end(); scanner_.skip_space_and_comments()) {
            split_line();
            if (is_first) choose_separator();
            if (!is_first || !read_names()) {
                if (const std::optional<Error> trouble = read_point()) return *trouble;
            }
            is_first = false;
            if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
        }
        return std::move(points_);
    }

  private:
    /// Takes the next line apart by `separator_`, where blank means any run of blanks.
    void split_line() {
        line_ = scanner_.rest_of_line();
        split();
    }
    void split() {
        fields_.clear();
        std::string_view rest = line_.substr(0, line_.find('#'));
        while (!rest.empty() && TextScanner::is_space(rest.back())) rest.remove_suffix(1);
        if (separator_ == ' ') {
            TextScanner words(rest);
            for (std::string_view word = words.word(); !word.empty(); word = words.word())
                fields_.push_back(trimmed(word));
            return;
        }
        for (;;) {
            const std::size_t end = rest.find(separator_);
            fields_.push_back(trimmed(rest.substr(0, end)));
            if (end == std::string_view::npos) return;
            rest.remove_prefix(end + 1);
        }
    }
    void choose_separator() {
        for (const char candidate : {';', ',', '\t'})
            if (line_.find(candidate) != std::string_view::npos) {
                separator_ = candidate;
                return split();
            }
    }

    /// Whether the line holds names instead of numbers; then finds x, y and z among them.
    bool read_names() {
        if (std::any_of(fields_.begin(), fields_.end(),
                        [](std::string_view field) { return number_in(field).has_value(); }))
            return false;
        std::array<std::size_t, 3> columns{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const char name[] = {static_cast<char>('x' + axis), '\0'};
            const auto is_named = [&](std::string_view field) { return equals_ignoring_case(field, name); };
            const auto found = std::find_if(fields_.begin(), fields_.end(), is_named);
            if (found == fields_.end()) return true;
            columns[axis] = static_cast<std::size_t>(found - fields_.begin());
        }
        columns_ = columns;
        return true;
    }

    std::optional<Error> read_point() {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t column = columns_[static_cast<std::size_t>(axis)];
            if (column >= fields_.size())
                return scanner_.error_at(line_.data(), "a point needs " + std::to_string(column + 1) +
                                                           " columns, this line has " +
                                                           std::to_string(fields_.size()));
            const std::optional<double> value = number_in(fields_[column]);
            if (!value)
                return scanner_.error_at(
                    fields_[column].data(),
                    "expected a number, found \"" + std::string(fields_[column].substr(0, 32)) + '"');
            point[axis] = *value;
        }
        points_.push_back(point);
        return {};
    }

    TextScanner scanner_;
    ReadingPace pace_;
    char separator_ = ' ';
    std::array<std::size_t, 3> columns_{0, 1, 2};
    std::string_view line_;
    std::vector<std::string_view> fields_;
    std::vector<Vec3> points_;
};

}  // namespace

Result<std::vector<Vec3>> read_point_text(Bytes bytes, const Context& context) {
    std::string_view text = text_of(bytes);
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // spreadsheets mark UTF-8 so
    return PointTextReader(text, context).read();
}

}  // namespace octavo::io
