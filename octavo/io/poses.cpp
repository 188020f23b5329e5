// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/io/input.hpp>
#include <octavo/io/poses.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

bool separates(char c) { return c == ',' || c == ';' || TextScanner::is_space(c); }

/// The fields of one line.
std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    line = line.substr(0, line.find('#'));
    while (true) {
        while (!line.empty() && separates(line.front())) line.remove_prefix(1);
        if (line.empty()) return fields;
        const auto end = std::find_if(line.begin(), line.end(), separates);
        fields.push_back(line.substr(0, static_cast<std::size_t>(end - line.begin())));
        line.remove_prefix(fields.back().size());
    }
}

std::optional<double> number_in(std::string_view field) {
    const char* const last = field.data() + field.size();
    const ParsedNumber parsed = parse_number(field.data(), last);
    return parsed.end == last ? std::optional(parsed.value) : std::nullopt;
}

Affine pose_of(const std::vector<double>& numbers) {
    Affine pose;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (numbers.size() == 3)
            pose.m[i][3] = numbers[i];
        else
            pose.m[i / 4][i % 4] = numbers[i];
    }
    return pose;
}

}  // namespace

Result<std::vector<Affine>> read_poses(Bytes bytes, const Context& context) {
    std::string_view text = text_of(bytes);
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    TextScanner scanner(text);
    std::vector<Affine> poses;
    std::vector<double> numbers;
    bool may_be_names = true;
    for (scanner.skip_space_and_comments(); !scanner.at_end(); scanner.skip_space_and_comments()) {
        if (context.cancelled()) return Context::cancelled_error();
        const char* const start = scanner.position();
        const std::vector<std::string_view> fields = fields_of(scanner.rest_of_line());
        const bool is_names = may_be_names && std::none_of(fields.begin(), fields.end(), starts_like_number);
        may_be_names = false;
        if (is_names || fields.empty()) continue;
        numbers.clear();
        for (const std::string_view field : fields) {
            const std::optional<double> number = number_in(field);
            if (!number || !std::isfinite(*number))
                return scanner.error_at(field.data(), "expected a finite number, found \"" +
                                                          std::string(field.substr(0, 32)) + '"');
            numbers.push_back(*number);
        }
        if (numbers.size() != 3 && numbers.size() != 12)
            return scanner.error_at(
                start, "a pose has 3 or 12 numbers, this line has " + std::to_string(numbers.size()));
        poses.push_back(pose_of(numbers));
    }
    if (poses.empty()) return Error{ErrorCode::bad_input, "there is no pose in it", {}};
    return poses;
}

Result<std::vector<Affine>> read_poses(const std::string& path, const Context& context) {
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return block.error();
    Result<std::vector<Affine>> poses = read_poses(block->bytes(), context);
    if (poses) return poses;
    Error error = std::move(poses).error();
    error.place.file = path == "-" ? "standard input" : path;
    return error;
}

}  // namespace octavo::io
