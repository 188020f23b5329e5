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
        for (scanner_.skip_space_and_comments(); !scanner_.at_end(); scanner_.skip_space_and_comments()) {
            split_line();
            const bool is_first = width_ == 0;
            if (is_first) begin_table();
            const bool is_names = is_first && holds_names();
            if (const std::optional<Error> trouble = is_names ? read_names() : read_point()) return *trouble;
            if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
        }
        if (points_.empty() && !is_named_) return Error{ErrorCode::bad_input, "has no points", {}};
        return std::move(points_);
    }

  private:
    /// Takes the next line apart by `separator_`, where blank means any run of blanks.
    void split_line() {
        line_ = scanner_.rest_of_line();
        line_ = line_.substr(0, line_.find('#'));
        split();
    }
    void split() {
        fields_.clear();
        std::string_view rest = line_;
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
    /// The first line decides the separator and the number of columns.
    void begin_table() {
        for (const char candidate : {';', ',', '\t'})
            if (line_.find(candidate) != std::string_view::npos) {
                separator_ = candidate;
                split();
                break;
            }
        width_ = fields_.size();
    }

    bool holds_names() const { return std::none_of(fields_.begin(), fields_.end(), starts_like_number); }

    /// Finds x, y and z. Three columns of other names are taken as they come; which of more are meant, nobody knows.
    std::optional<Error> read_names() {
        int found = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const char name[] = {static_cast<char>('x' + axis), '\0'};
            const auto is_axis = [&](std::string_view field) { return equals_ignoring_case(field, name); };
            const auto column = std::find_if(fields_.begin(), fields_.end(), is_axis);
            if (column == fields_.end()) continue;
            const auto again = std::find_if(column + 1, fields_.end(), is_axis);
            if (again != fields_.end())
                return scanner_.error_at(again->data(), "a second column is named " + std::string(*again));
            columns_[axis] = static_cast<std::size_t>(column - fields_.begin());
            ++found;
        }
        is_named_ = found == 3;
        if (is_named_ || (found == 0 && width_ == 3)) return {};
        return scanner_.error_at(line_.data(),
                                 "expected columns named x, y and z, or three numbers, found \"" +
                                     std::string(line_.substr(0, 32)) + '"');
    }

    std::optional<Error> read_point() {
        if (width_ < 3)
            return scanner_.error_at(line_.data(),
                                     "a point needs 3 columns, this line has " + std::to_string(width_));
        if (fields_.size() != width_)
            return scanner_.error_at(line_.data(), "the first line has " + std::to_string(width_) +
                                                       " columns, this line has " +
                                                       std::to_string(fields_.size()));
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t column = columns_[static_cast<std::size_t>(axis)];
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
    std::size_t width_ = 0;  ///< columns of the first line; 0 before it
    bool is_named_ = false;  ///< x, y and z are among the names
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
