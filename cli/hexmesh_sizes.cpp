// SPDX-License-Identifier: Apache-2.0
#include "hexmesh_sizes.hpp"

#include <string_view>

#include "numbers.hpp"

namespace octavo::cli {

std::optional<FileSizes> parse_sizes(const std::string& text) {
    // File names may have colons; numbers have none. At most two numbers, from the end.
    const std::size_t last = text.rfind(':');
    if (last == std::string::npos || last == 0) return std::nullopt;
    const auto last_number = parse_numbers(std::string_view(text).substr(last + 1));
    if (!last_number || last_number->size() != 1 || (*last_number)[0] < 0) return std::nullopt;
    const std::size_t before = text.rfind(':', last - 1);
    if (before != std::string::npos && before > 0) {
        const auto number = parse_numbers(std::string_view(text).substr(before + 1, last - before - 1));
        if (number && number->size() == 1 && (*number)[0] >= 0)
            return FileSizes{text.substr(0, before), (*number)[0], (*last_number)[0]};
    }
    return FileSizes{text.substr(0, last), (*last_number)[0], 0};
}

std::optional<hexmesh::BoxSize> parse_box(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos) return std::nullopt;
    const auto corners = parse_numbers(std::string_view(text).substr(0, colon));
    const auto size = parse_numbers(std::string_view(text).substr(colon + 1));
    if (!corners || corners->size() != 6 || !size || size->size() != 1 || !((*size)[0] > 0))
        return std::nullopt;
    hexmesh::BoxSize box{{}, (*size)[0]};
    box.box.add(Vec3{(*corners)[0], (*corners)[1], (*corners)[2]});
    box.box.add(Vec3{(*corners)[3], (*corners)[4], (*corners)[5]});
    return box;
}

std::optional<hexmesh::CurvatureSize> parse_curvature(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto size = parse_numbers(std::string_view(text).substr(0, colon));
    if (!size || size->size() != 1 || !((*size)[0] > 0)) return std::nullopt;
    hexmesh::CurvatureSize curvature{(*size)[0]};
    if (colon == std::string::npos) return curvature;
    const auto angle = parse_numbers(std::string_view(text).substr(colon + 1));
    if (!angle || angle->size() != 1 || !((*angle)[0] > 0 && (*angle)[0] <= 180)) return std::nullopt;
    curvature.angle_degrees = (*angle)[0];
    return curvature;
}

}  // namespace octavo::cli
