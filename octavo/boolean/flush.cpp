// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <octavo/boolean/bending.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/flush.hpp>
#include <octavo/boolean/near_contacts.hpp>
#include <octavo/boolean/t_junctions.hpp>

namespace octavo::boolean {
namespace {

/// Per vertex, whether a facet that is left alone has it.
std::vector<char> vertices_left_alone(const Soup& soup, const LeftAlone& left_alone) {
    std::vector<char> stays(soup.points.size(), 0);
    for (std::size_t facet = 0; facet < soup.facets.size() && !left_alone.empty(); ++facet)
        if (left_alone[soup.origin[facet]])
            for (const std::uint32_t corner : soup.facets[facet]) stays[corner] = 1;
    return stays;
}

/// Vertices become the first one near them, so that those that are left are farther apart than the tolerance. Whether
/// any did.
bool merge_vertices(Soup& soup, const NearContacts& near, const LeftAlone& left_alone, FlushReport& report,
                    const Context& context) {
    const std::vector<char> stays = vertices_left_alone(soup, left_alone);
    const std::size_t before = report.merged_vertices;
    std::vector<std::uint32_t> merged(soup.points.size(), no_index);
    for (const auto& [vertex, other] : near.at_vertex) {
        if (stays[vertex] || stays[other]) continue;
        if (merged[vertex] == no_index) merged[vertex] = vertex;
        if (merged[vertex] != vertex || merged[other] != no_index) continue;
        merged[other] = vertex;
        ++report.merged_vertices;
        report.largest_move =
            std::max(report.largest_move, distance(soup.points[vertex], soup.points[other]));
    }
    if (report.merged_vertices == before) return false;
    for (mesh::Triangle& facet : soup.facets)
        for (std::uint32_t& corner : facet)
            if (merged[corner] != no_index) corner = merged[corner];
    replace_facets({}, soup, report, context);
    return true;
}

NearContacts search(const Soup& soup, double tolerance, const Context& context) {
    return find_near_contacts(soup, FacetTree(soup, context, tolerance), tolerance, context);
}

/// Makes surfaces close edge by edge, which moves nothing. What is near then.
NearContacts split_t_junctions(NearContacts near, Soup& soup, double tolerance, const Context& context) {
    const NearContacts junctions = find_t_junctions(soup, near);
    if (junctions.on_edge.empty()) return near;
    FlushReport not_told;
    bend(soup, junctions, tolerance, {}, not_told, context);
    return context.cancelled() ? near : search(soup, tolerance, context);
}

/// Joins what is near, round by round; again from the start without what has not come to rest.
class Joining {
  public:
    Joining(Soup& soup, double tolerance) : soup_(soup), tolerance_(tolerance) {}

    FlushReport run(const Context& context) {
        constexpr int most_attempts = 4;
        FlushReport report = rounds(context);
        for (int attempt = 1; !report.settled && !context.cancelled(); ++attempt) {
            soup_ = *before_;
            if (attempt == most_attempts) {
                report = new_report();
                break;
            }
            report = rounds(context);
        }
        report.left_alone =
            static_cast<std::size_t>(std::count(left_alone_.begin(), left_alone_.end(), char{1}));
        return report;
    }

  private:
    FlushReport new_report() const {
        FlushReport report;
        report.tolerance = tolerance_ * soup_.lattice.unit();
        report.settled = false;
        return report;
    }

    FlushReport rounds(const Context& context) {
        constexpr std::size_t most_rounds = 8;
        FlushReport report = new_report();
        std::size_t least = no_index;
        while (!context.cancelled()) {
            const NearContacts near = report.rounds == 0 ? find_first(context) : find_near(context);
            if (context.cancelled()) break;
            const std::size_t inexact = near.inexact();
            least = std::min(least, inexact);
            report.settled = inexact == 0;
            if (report.settled) break;
            // Where joining makes more of it than there was, it does so again and again.
            if (report.rounds == most_rounds || inexact > 2 * least + 8) {
                leave_alone(near);
                break;
            }
            report.folded_facets = 0;  // only the last round's are left
            report.settled = !join(near, report, context);
            if (report.settled) break;
            ++report.rounds;
        }
        report.largest_move *= soup_.lattice.unit();
        return report;
    }

    NearContacts find_near(const Context& context) {
        NearContacts near = search(soup_, tolerance_, context);
        if (near.inexact() == 0 || context.cancelled()) return near;
        return split_t_junctions(std::move(near), soup_, tolerance_, context);
    }

    const NearContacts& find_first(const Context& context) {
        if (!first_) {
            first_ = find_near(context);
            if (first_->inexact() > 0) before_ = soup_;
        }
        return *first_;
    }

    /// Whether there was anything to be joined.
    bool join(const NearContacts& near, FlushReport& report, const Context& context) {
        return merge_vertices(soup_, near, left_alone_, report, context) ||
               bend(soup_, near, tolerance_, left_alone_, report, context);
    }

    /// What is still near without touching is left alone from now on.
    void leave_alone(const NearContacts& near) {
        std::vector<char> is_near(soup_.points.size(), 0);
        for (const auto& [vertex, other] : near.at_vertex) is_near[vertex] = is_near[other] = 1;
        const std::vector<std::uint32_t> active = facets_to_bend(soup_, near, tolerance_, left_alone_);
        if (left_alone_.empty()) left_alone_.assign(soup_.first_triangle.back(), 0);
        for (const std::uint32_t facet : active) left_alone_[soup_.origin[facet]] = 1;
        for (std::size_t facet = 0; facet < soup_.facets.size(); ++facet)
            for (const std::uint32_t corner : soup_.facets[facet])
                if (is_near[corner]) left_alone_[soup_.origin[facet]] = 1;
    }

    Soup& soup_;
    double tolerance_;
    std::optional<NearContacts> first_;
    std::optional<Soup> before_;  ///< anything moved
    LeftAlone left_alone_;
};

}  // namespace

FlushReport make_flush(Soup& soup, double tolerance, const Context& context) {
    return Joining(soup, tolerance).run(context);
}

}  // namespace octavo::boolean
