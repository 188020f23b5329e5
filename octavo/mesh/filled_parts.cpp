// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include <octavo/mesh/filled_parts.hpp>

namespace octavo::mesh {
namespace {

/// Pairs of solids that overlap.
class Overlaps {
  public:
    Overlaps(std::span<const SolidSet> sets, std::span<const std::uint16_t> set_of_cell,
             std::span<const double> fractions) {
        std::vector<bool> occurs(sets.size(), false);
        std::size_t next = 0;
        for (const std::uint16_t number : set_of_cell) {
            const SolidSet& set = sets[number];
            const std::span<const double> parts = fractions.subspan(next, set.boundary.size());
            next += parts.size();
            occurs[number] = true;
            for (std::size_t i = 0; i < parts.size(); ++i)
                for (std::size_t k = i + 1; k < parts.size(); ++k)
                    if (parts[i] + parts[k] > 1 + rounding) add(set.boundary[i], set.boundary[k]);
        }
        for (std::size_t number = 0; number < sets.size(); ++number) {
            if (!occurs[number]) continue;
            const SolidSet& set = sets[number];
            for (std::size_t i = 0; i < set.inside.size(); ++i) {
                for (std::size_t k = i + 1; k < set.inside.size(); ++k) add(set.inside[i], set.inside[k]);
                for (const SolidIndex other : set.boundary) add(set.inside[i], other);
            }
        }
    }
    bool contains(SolidIndex a, SolidIndex b) const { return pairs_.count(std::minmax(a, b)) > 0; }

  private:
    static constexpr double rounding = 1e-9;  // of fractions
    void add(SolidIndex a, SolidIndex b) { pairs_.insert(std::minmax(a, b)); }
    std::set<std::pair<SolidIndex, SolidIndex>> pairs_;
};

using Part = std::pair<double, SolidIndex>;

/// Takes the largest part, and each next one that overlaps none of those taken.
double together(std::vector<Part>& parts, const Overlaps& overlaps) {
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
        return a.first > b.first || (a.first == b.first && a.second < b.second);
    });
    double sum = 0;
    std::vector<SolidIndex> taken;
    for (const auto& [part, solid] : parts) {
        if (std::any_of(taken.begin(), taken.end(),
                        [&, solid = solid](SolidIndex other) { return overlaps.contains(solid, other); }))
            continue;
        sum += part;
        taken.push_back(solid);
    }
    return sum;
}

}  // namespace

std::vector<double> filled_parts(std::span<const SolidSet> sets, std::span<const std::uint16_t> set_of_cell,
                                 std::span<const double> fractions) {
    const Overlaps overlaps(sets, set_of_cell, fractions);
    std::vector<double> filled;
    filled.reserve(set_of_cell.size());
    std::vector<Part> parts;
    std::size_t next = 0;
    for (const std::uint16_t number : set_of_cell) {
        const SolidSet& set = sets[number];
        parts.clear();
        for (const SolidIndex solid : set.boundary) parts.push_back({fractions[next++], solid});
        const double part = !set.inside.empty() ? 1
                            : parts.size() == 1 ? parts[0].first
                                                : together(parts, overlaps);
        filled.push_back(std::clamp(part, 0.0, 1.0));
    }
    return filled;
}

}  // namespace octavo::mesh
