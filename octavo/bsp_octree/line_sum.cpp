// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp_octree/line_sum.hpp>

namespace octavo::bsp_octree {

using boolean::PointId;
using exact::Sign;

void LineSum::add(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
                  const exact::LineOrder& order, LineSums& sums) {
    sort_ends(edges, members, order);
    cover(edges, members);
    // Runs of intervals that agree become one segment.
    for (std::size_t i = 0, end; i < covers_.size(); i = end) {
        const std::size_t count = interval_end(i);
        end = count;
        while (end < covers_.size() && continues(i, count, end)) {
            for (std::size_t k = i; k < count; ++k)
                sums.passed.push_back({covers_[k].facing, ends_[covers_[end].interval]});
            end = interval_end(end);
        }
        const PointId from = ends_[covers_[i].interval], to = ends_[covers_[end - 1].interval + 1];
        for (std::size_t k = i; k < count; ++k) {
            const auto& [interval, facing, net] = covers_[k];
            for (std::int32_t n = net; n > 0; --n) sums.borders.push_back({facing, from, to});
            for (std::int32_t n = net; n < 0; ++n) sums.borders.push_back({facing, to, from});
            if (net == 0) sums.borders.insert(sums.borders.end(), {{facing, from, to}, {facing, to, from}});
        }
    }
}

void LineSum::sort_ends(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members,
                        const exact::LineOrder& order) {
    ends_.clear();
    for (const std::uint32_t member : members)
        ends_.push_back(edges[member].segment.from), ends_.push_back(edges[member].segment.to);
    std::sort(ends_.begin(), ends_.end());
    ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    by_id_ = ends_;
    std::sort(ends_.begin(), ends_.end(), [&](PointId a, PointId b) {
        return points_.compare_coordinate(order.axis, a, b) == Sign::negative;
    });
    // The place along the line of each end, by id.
    place_.resize(ends_.size());
    for (std::uint32_t i = 0; i < ends_.size(); ++i) place_[number_of(ends_[i])] = i;
}

/// Its place in the order of ids.
std::size_t LineSum::number_of(PointId id) const {
    return static_cast<std::size_t>(std::lower_bound(by_id_.begin(), by_id_.end(), id) - by_id_.begin());
}

void LineSum::cover(std::span<const BoundedSegment> edges, std::span<const std::uint32_t> members) {
    all_.clear(), covers_.clear();
    for (const std::uint32_t member : members) {
        const Segment& s = edges[member].segment;
        std::uint32_t from = place_[number_of(s.from)], to = place_[number_of(s.to)];
        const std::int32_t direction = from < to ? 1 : -1;
        if (from > to) std::swap(from, to);
        for (; from < to; ++from) all_.push_back({from, s.facing, direction});
    }
    std::sort(all_.begin(), all_.end(), [](const Cover& a, const Cover& b) {
        return a.interval != b.interval ? a.interval < b.interval : a.facing < b.facing;
    });
    for (std::size_t i = 0; i < all_.size();) {
        const std::uint32_t interval = all_[i].interval;
        const auto first = static_cast<std::ptrdiff_t>(covers_.size());
        while (i < all_.size() && all_[i].interval == interval) {
            Cover sum{interval, all_[i].facing, 0};
            for (; i < all_.size() && all_[i].interval == interval && all_[i].facing == sum.facing; ++i)
                sum.net += all_[i].net;
            covers_.push_back(sum);
        }
        // A face that goes straight on has no border, but two that do cross.
        const auto goes_on = [](const Cover& cover) { return cover.net == 0; };
        if (std::count_if(covers_.begin() + first, covers_.end(), goes_on) < 2)
            covers_.erase(std::remove_if(covers_.begin() + first, covers_.end(), goes_on), covers_.end());
    }
}

std::size_t LineSum::interval_end(std::size_t i) const {
    std::size_t end = i;
    while (end < covers_.size() && covers_[end].interval == covers_[i].interval) ++end;
    return end;
}

/// Whether the interval that starts at `next` is covered like that at `first` and follows the run before it.
bool LineSum::continues(std::size_t first, std::size_t first_end, std::size_t next) const {
    const std::size_t count = first_end - first;
    if (interval_end(next) - next != count || covers_[next].interval != covers_[next - 1].interval + 1)
        return false;
    if (is_kept_[ends_[covers_[next].interval]]) return false;
    for (std::size_t k = 0; k < count; ++k)
        if (covers_[first + k].facing != covers_[next + k].facing ||
            covers_[first + k].net != covers_[next + k].net)
            return false;
    return true;
}

}  // namespace octavo::bsp_octree
