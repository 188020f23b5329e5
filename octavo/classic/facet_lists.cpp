// SPDX-License-Identifier: Apache-2.0
#include <octavo/classic/facet_lists.hpp>

namespace octavo::classic {
namespace {

/// For each set of octants the steps by which they are reached from octant 0.
constexpr std::array<std::uint8_t, 256> make_paths_table() {
    std::array<std::uint8_t, 256> table{};
    for (unsigned octants = 0; octants < 256; ++octants) {
        unsigned reached = octants;
        for (unsigned i = octant_steps.size(); i-- > 0;) {
            const unsigned to = octant_steps[i].from + (1U << octant_steps[i].axis);
            if (!(reached >> to & 1U)) continue;
            table[octants] = static_cast<std::uint8_t>(table[octants] | 1U << i);
            reached |= 1U << octant_steps[i].from;
        }
    }
    return table;
}
constexpr std::array<std::uint8_t, 256> paths_table = make_paths_table();

/// The facets of one cell against its octants: bounds first, then the rest of the overlap test for the facets that
/// need it, then the crossings of those that may have some.
template <Touch touch>
class Survey {
  public:
    Survey(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
           FacetLists& lists)
        : facets_(facets), cell_(cell), range_(range), list_(lists.list(cell.level, range)), lists_(lists) {
        if (lists.octants.size() < list_.size()) {
            lists.octants.resize(list_.size());
            lists.undecided.resize(list_.size());
            lists.stepping.resize(list_.size());
        }
        const OctantFrame<touch> frame(cell);
        for (std::uint32_t i = 0; i < list_.size(); ++i) {
            const Bounds bounds = frame.bounds(facets[list_[i]]);
            lists.octants[i] = bounds.octants;
            touched_ |= bounds.is_exact ? bounds.octants : OctantSet{0};
            lists.undecided[undecided_] = i;
            undecided_ += !bounds.is_exact;
            lists.stepping[stepping_] = {list_[i], bounds.steps};
            stepping_ += bounds.steps != 0;
        }
    }

    /// Decides for every facet which octants it touches.
    void decide_all() {
        for (std::size_t i = 0; i < undecided_; i += 4) {
            std::array<const Facet*, 4> four{};
            const std::size_t count = std::min<std::size_t>(4, undecided_ - i);
            for (std::size_t k = 0; k < count; ++k) four[k] = &facets_[list_[lists_.undecided[i + k]]];
            const std::array<OctantSet, 4> touched = touched_octants(four, cell_, touch);
            for (std::size_t k = 0; k < count; ++k) {
                OctantSet& octants = lists_.octants[lists_.undecided[i + k]];
                octants &= touched[k];
                touched_ |= octants;
            }
        }
    }

    /// Decides only which octants are touched: skips facets that can add none.
    void decide_touched() {
        for (std::size_t i = 0; i < undecided_;) {
            std::array<const Facet*, 4> four{};
            std::array<OctantSet, 4> octants{};
            std::size_t count = 0;
            for (; i < undecided_ && count < 4; ++i) {
                const OctantSet candidates = lists_.octants[lists_.undecided[i]];
                if ((candidates & ~touched_) == 0) continue;
                octants[count] = candidates;
                four[count++] = &facets_[list_[lists_.undecided[i]]];
            }
            if (count == 0) return;
            const std::array<OctantSet, 4> touched = touched_octants(four, cell_, touch);
            for (std::size_t k = 0; k < count; ++k) touched_ |= octants[k] & touched[k];
        }
    }

    OctantSet touched() const { return touched_; }

    /// The winding numbers at the displaced low corners of the octants in `wanted`; the others mean nothing.
    std::array<std::int32_t, 8> windings(OctantSet wanted) const {
        const std::int32_t half = cell_.side() / 2;
        const unsigned needed = paths_table[wanted];
        std::array<std::int32_t, 7> change{};
        for (std::size_t s = 0; s < stepping_; ++s)
            for (unsigned steps = lists_.stepping[s].steps & needed; steps != 0; steps &= steps - 1) {
                const std::size_t i = static_cast<std::size_t>(std::countr_zero(steps));
                const exact::Point from = cell_.child(octant_steps[i].from).low;
                change[i] += crossing(facets_[lists_.stepping[s].facet], {from.x, from.y, from.z},
                                      octant_steps[i].axis, half);
            }
        std::array<std::int32_t, 8> winding{};
        winding[0] = range_.winding;
        for (std::size_t i = 0; i < octant_steps.size(); ++i)
            winding[octant_steps[i].from + (std::size_t{1} << octant_steps[i].axis)] =
                winding[octant_steps[i].from] + change[i];
        return winding;
    }

  private:
    std::span<const Facet> facets_;
    const octree::Cell& cell_;
    const FacetRange& range_;
    std::span<const std::uint32_t> list_;
    FacetLists& lists_;
    std::size_t undecided_ = 0, stepping_ = 0;
    OctantSet touched_ = 0;
};

}  // namespace

FacetRange universe_facets(std::span<const Facet> facets, Touch touch, FacetLists& lists) {
    lists.levels[0].ensure(facets.size(), 0);
    FacetRange range;
    for (std::uint32_t i = 0; i < facets.size(); ++i) {
        const Facet& facet = facets[i];
        const bool in_low_side = facet.high[0] == 0 || facet.high[1] == 0 || facet.high[2] == 0;
        if (touch == Touch::half_open || !in_low_side) lists.levels[0].data()[range.end++] = i;
        // From outside the universe, where the winding number is zero, to its displaced low corner.
        if (facet.low[0] == 0) range.winding += crossing(facet, {-1, 0, 0}, 0, 1);
    }
    return range;
}

template <Touch touch>
OctantFacets find_octants(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
                          FacetLists& lists) {
    Survey<touch> survey(facets, cell, range, lists);
    survey.decide_all();
    return {survey.touched(), survey.windings(0xFF)};
}

template <Touch touch>
OctantFacets find_touched(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
                          FacetLists& lists) {
    Survey<touch> survey(facets, cell, range, lists);
    survey.decide_touched();
    return {survey.touched(), survey.windings(static_cast<OctantSet>(~survey.touched()))};
}

template OctantFacets find_octants<Touch::interior>(std::span<const Facet>, const octree::Cell&,
                                                    const FacetRange&, FacetLists&);
template OctantFacets find_octants<Touch::half_open>(std::span<const Facet>, const octree::Cell&,
                                                     const FacetRange&, FacetLists&);
template OctantFacets find_touched<Touch::interior>(std::span<const Facet>, const octree::Cell&,
                                                    const FacetRange&, FacetLists&);

std::array<FacetRange, 8> distribute(const octree::Cell& cell, const FacetRange& range,
                                     const OctantFacets& found, FacetLists& lists) {
    const std::span<const std::uint32_t> list = lists.list(cell.level, range);
    IndexBuffer& next = lists.levels[static_cast<std::size_t>(cell.level) + 1];
    std::array<FacetRange, 8> ranges{};
    std::uint32_t size = 0;
    for (unsigned octant = 0; octant < 8; ++octant) {
        ranges[octant] = {size, size, found.winding[octant]};
        if (!(found.touched >> octant & 1)) continue;
        next.ensure(size + list.size(), size);
        std::uint32_t* out = next.data();
        for (std::size_t i = 0; i < list.size(); ++i) {
            out[size] = list[i];
            size += lists.octants[i] >> octant & 1;
        }
        ranges[octant].end = size;
    }
    return ranges;
}

FacetRange transfer(const octree::Cell& cell, const FacetRange& range, const FacetLists& from,
                    FacetLists& to) {
    const std::span<const std::uint32_t> list = from.list(cell.level, range);
    IndexBuffer& buffer = to.levels[static_cast<std::size_t>(cell.level)];
    buffer.ensure(list.size(), 0);
    std::copy(list.begin(), list.end(), buffer.data());
    return {0, range.size(), range.winding};
}

}  // namespace octavo::classic
