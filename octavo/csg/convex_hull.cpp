// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <octavo/csg/convex_hull.hpp>

namespace octavo::csg {
namespace {

using Wide = __int128;
using Spot = std::array<std::int64_t, 3>;

struct Facet {
    std::array<std::uint32_t, 3> corner;
    std::array<std::uint32_t, 3> neighbour;  // across the edge from corner i to corner i + 1
    Spot normal;                             // 54 bits
    Wide offset;
    std::vector<std::uint32_t> outside;  // points that see the facet and are kept here
    bool alive = true;
    std::uint32_t mark = 0;
};

class Hull {
  public:
    explicit Hull(const std::vector<Vec3>& points) : points_(points) {}

    std::optional<mesh::Mesh> run() {
        round();
        if (!first_simplex()) return {};
        for (std::size_t at = 0; at < facets_.size(); ++at)
            if (facets_[at].alive && !facets_[at].outside.empty()) add(static_cast<std::uint32_t>(at));
        return result();
    }

  private:
    void round() {
        Box3 box;
        for (const Vec3& p : points_) box.add(p);
        // In halves, which no difference of doubles overflows; and a power of two so large may be no double.
        double largest = 0;
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(largest, 0.5 * box.high[axis] - 0.5 * box.low[axis]);
        const int exponent = largest > 0 ? 25 - std::ilogb(largest) : 0;
        spots_.reserve(points_.size());
        for (const Vec3& p : points_) {
            Spot spot;
            for (int axis = 0; axis < 3; ++axis)
                spot[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(
                    std::nearbyint(std::ldexp(0.5 * p[axis] - 0.5 * box.low[axis], exponent)));
            spots_.push_back(spot);
        }
    }

    static Spot minus(const Spot& a, const Spot& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
    static Spot cross(const Spot& a, const Spot& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }
    static Wide dot(const Spot& a, const Spot& b) {
        return Wide{a[0]} * b[0] + Wide{a[1]} * b[1] + Wide{a[2]} * b[2];
    }

    Wide height(const Facet& facet, std::uint32_t point) const {
        return dot(facet.normal, spots_[point]) - facet.offset;
    }

    Facet make_facet(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        Facet facet{};
        facet.corner = {a, b, c};
        facet.normal = cross(minus(spots_[b], spots_[a]), minus(spots_[c], spots_[a]));
        facet.offset = dot(facet.normal, spots_[a]);
        return facet;
    }

    bool first_simplex() {
        const auto count = static_cast<std::uint32_t>(spots_.size());
        if (count < 4) return false;
        std::array<std::uint32_t, 4> s{};
        for (std::uint32_t i = 1; i < count; ++i)
            if (spots_[i] < spots_[s[0]]) s[0] = i;
        const auto farthest = [&](const auto& measure) {
            std::uint32_t best = count;
            Wide most = 0;
            for (std::uint32_t i = 0; i < count; ++i)
                if (const Wide value = measure(i); value > most) most = value, best = i;
            return best;
        };
        s[1] = farthest([&](std::uint32_t i) {
            const Spot d = minus(spots_[i], spots_[s[0]]);
            return dot(d, d);
        });
        if (s[1] == count) return false;
        s[2] = farthest([&](std::uint32_t i) {
            // 54-bit components, compared by their sum of absolute values: any point off the line will do.
            const Spot n = cross(minus(spots_[s[1]], spots_[s[0]]), minus(spots_[i], spots_[s[0]]));
            return Wide{std::abs(n[0])} + std::abs(n[1]) + std::abs(n[2]);
        });
        if (s[2] == count) return false;
        const Facet base = make_facet(s[0], s[1], s[2]);
        s[3] = farthest([&](std::uint32_t i) {
            const Wide h = height(base, i);
            return h < 0 ? -h : h;
        });
        if (s[3] == count) return false;
        if (height(base, s[3]) > 0) std::swap(s[1], s[2]);
        const std::array<std::array<std::size_t, 3>, 4> sides{{{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}};
        for (const auto& side : sides) facets_.push_back(make_facet(s[side[0]], s[side[1]], s[side[2]]));
        facets_[0].neighbour = {1, 2, 3};
        facets_[1].neighbour = {3, 2, 0};
        facets_[2].neighbour = {1, 3, 0};
        facets_[3].neighbour = {2, 1, 0};
        std::vector<std::uint32_t> all(count);
        for (std::uint32_t i = 0; i < count; ++i) all[i] = i;
        distribute(all, 0);
        return true;
    }

    /// Gives each point to the first facet from `begin` on that it sees.
    void distribute(const std::vector<std::uint32_t>& points, std::size_t begin) {
        for (const std::uint32_t point : points)
            for (std::size_t f = begin; f < facets_.size(); ++f)
                if (height(facets_[f], point) > 0) {
                    facets_[f].outside.push_back(point);
                    break;
                }
    }

    void add(std::uint32_t start) {
        const std::vector<std::uint32_t>& candidates = facets_[start].outside;
        const std::uint32_t apex =
            *std::max_element(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
                return height(facets_[start], a) < height(facets_[start], b);
            });
        // The facets that the apex sees, and the edges around them.
        ++mark_;
        std::vector<std::uint32_t> seen{start};
        facets_[start].mark = mark_;
        struct Edge {
            std::uint32_t from, to, beyond;
        };
        std::vector<Edge> horizon;
        for (std::size_t i = 0; i < seen.size(); ++i)
            for (std::size_t e = 0; e < 3; ++e) {
                const Facet& facet = facets_[seen[i]];
                const std::uint32_t beyond = facet.neighbour[e];
                if (facets_[beyond].mark == mark_) continue;
                if (height(facets_[beyond], apex) > 0) {
                    facets_[beyond].mark = mark_;
                    seen.push_back(beyond);
                } else {
                    horizon.push_back({facet.corner[e], facet.corner[(e + 1) % 3], beyond});
                }
            }
        const std::size_t first = facets_.size();
        std::map<std::uint32_t, std::uint32_t> from;  // new facet by its horizon edge's start
        for (const Edge& edge : horizon) {
            const auto index = static_cast<std::uint32_t>(facets_.size());
            Facet facet = make_facet(edge.from, edge.to, apex);
            facet.neighbour[0] = edge.beyond;
            Facet& beyond = facets_[edge.beyond];
            for (std::size_t e = 0; e < 3; ++e)
                if (beyond.corner[e] == edge.to && beyond.corner[(e + 1) % 3] == edge.from)
                    beyond.neighbour[e] = index;
            facets_.push_back(std::move(facet));
            from[edge.from] = index;
        }
        for (std::size_t f = first; f < facets_.size(); ++f) {
            const std::uint32_t next = from.at(facets_[f].corner[1]);
            facets_[f].neighbour[1] = next;
            facets_[next].neighbour[2] = static_cast<std::uint32_t>(f);
        }
        for (const std::uint32_t f : seen) {
            facets_[f].alive = false;
            const std::vector<std::uint32_t> orphans = std::move(facets_[f].outside);
            facets_[f].outside.clear();
            distribute(orphans, first);
        }
    }

    mesh::Mesh result() const {
        mesh::Mesh mesh;
        std::map<std::uint32_t, mesh::VertexIndex> index;
        for (const Facet& facet : facets_) {
            if (!facet.alive) continue;
            mesh::Triangle triangle{};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [place, fresh] =
                    index.try_emplace(facet.corner[i], static_cast<mesh::VertexIndex>(mesh.vertices.size()));
                if (fresh) mesh.vertices.push_back(points_[facet.corner[i]]);
                triangle[i] = place->second;
            }
            mesh.triangles.push_back(triangle);
        }
        return mesh;
    }

    const std::vector<Vec3>& points_;
    std::vector<Spot> spots_;
    std::vector<Facet> facets_;
    std::uint32_t mark_ = 0;
};

}  // namespace

std::optional<mesh::Mesh> convex_hull(const std::vector<Vec3>& points) { return Hull(points).run(); }

}  // namespace octavo::csg
