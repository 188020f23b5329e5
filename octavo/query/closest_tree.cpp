// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <octavo/query/closest_tree.hpp>

namespace octavo::query {
namespace {

struct Box {
    std::array<std::int32_t, 3> low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    void add(const Box& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], box.low[axis]);
            high[axis] = std::max(high[axis], box.high[axis]);
        }
    }
    /// Half the surface; 0 when empty.
    double half_area() const {
        if (low[0] > high[0]) return 0;
        const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x * y + y * z + z * x;
    }
    /// Twice the centre.
    std::int32_t middle(std::size_t axis) const { return low[axis] + high[axis]; }
};

/// The parts of a range of `order_` that become children.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Box box;
    int depth = 0;
    std::uint32_t count() const { return end - begin; }
};

class TreeBuilder {
  public:
    explicit TreeBuilder(const mesh::LatticeMesh& mesh) : mesh_(mesh), boxes_(mesh.triangles.size()) {
        for (std::size_t i = 0; i < boxes_.size(); ++i)
            for (const mesh::VertexIndex vertex : mesh.triangles[i]) {
                const exact::Point p = mesh.points[vertex];
                boxes_[i].add({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
            }
        order_.resize(boxes_.size());
        std::iota(order_.begin(), order_.end(), 0U);
    }

    ClosestTree run() {
        if (boxes_.empty()) return {};
        tree_.leaves.reserve(boxes_.size() / 6 + 1);
        Range all{0, static_cast<std::uint32_t>(boxes_.size()), {}, 0};
        for (const Box& box : boxes_) all.box.add(box);
        add_node(all);
        tree_.nodes.shrink_to_fit();
        tree_.leaves.shrink_to_fit();
        return std::move(tree_);
    }

  private:
    // Bins a split; more find no better splits of scanned surfaces.
    static constexpr int bins = 16;
    // Below this depth of binary splits halves are taken instead, so that no input makes the tree deep.
    static constexpr int area_depth = 48;

    std::uint32_t add_node(const Range& range) {
        const auto index = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        std::array<Range, tree_width> parts{range};
        std::size_t count = 1;
        while (count < tree_width) {
            std::size_t largest = count;
            double most = -1;
            for (std::size_t i = 0; i < count; ++i) {
                const double weight = (parts[i].box.half_area() + 1) * parts[i].count();
                if (parts[i].count() > tree_width && weight > most) most = weight, largest = i;
            }
            if (largest == count) break;
            const auto [first, second] = split(parts[largest]);
            parts[largest] = first;
            parts[count++] = second;
        }
        TreeNode node{};
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < tree_width; ++i) {
                node.low[axis][i] =
                    i < count ? below(parts[i].box.low[axis]) : std::numeric_limits<float>::max();
                node.high[axis][i] =
                    i < count ? above(parts[i].box.high[axis]) : -std::numeric_limits<float>::max();
            }
        for (std::size_t i = 0; i < count; ++i)
            node.child[i] = parts[i].count() <= tree_width ? add_leaf(parts[i]) : add_node(parts[i]);
        tree_.nodes[index] = node;
        return index;
    }

    static float below(std::int32_t x) {
        const float nearest = static_cast<float>(x);
        return static_cast<double>(nearest) > x ? std::nextafter(nearest, -1e30F) : nearest;
    }
    static float above(std::int32_t x) {
        const float nearest = static_cast<float>(x);
        return static_cast<double>(nearest) < x ? std::nextafter(nearest, 1e30F) : nearest;
    }

    struct Bin {
        Box box;
        std::uint32_t count = 0;
    };
    static double leaves_of(std::uint32_t count) { return (count + tree_width - 1) / tree_width; }

    std::array<Range, 2> split(const Range& range) {
        Box centres;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const Box& box = boxes_[order_[i]];
            const std::array<std::int32_t, 3> c{box.middle(0), box.middle(1), box.middle(2)};
            centres.add({c, c});
        }
        double best_cost = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0;
        int best_bin = 0;
        for (std::size_t axis = 0; axis < 3 && range.depth < area_depth; ++axis) {
            if (centres.low[axis] == centres.high[axis]) continue;
            std::array<Bin, bins> all{};
            for (std::uint32_t i = range.begin; i < range.end; ++i) {
                const Box& box = boxes_[order_[i]];
                Bin& bin = all[static_cast<std::size_t>(bin_of(box, centres, axis))];
                bin.box.add(box);
                ++bin.count;
            }
            std::array<double, bins> above_cost{};
            Bin right;
            for (int i = bins - 1; i > 0; --i) {
                right.box.add(all[static_cast<std::size_t>(i)].box);
                right.count += all[static_cast<std::size_t>(i)].count;
                above_cost[static_cast<std::size_t>(i)] = right.box.half_area() * leaves_of(right.count);
            }
            Bin left;
            for (int i = 1; i < bins; ++i) {
                left.box.add(all[static_cast<std::size_t>(i - 1)].box);
                left.count += all[static_cast<std::size_t>(i - 1)].count;
                const double cost =
                    left.box.half_area() * leaves_of(left.count) + above_cost[static_cast<std::size_t>(i)];
                if (left.count > 0 && left.count < range.count() && cost < best_cost)
                    best_cost = cost, best_axis = axis, best_bin = i;
            }
        }
        const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
        auto middle = begin + range.count() / 2;
        if (best_bin > 0) {
            middle = std::partition(begin, end, [&](std::uint32_t i) {
                return bin_of(boxes_[i], centres, best_axis) < best_bin;
            });
        } else {
            std::size_t axis = 0;
            for (std::size_t k = 1; k < 3; ++k)
                if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
            std::nth_element(begin, middle, end, [&](std::uint32_t i, std::uint32_t j) {
                const std::int32_t a = boxes_[i].middle(axis), b = boxes_[j].middle(axis);
                return a != b ? a < b : i < j;
            });
        }
        const auto cut = static_cast<std::uint32_t>(middle - order_.begin());
        std::array<Range, 2> parts{Range{range.begin, cut, {}, range.depth + 1},
                                   Range{cut, range.end, {}, range.depth + 1}};
        for (Range& part : parts)
            for (std::uint32_t i = part.begin; i < part.end; ++i) part.box.add(boxes_[order_[i]]);
        return parts;
    }

    static int bin_of(const Box& box, const Box& centres, std::size_t axis) {
        const std::int64_t span = std::int64_t{centres.high[axis]} - centres.low[axis] + 1;
        return static_cast<int>((std::int64_t{box.middle(axis)} - centres.low[axis]) * bins / span);
    }

    std::uint32_t add_leaf(const Range& range) {
        TreeLeaf leaf{};
        leaf.count = range.count();
        for (std::size_t axis = 0; axis < 3; ++axis)
            leaf.origin[axis] = range.box.low[axis] + (range.box.high[axis] - range.box.low[axis]) / 2;
        std::sort(order_.begin() + range.begin, order_.begin() + range.end);
        double extent = 0;
        for (std::size_t i = 0; i < tree_width; ++i) {
            leaf.face[i] = order_[range.begin + (i < leaf.count ? i : 0)];
            const mesh::Triangle& t = mesh_.triangles[leaf.face[i]];
            std::array<std::array<double, 3>, 3> edges{};  // a, u, v
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                const std::int32_t a = mesh_.points[t[0]][axis], b = mesh_.points[t[1]][axis],
                                   c = mesh_.points[t[2]][axis];
                edges[0][k] = a - leaf.origin[k];
                edges[1][k] = b - a;
                edges[2][k] = c - a;
                leaf.a[k][i] = static_cast<float>(edges[0][k]);
                leaf.u[k][i] = static_cast<float>(edges[1][k]);
                leaf.v[k][i] = static_cast<float>(edges[2][k]);
                for (const std::int32_t x : {a, b, c})
                    extent = std::max(extent, std::fabs(x - leaf.origin[k]));
            }
            leaf.error[i] = relative_error(edges[1], edges[2]);
        }
        leaf.extent = std::nextafter(static_cast<float>(extent), 1e30F);
        tree_.leaves.push_back(leaf);
        return static_cast<std::uint32_t>(tree_.leaves.size() - 1) | TreeNode::leaf_bit;
    }

    /// Bounds the error of the measured distance by this times (|q|₁ + extent), q relative to the leaf's origin.
    ///
    /// With e = 2^-24: w = q − a errs by 3 e (|q| + extent) (q, a and the difference are rounded), and so do points of
    /// edges, at parameters that err by 8 e |w| / |edge|: 12 e in all. The face: the computed normal u × v errs in
    /// direction by 6 e k, k = |u| |v| / |u × v|; the height over the plane by (6 k + 4) e |w|; the tests whether the
    /// foot lies in the triangle by 12 e k |w| (|u| + |v|) / |edge| <= 24 e k² |w| across the edge, since
    /// |v| / |c − b| <= k. A foot taken for inside or outside wrongly is no farther from the border than that. So
    /// 48 e k² (|q| + extent) covers all, k >= 1; 2^-18 k² is more.
    static float relative_error(const std::array<double, 3>& u, const std::array<double, 3>& v) {
        const double x = u[1] * v[2] - u[2] * v[1], y = u[2] * v[0] - u[0] * v[2],
                     z = u[0] * v[1] - u[1] * v[0];
        const double square = x * x + y * y + z * z;
        const double lengths =
            (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        if (!(square > 0x1p-30 * lengths)) return std::numeric_limits<float>::infinity();
        return static_cast<float>(0x1p-18 * 1.001 * lengths / square);
    }

    const mesh::LatticeMesh& mesh_;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
    ClosestTree tree_;
};

}  // namespace

ClosestTree ClosestTree::build(const mesh::LatticeMesh& mesh) { return TreeBuilder(mesh).run(); }

}  // namespace octavo::query
