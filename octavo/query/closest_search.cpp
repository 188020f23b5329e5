// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include <octavo/query/closest_search.hpp>
#include <octavo/query/turned_box.hpp>

namespace octavo::query {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Lower bounds of the squared distances to the children's boxes.
///
/// With e = 2^-24 a place along an axis errs by less than 8 e |p|₁, p relative to the node: within the node that is
/// less than the slack of its boxes, and of a place far off less than 2^-20 of its distance. What is taken off is more
/// than that and the skew of the axes (turned_box.hpp), 2 · 5e-5 of the square.
Float8 squares_to_boxes(const TreeNode& node, Vec3 q) {
    constexpr double unit = 1.0 / TurnedBox::unit;
    const Float8 x = all(static_cast<float>((q.x - node.origin[0]) * unit)),
                 y = all(static_cast<float>((q.y - node.origin[1]) * unit)),
                 z = all(static_cast<float>((q.z - node.origin[2]) * unit));
    Float8 sum = all(0);
    for (std::size_t k = 0; k < 3; ++k) {
        const Float8 place =
            floats(node.axes[k][0]) * x + floats(node.axes[k][1]) * y + floats(node.axes[k][2]) * z;
        const Float8 below = floats(node.low[k]) * node.step - place,
                     above = place - floats(node.high[k]) * node.step;
        const Float8 gap = greater(greater(below, above), all(0));
        sum += gap * gap;
    }
    return sum * (1 - 2e-4F);
}

/// A query point in two parts, so that its differences from lattice points are as exact near it as floats can be.
struct SplitPoint {
    std::array<std::int32_t, 3> whole;
    std::array<float, 3> rest;

    explicit SplitPoint(Vec3 q) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const double near = std::clamp(q[axis], -0x1p30, 0x1p30);
            whole[i] = static_cast<std::int32_t>(near);
            rest[i] = static_cast<float>(q[axis] - whole[i]);
        }
    }
};

struct Measured {
    Float8 distance,
        error;  ///< the true distances lie within distance ± error; without area the error is infinite
};

/// Distances to the triangles of a leaf.
///
/// The error, with e = 2^-24 and k = |u| |v| / |u × v| >= 1: w = q − a errs by 3 e (|w| + 1) and so do points of edges;
/// an error of their parameters changes the distance by its square only. The face: the computed normal errs in
/// direction by 6 e k, the height over the plane by (6 k + 4) e |w|. A foot that is taken for inside wrongly still has
/// a point of the triangle near it: the computed β and γ, which then are >= 0 with a sum <= 1, name one, no farther
/// than 2 k (6 k + 13) e |w| + 9 e k (|u| + |v|) from the foot; that holds at sharp corners too, where the foot may be
/// far from the border. One that is taken for outside wrongly is as near to the border. So 63 e k² (|w| + |u| + |v| +
/// 1) covers all; 68 e k² is used, for k, of which nothing beyond 2^15 is believed, errs by a hundredth.
Measured measure(const TreeLeaf& leaf, const SplitPoint& q) {
    const Float8x3 u{floats(leaf.u[0]), floats(leaf.u[1]), floats(leaf.u[2])},
        v{floats(leaf.v[0]), floats(leaf.v[1]), floats(leaf.v[2])};
    const Float8x3 w{floats(q.whole[0] - leaf.a[0]) + q.rest[0], floats(q.whole[1] - leaf.a[1]) + q.rest[1],
                     floats(q.whole[2] - leaf.a[2]) + q.rest[2]};
    const Float8 zero = all(0), one = all(1), tiny = all(1e-30F);
    const auto clamped = [&](Float8 t) { return smaller(greater(t, zero), one); };
    const Float8 u_u = dot(u, u), v_v = dot(v, v), u_w = dot(u, w), v_w = dot(v, w);

    const Float8x3 to_ab = w - clamped(u_w / greater(u_u, tiny)) * u;
    const Float8x3 to_ac = w - clamped(v_w / greater(v_v, tiny)) * v;
    const Float8x3 e = v - u, w_b = w - u;
    const Float8x3 to_bc = w_b - clamped(dot(e, w_b) / greater(dot(e, e), tiny)) * e;
    Float8 square = smaller(smaller(dot(to_ab, to_ab), dot(to_ac, to_ac)), dot(to_bc, to_bc));

    // Of unit length, so that nothing overflows however far the point is.
    const Float8x3 n = cross(u, v);
    const Float8 n_n = dot(n, n), inverse = one / root(n_n);
    const Float8x3 normal = inverse * n;
    const Float8 height = dot(normal, w);
    const Float8 beyond_ab = dot(normal, cross(u, w)), beyond_ac = dot(normal, cross(w, v));
    const Int8 foot_inside =
        (beyond_ab > zero) & (beyond_ac > zero) & (beyond_ab + beyond_ac < n_n * inverse);
    square = foot_inside ? smaller(square, height * height) : square;

    const Float8 size = magnitude(w.x) + magnitude(w.y) + magnitude(w.z) + magnitude(u.x) + magnitude(u.y) +
                        magnitude(u.z) + magnitude(v.x) + magnitude(v.y) + magnitude(v.z) + one;
    const Float8 lengths = u_u * v_v;
    const Float8 error = 0x1.1p-18F * size * (lengths * inverse * inverse);
    return {root(square), n_n > 0x1p-30F * lengths ? error : all(infinity)};
}

/// A triangle that floats do not exclude.
struct Candidate {
    float at_least;
    std::uint32_t leaf, place;
};

/// A node that was entered, and which of its children still wait: for each its number in the lowest bits of the squared
/// distance; positive floats are ordered as their bits are. So the nearest is a matter of seven minima; sorting the
/// children costs branches nobody foretells.
struct Entered {
    Int8 waiting;
    const TreeNode* node;
};
constexpr std::int32_t none = 0x7fffffff;

class Walk {
  public:
    Walk(const ClosestTree& tree, const FixedPoint& fixed, float at_most)
        : tree_(tree), fixed_(fixed), q_(fixed.approximation()), split_(q_), bound_(at_most) {}

    NearestTriangle run() {
        enter(tree_.nodes[0]);
        while (depth_ > 0) {
            Entered& last = entered_[depth_ - 1];
            const std::int32_t nearest = least(last.waiting);
            if (!(nearest <= limit())) {
                --depth_;
                continue;
            }
            last.waiting = last.waiting == nearest ? none + Int8{} : last.waiting;
            const std::uint32_t child = last.node->child[static_cast<std::size_t>(nearest & 7)];
            // The next one is asked for meanwhile, unless nothing is known yet of how far the walk goes.
            if (const std::int32_t next = least(last.waiting); next <= limit() && bound_ < infinity)
                prefetch(last.node->child[static_cast<std::size_t>(next & 7)]);
            if (child & TreeNode::leaf_bit)
                visit_leaf(child & ~TreeNode::leaf_bit);
            else
                enter(tree_.nodes[child]);
        }
        for (std::size_t i = 0; i < candidate_count_; ++i)
            if (!(candidates_[i].at_least > bound_)) consider(candidates_[i]);
        return best_;
    }

  private:
    /// Of squared distances, as bits with any child's number.
    std::int32_t limit() const { return std::bit_cast<std::int32_t>(bound_ * bound_ * (1 + 0x1p-22F)) | 7; }

    void prefetch(std::uint32_t child) const {
        const std::uint32_t leaf = child & ~TreeNode::leaf_bit;
        const void* begin =
            leaf != child ? static_cast<const void*>(&tree_.leaves[leaf]) : &tree_.nodes[child];
        for (std::size_t line = 0; line < sizeof(TreeLeaf); line += 64)
            __builtin_prefetch(static_cast<const char*>(begin) + line);
    }

    void enter(const TreeNode& node) {
        const Float8 squares = squares_to_boxes(node, q_);
        Int8 bits, children;
        std::memcpy(&bits, &squares, sizeof bits);
        std::memcpy(&children, node.child.data(), sizeof children);
        const Int8 numbers{0, 1, 2, 3, 4, 5, 6, 7};
        entered_[depth_++] = {children == 0 ? none + Int8{} : (bits & ~7) | numbers, &node};
    }

    void visit_leaf(std::uint32_t index) {
        const TreeLeaf& leaf = tree_.leaves[index];
        const Measured measured = measure(leaf, split_);
        const Float8 at_least = measured.distance - measured.error,
                     at_most = measured.distance + measured.error;
        // A bound that is no number loses every comparison; unused places repeat the last triangle.
        bound_ = std::min(bound_, least(at_most == at_most ? at_most : all(infinity)));
        Int8 faces;
        std::memcpy(&faces, leaf.face.data(), sizeof faces);
        // Written so that an error bound of infinity, whose difference may be no number, keeps the triangle.
        unsigned kept =
            bits_of(~(at_least > all(bound_)) & (faces != static_cast<std::int32_t>(TreeLeaf::no_face)));
        for (; kept != 0; kept &= kept - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(kept));
            if (candidate_count_ == candidates_.size()) make_room();
            candidates_[candidate_count_++] = {at_least[i], index, i};
        }
    }

    void make_room() {
        std::size_t kept = 0;
        for (const Candidate& c : candidates_)
            if (!(c.at_least > bound_)) candidates_[kept++] = c;
        if (kept == candidates_.size())
            for (; kept > 0; --kept) consider(candidates_[kept - 1]);
        candidate_count_ = kept;
    }

    /// Measures a triangle exactly.
    void consider(const Candidate& candidate) {
        const TreeLeaf& leaf = tree_.leaves[candidate.leaf];
        NearestTriangle next;
        next.face = leaf.face[candidate.place];
        const auto at = [&](const std::array<Int8, 3>& lanes) {
            const std::uint32_t i = candidate.place;
            return exact::Point{lanes[0][i], lanes[1][i], lanes[2][i]};
        };
        const exact::Point a = at(leaf.a), u = at(leaf.u), v = at(leaf.v);
        next.corners = {a, {a.x + u.x, a.y + u.y, a.z + u.z}, {a.x + v.x, a.y + v.y, a.z + v.z}};
        next.feature = nearest_feature(fixed_, next.corners);
        if (best_.face != TreeLeaf::no_face) {
            const auto order = compare_distance(fixed_, next.feature, best_.feature);
            if (order > 0 || (order == 0 && next.face > best_.face)) return;
        }
        best_ = next;
        // A float root errs by half a unit in the last place; 2^-22 is four.
        bound_ =
            std::min(bound_, static_cast<float>(std::sqrt(next.feature.squared_distance)) * (1 + 0x1p-22F));
    }

    static_assert(sizeof(TreeNode) <= sizeof(TreeLeaf));

    const ClosestTree& tree_;
    const FixedPoint& fixed_;
    const Vec3 q_;
    const SplitPoint split_;
    float bound_;  ///< of the distance, from above
    NearestTriangle best_;

    // A vertex has about six triangles; more candidates than fit only cost time.
    std::array<Candidate, 32> candidates_;
    std::size_t candidate_count_ = 0;
    // At most 48 + 32 levels (closest_tree.cpp).
    std::array<Entered, 81> entered_;
    std::size_t depth_ = 0;
};

}  // namespace

NearestTriangle search(const ClosestTree& tree, const FixedPoint& q, float at_most) {
    return Walk(tree, q, at_most).run();
}

}  // namespace octavo::query
