// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/classify.hpp>
#include <octavo/exact/orient_in_plane.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/exact/side.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

using exact::Plane;
using exact::Point;
using exact::Sign;

/// v + ε (a - v) + ε² (b - v) for an infinitely small ε: a point inside the triangle (v, a, b), next to v. Where a
/// linear function is zero at v, its sign at the point is that at a, or where that is zero too, that at b.
class NearCorner {
  public:
    NearCorner(const PointTable& points, const mesh::Triangle& corners)
        : points_(points), corners_(corners) {}

    /// Which way p, q and the point turn, seen from the far end of `axis`.
    Sign turn(int axis, Point p, Point q) const {
        return first_sign([&](const auto& corner) { return exact::orient2d(axis, p, q, corner); });
    }
    Sign side_of(const Plane& plane) const {
        return first_sign([&](const auto& corner) { return exact::side_of(plane, corner); });
    }
    /// Corners of a box of lattice points that holds v.
    std::pair<Point, Point> bounds() const {
        if (const Point* const at = points_.lattice_point(corners_[0])) return {*at, *at};
        const Point low = points_.cell(corners_[0]);
        return {low, {low.x + 1, low.y + 1, low.z + 1}};
    }

  private:
    template <class Function>
    Sign first_sign(const Function& sign_at) const {
        Sign sign = Sign::zero;
        for (std::size_t k = 0; k < 3 && sign == Sign::zero; ++k) sign = points_.with(corners_[k], sign_at);
        return sign;
    }

    const PointTable& points_;
    const mesh::Triangle& corners_;
};

class Classifier {
  public:
    Classifier(const Complex& complex, const PointTable& points, const FacetTree& tree,
               const Patches& patches, const Program& program, Dangling dangling)
        : complex_(complex),
          points_(points),
          tree_(tree),
          patches_(patches),
          program_(program),
          keeps_dangling_(dangling == Dangling::kept),
          indicator_(program) {}

    Result<Classification> run(const Context& context) {
        if (indicator_.value())
            return Error{ErrorCode::bad_input,
                         "the result is unbounded: the expression holds outside of all operands",
                         {}};
        build_regions();
        std::uint32_t operands = program_.operands();
        for (TransitionId id = 0; id < complex_.soup->first_triangle.size() - 1; ++id)
            operands = std::max(operands, id + 1);
        winding_.assign(operands, 0);
        fingerprint_of_.assign(regions_, 0);
        inside_.assign(regions_, unvisited);
        dangling_.assign(patches_.count, 0);
        Classification result;
        for (std::uint32_t region = 0; region < regions_; ++region) {
            if (inside_[region] != unvisited) continue;
            if (context.cancelled()) return Context::cancelled_error();
            ++result.components;
            const Status status = visit_component(region);
            if (!status) return status.error();
        }
        for (std::uint32_t patch = 0; patch < patches_.count; ++patch) {
            const bool front = inside_[region_[2 * patch]] == 1, back = inside_[region_[2 * patch + 1]] == 1;
            result.of_patch.push_back(front != back      ? (back ? Role::kept : Role::reversed)
                                      : dangling_[patch] ? Role::dangling
                                                         : Role::dropped);
        }
        return result;
    }

  private:
    static constexpr char unvisited = 2;

    void build_regions() {
        mesh::DisjointSets sets(2 * static_cast<std::size_t>(patches_.count));
        for (const auto& [first, second] : patches_.same_region) sets.unite(first, second);
        region_.resize(2 * static_cast<std::size_t>(patches_.count));
        for (PatchSide s = 0; s < region_.size(); ++s) {
            const std::uint32_t root = sets.find(s);
            region_[s] = root == s ? regions_++ : region_[root];
        }
        // Per region, the sides of patches that look at it.
        side_begin_.assign(regions_ + 1, 0);
        for (const std::uint32_t region : region_) ++side_begin_[region + 1];
        for (std::uint32_t region = 0; region < regions_; ++region)
            side_begin_[region + 1] += side_begin_[region];
        sides_.resize(region_.size());
        std::vector<std::uint32_t> next(side_begin_.begin(), side_begin_.end() - 1);
        for (PatchSide s = 0; s < region_.size(); ++s) sides_[next[region_[s]]++] = s;

        for (const std::uint32_t first : patches_.first) transition_.push_back(complex_.transition(first));
    }

    Status visit_component(std::uint32_t start);
    Status walk(std::uint32_t start);
    std::uint32_t find_seed(std::uint32_t start);
    void add_ray(std::uint32_t seed);
    void change(std::span<const Delta> deltas, int sign);
    bool holds_between(std::span<const Delta> deltas, int sign);
    void enter(std::uint32_t region) {
        fingerprint_of_[region] = fingerprint_;
        inside_[region] = indicator_.value() ? 1 : 0;
    }

    const Complex& complex_;
    const PointTable& points_;
    const FacetTree& tree_;
    const Patches& patches_;
    const Program& program_;
    const bool keeps_dangling_;

    std::uint32_t regions_ = 0;
    std::vector<std::uint32_t> region_;  ///< of each patch side
    std::vector<std::uint32_t> side_begin_;
    std::vector<PatchSide> sides_;
    std::vector<TransitionId> transition_;  ///< of each patch
    std::vector<std::uint64_t> fingerprint_of_;
    std::vector<char> inside_;
    std::vector<char> dangling_;  ///< per patch
    std::vector<std::uint32_t> stack_;
    std::vector<char> gathered_;
    std::vector<std::pair<TransitionId, int>> ray_;  ///< what the component's ray crossed

    Indicator indicator_;
    std::vector<std::int32_t> winding_;
    std::uint64_t fingerprint_ = 0;
};

/// The multiplier of an operand's winding number in the fingerprint.
std::uint64_t weight_of(std::uint32_t operand) {
    std::uint64_t x = (operand + 1) * 0x9E3779B97F4A7C15ull;
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ x >> 27) * 0x94D049BB133111EBull;
    return x ^ x >> 31;
}

void Classifier::change(std::span<const Delta> deltas, int sign) {
    for (const Delta& delta : deltas) {
        const std::int32_t before = winding_[delta.operand], after = before + sign * delta.turns;
        winding_[delta.operand] = after;
        fingerprint_ +=
            weight_of(delta.operand) * static_cast<std::uint64_t>(static_cast<std::int64_t>(after) - before);
        if ((before > 0) != (after > 0)) indicator_.set(delta.operand, after > 0);
    }
}

/// Whether the expression holds on a patch beyond which the winding numbers have changed, each operand taken with its
/// boundary.
bool Classifier::holds_between(std::span<const Delta> deltas, int sign) {
    if (deltas.size() < 2) return false;  // the operand holds on one side, and so does the expression
    const auto enters = [&](const Delta& delta) {
        return winding_[delta.operand] <= 0 && winding_[delta.operand] + sign * delta.turns > 0;
    };
    for (const Delta& delta : deltas)
        if (enters(delta)) indicator_.set(delta.operand, true);
    const bool holds = indicator_.value();
    for (const Delta& delta : deltas)
        if (enters(delta)) indicator_.set(delta.operand, false);
    return holds;
}

/// The first triangle of the component of `start`: a whole facet if it has any.
std::uint32_t Classifier::find_seed(std::uint32_t start) {
    if (gathered_.empty()) gathered_.assign(regions_, 0);
    stack_.assign(1, start);
    gathered_[start] = 1;
    std::uint32_t best = no_index;
    while (!stack_.empty()) {
        const std::uint32_t region = stack_.back();
        stack_.pop_back();
        for (std::uint32_t i = side_begin_[region]; i < side_begin_[region + 1]; ++i) {
            const std::uint32_t patch = sides_[i] / 2, other = region_[sides_[i] ^ 1];
            best = std::min(best, patches_.first[patch]);
            if (gathered_[other]) continue;
            gathered_[other] = 1;
            stack_.push_back(other);
        }
    }
    return best;
}

/// Sets the winding numbers in front of `seed`.
void Classifier::add_ray(std::uint32_t seed) {
    const Soup& soup = *complex_.soup;
    const std::uint32_t own = complex_.facet(seed);
    const NearCorner near(points_, complex_.corners(seed));
    const auto plane_of = [&](const mesh::Triangle& t) {
        return Plane::through(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]);
    };
    const Plane own_plane = plane_of(soup.facets[own]);
    const int axis = own_plane.dominant_axis(), outward = own_plane.normal(axis) > 0 ? 1 : -1;
    const auto [low, high] = near.bounds();
    tree_.for_each_on_ray(low, high, axis, outward, [&](std::uint32_t other) {
        if (other == own) return;
        const mesh::Triangle& t = soup.facets[other];
        const Point p = soup.points[t[0]], q = soup.points[t[1]], r = soup.points[t[2]];
        const Sign first = near.turn(axis, p, q);
        if (first == Sign::zero || near.turn(axis, q, r) != first || near.turn(axis, r, p) != first) return;
        // `first` is also the sign of the plane's normal along the axis: the facet faces the ray's end if that
        // agrees with the ray's direction. The ray crosses it if the near point is on its nearer side.
        const int faces_along = static_cast<int>(first) * outward;
        if (static_cast<int>(near.side_of(plane_of(t))) != -faces_along) return;
        ray_.push_back({soup.transition[other], faces_along});
        change(soup.transitions.of(soup.transition[other]), faces_along);
    });
}

Status Classifier::visit_component(std::uint32_t start) {
    const std::uint32_t seed = find_seed(start);
    add_ray(seed);
    const Status status = walk(region_[2 * patches_.of_triangle[seed]]);
    // The walk has taken its changes back unless it failed; those of the ray remain.
    for (const auto& [transition, sign] : ray_) change(complex_.soup->transitions.of(transition), -sign);
    ray_.clear();
    return status;
}

Status Classifier::walk(std::uint32_t start) {
    struct Step {
        std::uint32_t region, next;  ///< next: position in sides_
        PatchSide through;           ///< the side of the patch by which the region was left before this one
    };
    std::vector<Step> path{{start, side_begin_[start], no_index}};
    enter(start);
    while (!path.empty()) {
        Step& step = path.back();
        if (step.next == side_begin_[step.region + 1]) {
            const PatchSide through = step.through;
            path.pop_back();
            if (through != no_index)
                change(complex_.transitions.of(transition_[through / 2]), through % 2 ? 1 : -1);
            continue;
        }
        const PatchSide s = sides_[step.next++];
        const std::uint32_t other = region_[s ^ 1];
        const std::span<const Delta> deltas = complex_.transitions.of(transition_[s / 2]);
        const int sign = s % 2 ? -1 : 1;  // from the front, the winding behind is greater by the change
        if (keeps_dangling_ && inside_[step.region] == 0 && holds_between(deltas, sign)) dangling_[s / 2] = 1;
        if (inside_[other] != unvisited) {
            std::uint64_t expected = fingerprint_;
            for (const Delta& delta : deltas)
                expected += weight_of(delta.operand) *
                            static_cast<std::uint64_t>(static_cast<std::int64_t>(sign * delta.turns));
            if (expected != fingerprint_of_[other])
                return Error{ErrorCode::internal, "winding numbers contradict each other", {}};
            continue;
        }
        change(deltas, sign);
        enter(other);
        path.push_back({other, side_begin_[other], s});
    }
    return Done{};
}

}  // namespace

Result<Classification> classify(const Complex& complex, const PointTable& points, const FacetTree& tree,
                                const Patches& patches, const Program& program, Dangling dangling,
                                const Context& context) {
    return Classifier(complex, points, tree, patches, program, dangling).run(context);
}

}  // namespace octavo::boolean
