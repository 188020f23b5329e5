// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/ring.hpp>
#include <octavo/boolean/stars.hpp>

namespace octavo::boolean {
namespace {

/// Judges the polygon opposite to a vertex.
class SpreadTest {
  public:
    SpreadTest(const Soup& soup, double reach) : soup_(soup), reach_(std::max(reach, least_reach)) {}

    bool is_spread(std::uint32_t vertex, std::span<const std::uint32_t> ring) {
        load(vertex, ring);
        const int axis = find_axis(ring.size());
        return lies_beside(axis, ring.size());
    }

  private:
    /// So that rounding cannot matter: doubled areas are off by less than 2^-50 E², which is a little of what they must
    /// be.
    static constexpr double least_reach = 0x1p-6;

    void load(std::uint32_t vertex, std::span<const std::uint32_t> ring) {
        const exact::Point centre = soup_.points[vertex];
        if (at_[0].size() <= ring.size())
            for (std::vector<double>& coordinates : at_) coordinates.resize(2 * ring.size());
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const exact::Point point = soup_.points[ring[i]];
            at_[0][i] = point.x - centre.x, at_[1][i] = point.y - centre.y, at_[2][i] = point.z - centre.z;
        }
        for (std::vector<double>& coordinates : at_) coordinates[ring.size()] = coordinates[0];
    }

    int find_axis(std::size_t count) {
        const double *const x = at_[0].data(), *const y = at_[1].data(), *const z = at_[2].data();
        double sum[3] = {0, 0, 0};
        for (std::size_t i = 0; i < count; ++i) {
            sum[0] += y[i] * z[i + 1] - z[i] * y[i + 1];
            sum[1] += z[i] * x[i + 1] - x[i] * z[i + 1];
            sum[2] += x[i] * y[i + 1] - y[i] * x[i + 1];
        }
        int axis = 0;
        for (int other = 1; other < 3; ++other)
            if (std::fabs(sum[other]) > std::fabs(sum[axis])) axis = other;
        up_ = sum[axis] > 0 ? 1 : -1;
        return axis;
    }

    bool lies_beside(int axis, std::size_t count) const {
        const double* const u = at_[(axis + 1) % 3].data();
        const double* const v = at_[(axis + 2) % 3].data();
        double least_area = 0x1p60, shortest = 0x1p60, longest = 0;
        int crossings = 0;  // of the ray along u, by the sides that turn about the vertex as they must
        for (std::size_t i = 0; i < count; ++i) {
            const double length = u[i] * u[i] + v[i] * v[i];
            shortest = std::min(shortest, length), longest = std::max(longest, length);
            least_area = std::min(least_area, up_ * (u[i] * v[i + 1] - v[i] * u[i + 1]));
            crossings += (up_ * v[i] < 0) & (up_ * v[i + 1] >= 0);
        }
        // Four times what the head asks for.
        return crossings == 1 && least_area > 0 &&
               least_area * least_area * shortest > 32 * reach_ * reach_ * longest * longest;
    }

    const Soup& soup_;
    double reach_;
    double up_ = 1;              ///< 1 when the star is seen from its front, else -1
    std::vector<double> at_[3];  ///< the ring's points, relative to the vertex; the first again at the end
};

}  // namespace

Stars find_stars(const Soup& soup, double reach, const Context& context) {
    const std::size_t points = soup.points.size();
    Stars stars{corners_by_point(soup.facets, 0, points, context), {}, {}};
    stars.is_fan.assign(points, 0);
    stars.is_spread.assign(points, 0);
    if (context.cancelled()) return stars;
    constexpr std::size_t grain = 1 << 10;
    parallel_chunks(context, points, grain, [&](std::size_t first, std::size_t last) {
        Ring ring;
        SpreadTest test(soup, reach);
        for (std::size_t point = first; point < last; ++point) {
            const std::span<const std::uint32_t> corners = stars.corners.at(point);
            if (corners.size() < 3) continue;
            ring.begin(corners.size());
            const TransitionId transition = soup.transition[corners[0] / 4];
            bool equal = true;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const std::uint32_t facet = corners[i] / 4, k = corners[i] % 4;
                const mesh::Triangle& t = soup.facets[facet];
                ring.set(i, t[(k + 1) % 3], t[(k + 2) % 3]);
                equal = equal && soup.transition[facet] == transition;
            }
            if (!equal || !ring.close()) continue;
            stars.is_fan[point] = 1;
            stars.is_spread[point] = test.is_spread(static_cast<std::uint32_t>(point), ring.points());
        }
    });
    return stars;
}

}  // namespace octavo::boolean
