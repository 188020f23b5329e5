// SPDX-License-Identifier: Apache-2.0
#include "render_cut.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace octavo::cli {
namespace {

std::vector<std::string> parts_of(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    return parts;
}

std::optional<double> share_of(const std::string& text) {
    double share = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), share);
    if (error != std::errc() || end != text.data() + text.size() || !(share >= 0 && share <= 1))
        return std::nullopt;
    return share;
}

std::optional<CutRange> range_of(const std::string& text) {
    const std::vector<std::string> parts = parts_of(text, ':');
    if (parts.size() > 3 || parts[0].size() != 1 || parts[0] < "x" || parts[0] > "z") return std::nullopt;
    CutRange range{parts[0][0] - 'x', 0.5, 1};
    for (std::size_t i = 1; i < parts.size(); ++i) {
        const std::optional<double> share = share_of(parts[i]);
        if (!share) return std::nullopt;
        (i == 1 ? range.from : range.to) = *share;
    }
    if (!(range.from < range.to)) return std::nullopt;
    return range;
}

}  // namespace

std::optional<Cut> parse_cut(const std::string& text) {
    Cut cut;
    if (text.empty()) return cut;
    for (const std::string& part : parts_of(text, ',')) {
        const std::optional<CutRange> range = range_of(part);
        const auto is_same_axis = [&](const CutRange& other) { return range && other.axis == range->axis; };
        if (!range || std::any_of(cut.begin(), cut.end(), is_same_axis)) return std::nullopt;
        cut.push_back(*range);
    }
    return cut;
}

std::string check_cut(const std::string& text) {
    if (!text.empty() && parse_cut(text)) return "";
    return fmt::format(
        "must be x, y or z, and perhaps from which to which share is taken away: x:0.4 keeps the first 40 %, "
        "y:0:0.5 the "
        "last 50 %, and x:0.5,y:0:0.5 takes out a quarter; not {}",
        text);
}

Box3 removed_box(const Cut& cut, const Box3& bounds) {
    Box3 box;
    if (cut.empty()) return box;
    constexpr double infinity = Box3::infinity;
    box = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    for (const auto& [axis, from, to] : cut) {
        const auto at = [&](double share) {
            return bounds.low[axis] + share * (bounds.high[axis] - bounds.low[axis]);
        };
        if (from > 0) box.low[axis] = at(from);
        if (to < 1) box.high[axis] = at(to);
    }
    return box;
}

}  // namespace octavo::cli
