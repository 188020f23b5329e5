// SPDX-License-Identifier: Apache-2.0
#include "cell_values.hpp"

#include <algorithm>
#include <string_view>

#include <octavo/io/input.hpp>

#include "numbers.hpp"

namespace octavo::cli {
namespace {

Error trouble(ErrorCode code, std::string sentence, const std::string& path, std::size_t line) {
    Error error{code, std::move(sentence), {}};
    error.place.file = path;
    error.place.line = line;
    return error;
}

}  // namespace

Result<std::vector<double>> read_cell_values(const std::string& path, std::size_t count,
                                             const Context& context) {
    const Result<io::ByteBlock> block = io::read_bytes(path, context);
    if (!block) return block.error();
    std::vector<double> values;
    std::size_t line = 0;
    for (std::string_view rest = octavo::text_of(block->bytes()); !rest.empty();) {
        ++line;
        std::string_view text = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), text.size() + 1));
        if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
        if (text.empty()) continue;
        const std::size_t comma = text.rfind(',');
        const auto number = parse_numbers(text.substr(comma == std::string_view::npos ? 0 : comma + 1));
        if (number)
            values.push_back(number->front());
        else if (line > 1)
            return trouble(ErrorCode::bad_input, "there is no number at the end of the line", path, line);
    }
    if (values.size() != count)
        return trouble(
            ErrorCode::bad_input,
            "there are " + std::to_string(values.size()) + " values for " + std::to_string(count) + " cells",
            path, 0);
    return values;
}

}  // namespace octavo::cli
