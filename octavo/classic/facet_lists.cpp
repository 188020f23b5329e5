// SPDX-License-Identifier: Apache-2.0
#include <octavo/classic/facet_lists.hpp>

namespace octavo::classic {
namespace {

/// Adds up the crossings of one cell's facets with the steps between the octants' low corners.
class StepCrossings {
  public:
    explicit StepCrossings(const octree::Cell& cell) : half_(cell.side() / 2) {
        for (std::size_t i = 0; i < 8; ++i) {
            const exact::Point low = cell.child(static_cast<int>(i)).low;
            corner_[i] = {low.x, low.y, low.z};
        }
    }

    void add(const Facet& facet, unsigned steps) {
        for (; steps != 0; steps &= steps - 1) {
            const std::size_t i = static_cast<std::size_t>(std::countr_zero(steps));
            const OctantStep step = octant_steps[i];
            change_[i] += crossing(facet, corner_[step.from], step.axis, half_);
        }
    }

    std::array<std::int32_t, 8> windings(std::int32_t first) const {
        std::array<std::int32_t, 8> winding{};
        winding[0] = first;
        for (std::size_t i = 0; i < octant_steps.size(); ++i)
            winding[octant_steps[i].from + (std::size_t{1} << octant_steps[i].axis)] =
                winding[octant_steps[i].from] + change_[i];
        return winding;
    }

  private:
    std::int32_t half_;
    std::array<std::array<std::int32_t, 3>, 8> corner_;
    std::array<std::int32_t, 7> change_{};
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
    const std::span<const std::uint32_t> list = lists.list(cell.level, range);
    if (lists.octants.size() < list.size()) lists.octants.resize(list.size());
    if (lists.undecided.size() < list.size() + 4) lists.undecided.resize(list.size() + 4);
    const OctantFrame<touch> frame(cell);
    StepCrossings crossings(cell);
    OctantFacets found;
    std::size_t undecided = 0;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const Facet& facet = facets[list[i]];
        const Bounds bounds = frame.bounds(facet);
        lists.octants[i] = bounds.octants;
        lists.undecided[undecided] = i;
        undecided += !bounds.is_exact;
        found.touched |= bounds.is_exact ? bounds.octants : OctantSet{0};
        if (bounds.steps) crossings.add(facet, bounds.steps);
    }
    for (std::size_t i = 0; i < undecided; i += 4) {
        std::array<const Facet*, 4> four{};
        const std::size_t count = std::min<std::size_t>(4, undecided - i);
        for (std::size_t k = 0; k < count; ++k) four[k] = &facets[list[lists.undecided[i + k]]];
        const std::array<OctantSet, 4> touched = touched_octants(four, cell, touch);
        for (std::size_t k = 0; k < count; ++k) {
            OctantSet& octants = lists.octants[lists.undecided[i + k]];
            octants &= touched[k];
            found.touched |= octants;
        }
    }
    found.winding = crossings.windings(range.winding);
    return found;
}

template <Touch touch>
OctantFacets find_touched(std::span<const Facet> facets, const octree::Cell& cell, const FacetRange& range,
                          FacetLists& lists) {
    const std::span<const std::uint32_t> list = lists.list(cell.level, range);
    if (lists.octants.size() < list.size()) lists.octants.resize(list.size());
    if (lists.undecided.size() < list.size() + 4) lists.undecided.resize(list.size() + 4);
    const OctantFrame<touch> frame(cell);
    StepCrossings crossings(cell);
    OctantFacets found;
    std::size_t undecided = 0;
    for (std::uint32_t i = 0; i < list.size(); ++i) {
        const Facet& facet = facets[list[i]];
        const Bounds bounds = frame.bounds(facet);
        lists.octants[i] = bounds.octants;
        lists.undecided[undecided] = i;
        undecided += !bounds.is_exact;
        found.touched |= bounds.is_exact ? bounds.octants : OctantSet{0};
        if (bounds.steps) crossings.add(facet, bounds.steps);
    }
    // Only facets whose bounds touch an octant that nobody touches yet can add anything.
    for (std::size_t i = 0; i < undecided;) {
        std::array<const Facet*, 4> four{};
        std::array<OctantSet, 4> octants{};
        std::size_t count = 0;
        for (; i < undecided && count < 4; ++i) {
            const OctantSet candidates = lists.octants[lists.undecided[i]];
            if ((candidates & ~found.touched) == 0) continue;
            octants[count] = candidates;
            four[count++] = &facets[list[lists.undecided[i]]];
        }
        if (count == 0) break;
        const std::array<OctantSet, 4> touched = touched_octants(four, cell, touch);
        for (std::size_t k = 0; k < count; ++k) found.touched |= octants[k] & touched[k];
    }
    found.winding = crossings.windings(range.winding);
    return found;
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
