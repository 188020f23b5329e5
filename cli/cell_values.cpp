// SPDX-License-Identifier: Apache-2.0
#include "cell_values.hpp"

#include <fstream>

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

Result<std::vector<double>> read_cell_values(const std::string& path, std::size_t count) {
    std::ifstream file(path);
    if (!file) return trouble(ErrorCode::io, "cannot be read", path, 0);
    std::vector<double> values;
    std::size_t line = 0;
    for (std::string text; std::getline(file, text);) {
        ++line;
        if (!text.empty() && text.back() == '\r') text.pop_back();
        if (text.empty()) continue;
        const std::size_t comma = text.rfind(',');
        const auto number =
            parse_numbers(std::string_view(text).substr(comma == std::string::npos ? 0 : comma + 1));
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
