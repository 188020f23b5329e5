// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/bsp/build.hpp>

// Planes that part faces without being one's: through an edge of a face and parallel to the axis along which the face
// is seen best, or through what bounded the faces of a tree that is made anew.

namespace octavo::bsp {

/// The best plane of some that cost less than `enough` and have faces on both sides; its local number.
std::optional<std::uint32_t> TreeBuilder::choose_separator(std::uint32_t begin, std::uint32_t end,
                                                           std::uint32_t enough) {
    constexpr std::uint32_t candidates = 4;
    const std::uint32_t count = end - begin;
    std::optional<Separator> best;
    for (std::uint32_t i = 0; i < candidates; ++i) {
        const Piece& piece = pieces_[list_[begin + (2 * i + 1) * count / (2 * candidates)]];
        for (std::uint32_t k = 0; k < piece.count; ++k) {
            const std::optional<Separator> separator = separator_at(piece, corners_[piece.begin + k]);
            if (!separator) continue;
            const Score found = score(*separator, begin, end, enough);
            if (found.front == 0 || found.back == 0 || found.cost() >= enough) continue;
            enough = found.cost();
            best = separator;
        }
    }
    if (!best) return {};
    return add_plane(table_->add(best->points[0], best->points[1], best->points[2]).plane());
}

/// Through the edge that starts at a corner.
std::optional<TreeBuilder::Separator> TreeBuilder::separator_at(const Piece& piece,
                                                                const Corner& corner) const {
    if (corner.edge.is_wall()) return {};
    if (corner.edge.is_plane()) {
        const PlaneId plane = corner.edge.plane_id();
        return Separator{(*table_)[plane], table_->points(plane)};
    }
    const auto [p, q] = pool_->ends_of(corner.edge);
    exact::Point r = p;
    const int axis = (*table_)[planes_[piece.plane]].dominant_axis();
    int step = p[axis] + 1 < exact::universe_side ? 1 : -1;
    (axis == 0 ? r.x : axis == 1 ? r.y : r.z) += step;
    const exact::Plane plane = exact::Plane::through(p, q, r);
    if (plane.degenerate()) return {};
    return Separator{plane, {p, q, r}};
}

/// What a separator does to the pieces; when it costs no less than `enough`, something that does not either.
TreeBuilder::Score TreeBuilder::score(const Separator& separator, std::uint32_t begin, std::uint32_t end,
                                      std::uint32_t enough) const {
    const Coefficients coefficients = coefficients_of(separator.plane);
    Score result;
    for (std::uint32_t i = begin; i < end; ++i) {
        const Piece& piece = pieces_[list_[i]];
        bool front = false, back = false;
        for (std::uint32_t k = 0; k < piece.count && !(front && back); ++k) {
            const int side = ask(corners_[piece.begin + k].vertex, coefficients, separator.plane);
            front = front || side > 0;
            back = back || side < 0;
        }
        result.both += front && back;
        result.front += front && !back;
        result.back += back && !front;
        if (Score{0, 0, result.both}.cost() >= enough) return {0, 0, result.both};
    }
    return result;
}

/// The local number of a plane of the table.
std::uint32_t TreeBuilder::add_plane(PlaneId plane) {
    const std::uint32_t number = plane_number_(plane);
    if (number < planes_.size()) return number;
    planes_.push_back(plane);
    coefficients_.push_back(coefficients_of((*table_)[plane]));
    if (keeps_signs_) {
        sets_.resize(3 * planes_.size() * words_);
        std::fill_n(unasked_set(number), words_, ~Word{0});
    }
    return number;
}

}  // namespace octavo::bsp
