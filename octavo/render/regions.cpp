// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/render/outline.hpp>
#include <octavo/render/regions.hpp>

namespace octavo::render {
namespace {

using Color8 = std::uint32_t;

Color8 color8_of(Color color) {
    const auto byte = [](float channel) {
        return static_cast<Color8>(std::lround(std::clamp(channel, 0.0F, 1.0F) * 255));
    };
    return byte(color.red) << 16 | byte(color.green) << 8 | byte(color.blue);
}

Color color_of(Color8 color) {
    const auto channel = [&](int shift) { return static_cast<float>(color >> shift & 255) / 255; };
    return {channel(16), channel(8), channel(0)};
}

/// A directed edge of a piece.
struct Edge {
    DrawingPoint from, to;
    std::uint32_t piece = 0;

    bool runs_up() const { return from < to; }
    std::pair<DrawingPoint, DrawingPoint> ends() const {
        return runs_up() ? std::pair(from, to) : std::pair(to, from);
    }
};

/// Removes edges that run both ways, and unites the pieces on their sides.
void cancel(std::vector<Edge>& edges, mesh::DisjointSets& connected) {
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tuple(a.ends(), a.runs_up(), a.piece) < std::tuple(b.ends(), b.runs_up(), b.piece);
    });
    std::size_t kept = 0;
    for (std::size_t begin = 0, end; begin < edges.size(); begin = end) {
        for (end = begin; end < edges.size() && edges[end].ends() == edges[begin].ends();) ++end;
        std::size_t middle = begin;  // edges that run down come first
        while (middle < end && !edges[middle].runs_up()) ++middle;
        const std::size_t down = middle - begin, up = end - middle, both = std::min(down, up);
        if (both > 0)
            for (std::size_t i = begin + 1; i < end; ++i) connected.unite(edges[begin].piece, edges[i].piece);
        for (std::size_t i = begin + both; i < middle; ++i) edges[kept++] = edges[i];
        for (std::size_t i = middle + both; i < end; ++i) edges[kept++] = edges[i];
    }
    edges.resize(kept);
}

/// Finds the ends of edges near an edge.
class CornerIndex {
  public:
    explicit CornerIndex(std::span<const Edge> edges) {
        for (const Edge& edge : edges) corners_.push_back({cell_of(edge.from), edge.from});
        std::sort(corners_.begin(), corners_.end());
        corners_.erase(std::unique(corners_.begin(), corners_.end()), corners_.end());
    }

    /// Calls `visit(corner)` for the corners in the cells that an edge's bounds touch.
    template <class Visit>
    void for_each_near(const Edge& edge, const Visit& visit) const {
        const auto [left, right] = std::minmax(edge.from.x, edge.to.x);
        const auto [top, bottom] = std::minmax(edge.from.y, edge.to.y);
        const DrawingPoint low = cell_of({left - 2, top - 2}), high = cell_of({right + 2, bottom + 2});
        for (std::int32_t x = low.x; x <= high.x; ++x)
            for (auto at = std::lower_bound(corners_.begin(), corners_.end(),
                                            std::pair(DrawingPoint{x, low.y}, lowest));
                 at != corners_.end() && at->first.x == x && at->first.y <= high.y; ++at)
                visit(at->second);
    }

  private:
    static constexpr std::int32_t cell_size = 4 * steps_of_pixel;
    static constexpr DrawingPoint lowest{INT32_MIN, INT32_MIN};
    static DrawingPoint cell_of(DrawingPoint p) {
        const auto index = [](std::int32_t v) { return v >= 0 ? v / cell_size : -1 - (-1 - v) / cell_size; };
        return {index(p.x), index(p.y)};
    }
    std::vector<std::pair<DrawingPoint, DrawingPoint>> corners_;  ///< with their cells
};

/// Cuts edges at the ends of others that lie on them.
std::vector<Edge> cut_at_corners(std::span<const Edge> edges) {
    constexpr double tolerance = 1.5;  // steps; ends of edges were rounded by up to 0.7
    const CornerIndex index(edges);
    std::vector<Edge> parts;
    std::vector<std::pair<double, DrawingPoint>> stops;
    for (const Edge& edge : edges) {
        const double dx = edge.to.x - edge.from.x, dy = edge.to.y - edge.from.y, size = std::hypot(dx, dy);
        stops.clear();
        index.for_each_near(edge, [&](DrawingPoint corner) {
            const double cx = corner.x - edge.from.x, cy = corner.y - edge.from.y;
            const double along = (cx * dx + cy * dy) / size;
            if (along > 0 && along < size && std::fabs(dx * cy - dy * cx) <= tolerance * size &&
                corner != edge.from && corner != edge.to)
                stops.push_back({along, corner});
        });
        std::sort(stops.begin(), stops.end());
        DrawingPoint at = edge.from;
        for (const auto& [along, corner] : stops) {
            parts.push_back({at, corner, edge.piece});
            at = corner;
        }
        parts.push_back({at, edge.to, edge.piece});
    }
    return parts;
}

/// Chains edges to loops, which become regions by what is connected. `edges` bound areas of one colour.
void add_regions(std::vector<Edge>& edges, mesh::DisjointSets& connected, Color color,
                 std::vector<Region>& regions) {
    for (Edge& edge : edges) edge.piece = connected.find(edge.piece);
    const auto key = [](const Edge& edge) { return std::tuple(edge.piece, edge.from, edge.to); };
    std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
    std::vector<char> used(edges.size());
    std::uint32_t piece = ~std::uint32_t{0};
    bool begun = false;
    for (std::size_t first = 0; first < edges.size(); ++first) {
        if (used[first]) continue;
        if (edges[first].piece != piece) piece = edges[first].piece, begun = false;
        Polyline loop;
        for (std::size_t at = first;;) {
            used[at] = 1;
            loop.push_back(edges[at].from);
            const std::pair next(piece, edges[at].to);
            auto out =
                std::lower_bound(edges.begin(), edges.end(), next, [](const Edge& edge, const auto& wanted) {
                    return std::pair(edge.piece, edge.from) < wanted;
                });
            const auto is_next = [&] {
                return out != edges.end() && std::pair(out->piece, out->from) == next;
            };
            while (is_next() && used[static_cast<std::size_t>(out - edges.begin())]) ++out;
            if (!is_next()) break;
            at = static_cast<std::size_t>(out - edges.begin());
        }
        loop = without_needless_points(loop);
        if (!has_area(loop)) continue;
        if (!begun) regions.push_back({color, {}}), begun = true;
        regions.back().loops.push_back(std::move(loop));
    }
}

DrawingPoint rounded(Point2 p) {
    return {static_cast<std::int32_t>(std::lround(p.x * steps_of_pixel)),
            static_cast<std::int32_t>(std::lround(p.y * steps_of_pixel))};
}

}  // namespace

std::vector<Region> regions_of(const Visible& visible, std::span<const Patch> patches) {
    std::vector<std::pair<Color8, std::uint32_t>> pieces;
    for (std::uint32_t i = 0; i < visible.pieces.size(); ++i)
        pieces.emplace_back(color8_of(patches[visible.pieces[i].patch].color), i);
    std::sort(pieces.begin(), pieces.end());
    std::vector<Region> regions;
    std::vector<Edge> edges;
    for (std::size_t begin = 0, end; begin < pieces.size(); begin = end) {
        edges.clear();
        for (end = begin; end < pieces.size() && pieces[end].first == pieces[begin].first; ++end) {
            const std::span<const Point2> ring = visible.corners_of(visible.pieces[pieces[end].second]);
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const DrawingPoint from = rounded(ring[i]),
                                   to = rounded(ring[i + 1 == ring.size() ? 0 : i + 1]);
                if (from != to) edges.push_back({from, to, static_cast<std::uint32_t>(end - begin)});
            }
        }
        mesh::DisjointSets connected(end - begin);
        cancel(edges, connected);
        edges = cut_at_corners(edges);
        cancel(edges, connected);
        add_regions(edges, connected, color_of(pieces[begin].first), regions);
    }
    return regions;
}

}  // namespace octavo::render
