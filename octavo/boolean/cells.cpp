// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/cells.hpp>

namespace octavo::boolean {
namespace {

/// The corner of the triangle round everything lies in no polygon.
std::uint32_t outer_triangle(const Subdivision& subdivision) {
    const auto triangles = subdivision.triangles();
    for (std::uint32_t i = 0;; ++i)
        for (const Subdivision::VertexId v : triangles[i].v)
            if (subdivision.point_of(v) == no_index) return i;
}

}  // namespace

void Cells::find(const Subdivision& subdivision, std::uint32_t no_border) {
    subdivision_ = &subdivision, no_border_ = no_border;
    const auto triangles = subdivision.triangles();
    of_triangle_.assign(triangles.size(), no_index);
    begin_.assign(2, 0), tags_.clear(), beyond_.clear();
    stack_.assign(1, outer_triangle(subdivision));
    of_triangle_[stack_[0]] = 0;
    // Cells are flooded whole, so that few lists are made: triangles beyond borders wait.
    for (;;) {
        flood(triangles);
        while (!beyond_.empty() &&
               of_triangle_[triangles[beyond_.back().first].neighbour[beyond_.back().second]] != no_index)
            beyond_.pop_back();
        if (beyond_.empty()) return;
        const auto [at, k] = beyond_.back();
        beyond_.pop_back();
        const std::uint32_t next = triangles[at].neighbour[k];
        of_triangle_[next] = static_cast<std::uint32_t>(size());
        add_cell(of_triangle_[at], triangles[at].owner[k]);
        stack_.push_back(next);
    }
}

void Cells::flood(std::span<const Subdivision::Triangle> triangles) {
    while (!stack_.empty()) {
        const std::uint32_t at = stack_.back();
        stack_.pop_back();
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t next = triangles[at].neighbour[k];
            if (next == no_index || of_triangle_[next] != no_index) continue;
            if (is_border(triangles[at].owner[k])) {
                beyond_.push_back({at, k});
            } else {
                of_triangle_[next] = of_triangle_[at];
                stack_.push_back(next);
            }
        }
    }
}

bool Cells::is_border(std::uint32_t owner) const {
    for (; owner; owner = subdivision_->owner(owner - 1).next)
        if (subdivision_->owner(owner - 1).tag != no_border_) return true;
    return false;
}

/// The cell across an edge from the cell `beside`.
void Cells::add_cell(std::uint32_t beside, std::uint32_t owner) {
    for (std::uint32_t i = begin_[beside]; i < begin_[beside + 1]; ++i)
        tags_.push_back(std::uint32_t{tags_[i]});
    for (; owner; owner = subdivision_->owner(owner - 1).next) {
        const std::uint32_t tag = subdivision_->owner(owner - 1).tag;
        if (tag != no_border_) toggle(tag);
    }
    begin_.push_back(static_cast<std::uint32_t>(tags_.size()));
}

/// In the list of the last cell.
void Cells::toggle(std::uint32_t tag) {
    const auto place = std::lower_bound(tags_.begin() + begin_.back(), tags_.end(), tag);
    if (place != tags_.end() && *place == tag)
        tags_.erase(place);
    else
        tags_.insert(place, tag);
}

}  // namespace octavo::boolean
