// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <octavo/boolean/subdivision.hpp>

// Which polygons cover each triangle of a subdivision, when their borders are segments of it: a flood from outside in
// which crossing a border of a polygon enters or leaves it.
//
// Cost: one look at every edge; a copy of the list of polygons only where a border is crossed. Memory is reused by the
// next `find`.

namespace octavo::boolean {

class Cells {
  public:
    /// Segments with the tag `no_border` bound nothing. The subdivision must have begun with `begin_round`.
    void find(const Subdivision& subdivision, std::uint32_t no_border);

    std::size_t size() const { return begin_.size() - 1; }
    std::span<const std::uint32_t> of_triangle() const { return of_triangle_; }
    /// The tags of the polygons on a cell, ascending.
    std::span<const std::uint32_t> cover(std::size_t cell) const {
        return {tags_.data() + begin_[cell], begin_[cell + 1] - begin_[cell]};
    }

  private:
    /// Cells that hang together without a border between them.
    void flood(std::span<const Subdivision::Triangle> triangles);
    bool is_border(std::uint32_t owner) const;
    void add_cell(std::uint32_t beside, std::uint32_t owner);
    void toggle(std::uint32_t tag);

    const Subdivision* subdivision_ = nullptr;
    std::uint32_t no_border_ = 0;
    std::vector<std::uint32_t> of_triangle_;
    std::vector<std::uint32_t> begin_, tags_;
    std::vector<std::uint32_t> stack_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        beyond_;  ///< triangles that are known, and their edges to others across borders
};

}  // namespace octavo::boolean
