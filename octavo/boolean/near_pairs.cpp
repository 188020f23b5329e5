// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <atomic>

#include <octavo/base/parallel_sort.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/near_pairs.hpp>

namespace octavo::boolean {
namespace {

using Pair = NearPairs::Pair;

/// How far the segment from `from` to `to` stays away from `point`.
double distance(Vec3 point, Vec3 from, Vec3 to) {
    const Vec3 edge = to - from, offset = point - from;
    const double square = dot(edge, edge);
    const double along = square > 0 ? std::clamp(dot(offset, edge) / square, 0.0, 1.0) : 0.0;
    return length(offset - along * edge);
}

/// Collects pairs of facets.
class PairSearch {
  public:
    PairSearch(const Surface& surface, const Soup& soup, const RoundedPoints& rounded, const Context& context)
        : surface_(surface), soup_(soup), rounded_(rounded), context_(context), merged_(surface.merged) {
        const double units = 4 * placing_bound(soup.lattice, rounded.numbers()) * exact::universe_side;
        tight_distance_ = units / contact_reach(soup.lattice, rounded.numbers()) + 1;
        find_moved();
    }

    NearPairs run(std::span<const Pair> near) {
        if (!any_moved_) return {};
        chain();
        parallel_sort(context_, merged_);
        if (context_.cancelled()) return {};
        collect(near.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
            for (std::size_t i = begin; i < end; ++i) add(near[i].first, near[i].second, pairs);
        });
        collect(moved_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
            for (auto facet = static_cast<std::uint32_t>(begin); facet < end; ++facet)
                if (moved_[facet] && next_[first_of_[facet]] != no_index) pairs.push_back({facet, facet});
        });
        // A facet may have pieces in polygons of different names.
        collect(merged_.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
            for (std::size_t i = begin; i < end; ++i) add(merged_[i].first, merged_[i].first, pairs);
        });
        gather();
        collect(begin_.size() - 1, corner_grain,
                [&](std::size_t begin, std::size_t end, std::vector<Pair>& pairs) {
                    std::vector<End> ends;
                    for (std::size_t i = begin; i < end; ++i)
                        about_corner({incident_.data() + begin_[i], begin_[i + 1] - begin_[i]}, ends, pairs);
                });
        parallel_sort(context_, pairs_);
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
        return {std::move(pairs_), std::move(first_of_), std::move(next_)};
    }

  private:
    static constexpr std::size_t grain = 1 << 12, corner_grain = 1 << 8;

    /// A facet of the soup at a corner; its triangles may go by the names of several facets.
    struct Incident {
        std::uint32_t facet;
        std::uint32_t corner : 2;
        std::uint32_t moved : 1;
    };
    /// Of an edge from a corner, with the position among the facets there.
    using End = std::pair<std::uint32_t, std::uint32_t>;

    /// Appends what `search(begin, end, pairs)` finds in the chunks of [0, count).
    template <class Search>
    void collect(std::size_t count, std::size_t chunk, const Search& search) {
        std::vector<std::vector<Pair>> found((count + chunk - 1) / chunk);
        parallel_chunks(context_, count, chunk, [&](std::size_t begin, std::size_t end) {
            search(begin, end, found[begin / chunk]);
        });
        std::vector<std::size_t> place;
        std::size_t size = pairs_.size();
        for (const std::vector<Pair>& part : found) place.push_back(std::exchange(size, size + part.size()));
        pairs_.resize(size);
        parallel_chunks(context_, found.size(), 16, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                std::copy(found[i].begin(), found[i].end(), pairs_.data() + place[i]);
                found[i] = {};
            }
        });
    }

    void find_moved() {
        moved_.assign(soup_.facets.size(), 0);
        const std::size_t first = rounded_.moves_vertices() ? 0 : surface_.first_piece();
        parallel_chunks(context_, surface_.triangles.size() - first, grain,
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = first + begin; i < first + end; ++i) note_moved(i);
                        });
    }
    /// Threads may note the same.
    void note_moved(std::size_t triangle) {
        for (const PointId corner : surface_.triangles[triangle])
            if (rounded_.is_moved(corner)) {
                mark(moved_[surface_.facets[triangle].soup_facet]);
                any_moved_.store(true, std::memory_order_relaxed);
            }
    }
    static void mark(char& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }

    /// The triangles of each facet, linked.
    void chain() {
        first_of_.resize(soup_.facets.size());
        next_.resize(surface_.triangles.size());
        parallel_chunks(context_, first_of_.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::fill(first_of_.data() + begin, first_of_.data() + end, no_index);
        });
        const std::size_t whole = surface_.first_piece();
        parallel_chunks(context_, whole, grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                first_of_[surface_.facets[i].soup_facet] = static_cast<std::uint32_t>(i);
                next_[i] = no_index;
            }
        });
        if (context_.cancelled()) return;
        for (auto i = static_cast<std::uint32_t>(surface_.triangles.size()); i-- > whole;) {
            const std::uint32_t facet = surface_.facets[i].soup_facet;
            next_[i] = first_of_[facet];
            first_of_[facet] = i;
        }
    }

    /// Calls `visit(facet)` for the names under which the triangles of a facet are found.
    template <class Visit>
    void for_each_name(std::uint32_t facet, const Visit& visit) const {
        if (first_of_[facet] != no_index) visit(facet);
        for (auto at = std::lower_bound(merged_.begin(), merged_.end(), Pair{facet, 0});
             at != merged_.end() && at->first == facet; ++at)
            if (at->second != facet) visit(at->second);
    }

    void add(std::uint32_t first, std::uint32_t second, std::vector<Pair>& pairs) const {
        for_each_name(first, [&](std::uint32_t a) {
            for_each_name(second, [&](std::uint32_t b) {
                if (a != b && (moved_[a] || moved_[b])) pairs.push_back(std::minmax(a, b));
            });
        });
    }

    /// The facets about each corner of a facet with moved points.
    void gather() {
        std::vector<char> has_moved = moved_, has_parts(soup_.facets.size(), 0);
        for (const auto& [facet, name] : merged_) {
            has_parts[facet] = 1;
            has_moved[facet] = static_cast<char>(has_moved[facet] | moved_[name]);
        }
        const UninitialisedVector<std::uint32_t> number = number_corners(has_moved);
        struct Found {
            std::uint32_t corner;
            Incident incident;
        };
        // Corners are dealt out in ranges, each of which one task sorts its facets into.
        using Dealt = std::array<std::vector<Found>, ranges>;
        const std::size_t range = begin_.size() / ranges + 1;
        std::vector<Dealt> found(soup_.facets.size() / grain + 1);
        parallel_chunks(context_, soup_.facets.size(), grain, [&](std::size_t begin, std::size_t end) {
            Dealt& dealt = found[begin / grain];
            for (std::size_t i = begin; i < end; ++i) {
                if (first_of_[i] == no_index && !has_parts[i]) continue;
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const std::uint32_t corner = number[soup_.facets[i][k]];
                    if (corner == no_index) continue;
                    const auto facet = static_cast<std::uint32_t>(i);
                    dealt[corner / range].push_back({corner, {facet, k, has_moved[i] != 0}});
                }
            }
        });
        const auto for_each_found = [&](const auto& visit) {
            parallel_chunks(context_, ranges, 1, [&](std::size_t part, std::size_t) {
                for (const Dealt& dealt : found)
                    for (const Found& each : dealt[part]) visit(each);
            });
        };
        for_each_found([&](const Found& each) { ++begin_[each.corner]; });
        std::uint32_t sum = 0;
        for (std::uint32_t& count : begin_) sum += count, count = sum;
        incident_.resize(sum);
        for_each_found([&](const Found& each) { incident_[--begin_[each.corner]] = each.incident; });
    }
    static constexpr std::size_t ranges = 16;

    /// Numbers the corners of facets with moved points; makes room for a count of each and one more.
    UninitialisedVector<std::uint32_t> number_corners(const std::vector<char>& has_moved) {
        std::vector<char> is_corner(soup_.points.size(), 0);
        parallel_chunks(context_, soup_.facets.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t facet = begin; facet < end; ++facet)
                if (has_moved[facet])
                    for (const std::uint32_t corner : soup_.facets[facet]) mark(is_corner[corner]);
        });
        const std::vector<std::size_t> offset =
            chunk_offsets(context_, is_corner.size(), grain, [&](std::size_t begin, std::size_t end) {
                return static_cast<std::size_t>(
                    std::count(is_corner.data() + begin, is_corner.data() + end, 1));
            });
        UninitialisedVector<std::uint32_t> number(is_corner.size());
        parallel_chunks(context_, is_corner.size(), grain, [&](std::size_t begin, std::size_t end) {
            auto next = static_cast<std::uint32_t>(offset[begin / grain]);
            for (std::size_t i = begin; i < end; ++i) number[i] = is_corner[i] ? next++ : no_index;
        });
        begin_.assign(offset.back() + 1, 0);
        return number;
    }

    void about_corner(std::span<const Incident> facets, std::vector<End>& ends,
                      std::vector<Pair>& pairs) const {
        ends.clear();
        for (std::uint32_t i = 0; i < facets.size(); ++i)
            for (std::uint32_t k = 1; k < 3; ++k)
                ends.push_back({soup_.facets[facets[i].facet][(facets[i].corner + k) % 3], i});
        std::sort(ends.begin(), ends.end());
        const auto add_two = [&](std::uint32_t i, std::uint32_t k) {
            if (facets[i].moved || facets[k].moved) add(facets[i].facet, facets[k].facet, pairs);
        };
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (std::size_t k = i + 1; k < ends.size() && ends[k].first == ends[i].first; ++k)
                add_two(ends[i].second, ends[k].second);
        for (std::uint32_t i = 0; i < facets.size(); ++i)
            if (is_tight(facets[i]))
                for (std::uint32_t k = 0; k < facets.size(); ++k)
                    if (k != i) add_two(i, k);
    }

    /// Whether an edge of the facet's triangles that does not end in the corner comes near it. Large polygons are
    /// said to be, unseen.
    bool is_tight(const Incident& incident) const {
        constexpr int most = 64;
        const PointId corner = soup_.facets[incident.facet][incident.corner];
        const Vec3 at = lattice_place(rounded_, corner);
        int seen = 0;
        bool tight = false;
        for_each_name(incident.facet, [&](std::uint32_t name) {
            for (std::uint32_t i = first_of_[name]; i != no_index && !tight; i = next_[i]) {
                const mesh::Triangle& t = surface_.triangles[i];
                for (std::size_t k = 0; k < 3 && !tight; ++k) {
                    const PointId from = t[k], to = t[(k + 1) % 3];
                    if (from == corner || to == corner) continue;
                    tight = distance(at, lattice_place(rounded_, from), lattice_place(rounded_, to)) <
                            tight_distance_;
                }
                tight = tight || ++seen > most;
            }
        });
        return tight;
    }

    const Surface& surface_;
    const Soup& soup_;
    const RoundedPoints& rounded_;
    const Context& context_;
    std::vector<Pair> merged_;
    double tight_distance_ = 0;
    std::atomic<bool> any_moved_ = false;
    UninitialisedVector<std::uint32_t> first_of_,
        next_;                          ///< triangle of a facet, and the next one after a triangle
    std::vector<char> moved_;           ///< per facet: its triangles have moved corners
    std::vector<std::uint32_t> begin_;  ///< into `incident_`, per corner
    UninitialisedVector<Incident> incident_;
    UninitialisedVector<Pair> pairs_;
};

}  // namespace

NearPairs find_near_pairs(const Surface& surface, const Soup& soup, std::span<const Pair> near,
                          const RoundedPoints& rounded, const Context& context) {
    return PairSearch(surface, soup, rounded, context).run(near);
}

}  // namespace octavo::boolean
