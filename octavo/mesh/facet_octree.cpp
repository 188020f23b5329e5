// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include <octavo/mesh/facet_octree.hpp>

namespace octavo::mesh {
namespace {

using exact::Point;

// A leaf has at most the pairs of so many facets. Smaller leaves list facets more often, larger ones have more pairs.
constexpr double leaf_size = 24;

// Splitting costs longer lists (facets in several octants) and pays in fewer pairs. Parallel slivers lie twice as often
// in lists half as long: nothing gained, however small the cells. So a path keeps account of its waste, and stops where
// it exceeds what all pairs of the list would cost; the divisor is entries that are split in the time of a pair.
// Counting levels in which lists do not shrink was tried: fans of a thousand slivers of aspect 10^4 took minutes.
constexpr double least_waste = 8;
constexpr double facets_per_waste = 32;

bool gives_up(double waste, std::size_t facets) {
    return waste > std::max(least_waste, static_cast<double>(facets) / facets_per_waste);
}

// Fewer facets that run through a cell are no bundle worth settling; more would cost seconds at once, and may part in
// smaller cells.
constexpr std::size_t least_settled = 16, most_settled = 8192;

// Settling only after splitting had turned out not to pay was tried: no better on cones, minutes on bundles of slivers.

// How many facets of a list are asked for a fan at their vertices. A hub among them costs a look at the list; vertices
// of few facets are passed over unlooked, or else every list of an ordinary scan pays (a third more instructions in
// all).
constexpr std::size_t fan_samples = 4;

// Facets of a task. Small enough for eight threads to share 100K facets, large enough that the lists of the tasks
// are lost in the cost.
constexpr std::size_t task_size = 4096;

/// The octants that a box touches, as bits: the low half of an axis holds [low, middle), the high one the rest.
std::uint32_t octants_of_box(const FacetBox& box, const std::array<std::int32_t, 3>& middle) {
    constexpr std::array<std::uint32_t, 3> low_halves{0x55, 0x33, 0x0f};
    std::uint32_t octants = 0xff;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.low[axis] >= middle[axis]) octants &= ~low_halves[axis];
        if (box.high[axis] < middle[axis]) octants &= low_halves[axis];
    }
    return octants;
}

FacetCell octant_of(const FacetCell& cell, std::size_t octant) {
    FacetCell child = cell;
    child.side = cell.side / 2;
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (octant >> axis & 1) child.low[axis] += child.side;
    return child;
}

std::array<Point, 3> corners_of(const Triangle& t, std::span<const Point> points) {
    return {points[t[0]], points[t[1]], points[t[2]]};
}

/// The octants that a facet of the cell enters.
std::uint32_t octants_of(const std::array<Point, 3>& facet, const FacetCell& cell) {
    const std::int32_t half = cell.side / 2;
    const FacetBox box = box_of(facet);
    std::uint32_t octants = octants_of_box(box, {cell.low[0] + half, cell.low[1] + half, cell.low[2] + half});
    // A facet in one octant, or across one plane between two, is where its box is. Of the others only those
    // that are not small beside the cell are worth nine axes an octant.
    if (std::popcount(octants) <= 2) return octants;
    const std::int32_t extent =
        std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
    if (extent < cell.side / 4) return octants;
    for (std::uint32_t rest = octants; rest != 0; rest &= rest - 1) {
        const int octant = std::countr_zero(rest);
        if (!may_enter(facet, octant_of(cell, static_cast<std::size_t>(octant)).low, half))
            octants &= ~(1u << octant);
    }
    return octants;
}

/// Entries of a list, and those of them that are not settled.
struct ListSize {
    std::size_t all = 0, fresh = 0;
    /// Twice the number of pairs to visit.
    double pairs() const {
        return static_cast<double>(fresh) * (2 * static_cast<double>(all) - static_cast<double>(fresh));
    }
};

/// The waste of the octants of a cell: grows with the entries of their lists, shrinks with their pairs.
double waste_below(double waste, const ListSize& cell, const std::array<ListSize, 8>& octants) {
    double entries = 0, pairs = 0;
    for (const ListSize& octant : octants) {
        if (octant.fresh == 0) continue;
        entries += static_cast<double>(octant.all);
        pairs += octant.pairs();
    }
    return std::max(1.0, waste * (entries / static_cast<double>(cell.all)) * (pairs / cell.pairs()));
}

/// Does the facet reach from one side of the cell to the other along an axis?
bool runs_through(const std::array<Point, 3>& facet, const FacetCell& cell) {
    const FacetBox box = box_of(facet);
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (box.low[axis] <= cell.low[axis] && box.high[axis] >= cell.low[axis] + cell.side) return true;
    return false;
}

/// The descent below one part; the lists of the cells on the path lie one after the other on a stack.
class PairDescent {
  public:
    PairDescent(const PairSearch& search, const PairVisitor& visit)
        : points_(search.points), triangles_(search.triangles), is_hub_(search.is_hub), visit_pairs_(visit) {}

    void run(const PairTask& task) {
        if (task.kind != PairTask::Kind::descend)
            return visit_pairs_(task.cell, {task.faces, task.fresh, task.kind == PairTask::Kind::visit_fan});
        stack_ = task.faces;
        for (std::size_t i = task.fresh; i < stack_.size(); ++i) stack_[i] |= settled;
        visit(task.cell, 0);
    }

    /// Descends no further than to cells with few enough facets for one task; these and the pairs met on the way
    /// become the tasks.
    std::vector<PairTask> run_to_tasks(std::vector<FaceIndex> faces, const Context& context) {
        std::vector<PairTask> tasks;
        context_ = &context;
        tasks_ = &tasks;
        stack_ = std::move(faces);
        visit(FacetCell{}, 0);
        return tasks;
    }

  private:
    // Entries of the stack are facets; this bit marks settled ones. Facets are fewer than a third of 2^32.
    static constexpr FaceIndex settled = FaceIndex{1} << 31;

    /// The cell's list is the stack from `begin` to its top; it is gone afterwards.
    void visit(const FacetCell& cell, std::size_t begin) {
        if (context_ && context_->cancelled()) return stack_.resize(begin);
        ListSize size = size_from(begin);
        const auto all = [](FaceIndex) { return true; };
        if (tasks_ && size.all <= task_size) {
            if (size.fresh > 0 && size.all > 1) visit_chosen(cell, begin, PairTask::Kind::descend, all);
            stack_.resize(begin);
            return;
        }
        if (size.fresh > 0 && !is_leaf(cell, size)) size.fresh -= settle_fans(cell, begin);
        if (size.fresh > 0 && !is_leaf(cell, size)) size.fresh -= settle_through_going(cell, begin);
        if (size.fresh > 0 && size.all > 1) {
            if (is_leaf(cell, size))
                visit_chosen(cell, begin, PairTask::Kind::visit, all);
            else
                split(cell, begin, size);
        }
        stack_.resize(begin);
    }

    bool is_leaf(const FacetCell& cell, const ListSize& size) const {
        return size.pairs() <= leaf_size * leaf_size || cell.side == 1 || gives_up(cell.waste, size.all);
    }

    ListSize size_from(std::size_t begin) const {
        ListSize size;
        size.all = stack_.size() - begin;
        for (std::size_t i = begin; i < stack_.size(); ++i) size.fresh += !(stack_[i] & settled);
        return size;
    }

    /// Visits the pairs of the fresh facets that are chosen, with each other and with the settled ones, or makes them
    /// a task.
    template <class Choose>
    void visit_chosen(const FacetCell& cell, std::size_t begin, PairTask::Kind kind, const Choose& choose) {
        chosen_.clear();
        for (std::size_t i = begin; i < stack_.size(); ++i)
            if (!(stack_[i] & settled) && choose(stack_[i])) chosen_.push_back(stack_[i]);
        const std::size_t fresh = chosen_.size();
        for (std::size_t i = begin; i < stack_.size(); ++i)
            if (stack_[i] & settled) chosen_.push_back(stack_[i] & ~settled);
        if (kind == PairTask::Kind::visit_fan && fresh == chosen_.size()) return;
        if (tasks_)
            tasks_->push_back({cell, chosen_, fresh, kind});
        else
            visit_pairs_(cell, {chosen_, fresh, kind == PairTask::Kind::visit_fan});
    }

    /// Settles the facets that run through the cell, if they are many; returns how many.
    std::size_t settle_through_going(const FacetCell& cell, std::size_t begin) {
        const auto through = [&](FaceIndex face) {
            return !(face & settled) && runs_through(corners_of(triangles_[face], points_), cell);
        };
        const auto count = static_cast<std::size_t>(
            std::count_if(stack_.begin() + static_cast<std::ptrdiff_t>(begin), stack_.end(), through));
        if (count < least_settled || count > most_settled) return 0;
        visit_chosen(cell, begin, PairTask::Kind::visit, through);
        for (std::size_t i = begin; i < stack_.size(); ++i)
            if (through(stack_[i])) stack_[i] |= settled;
        return count;
    }

    void split(const FacetCell& cell, std::size_t begin, const ListSize& size) {
        const std::size_t end = stack_.size(), first_mask = masks_.size();
        std::array<ListSize, 8> sizes{};
        for (std::size_t i = begin; i < end; ++i) {
            const FaceIndex face = stack_[i] & ~settled;
            const std::uint32_t octants = octants_of(corners_of(triangles_[face], points_), cell);
            masks_.push_back(static_cast<std::uint8_t>(octants));
            for (std::size_t octant = 0; octant < 8; ++octant) {
                sizes[octant].all += octants >> octant & 1;
                sizes[octant].fresh += !(stack_[i] & settled) && (octants >> octant & 1);
            }
        }
        const double waste = waste_below(cell.waste, size, sizes);
        for (std::size_t octant = 0; octant < 8; ++octant) {
            if (sizes[octant].fresh == 0 || sizes[octant].all < 2) continue;
            for (std::size_t i = begin; i < end; ++i)
                if (masks_[first_mask + i - begin] >> octant & 1) stack_.push_back(stack_[i]);
            FacetCell child = octant_of(cell, octant);
            child.waste = waste;
            visit(child, end);
        }
        masks_.resize(first_mask);
    }

    /// Settles the large fans that do not end in the cell; returns how many facets. Hubs are found by samples: of a fan
    /// that is worth it some facets are met.
    std::size_t settle_fans(const FacetCell& cell, std::size_t begin) {
        std::size_t settled_facets = 0;
        for (std::size_t sample = 0; sample < fan_samples; ++sample) {
            const FaceIndex face = stack_[begin + (stack_.size() - begin) * sample / fan_samples];
            if (face & settled) continue;
            for (const VertexIndex vertex : triangles_[face]) {
                if (!is_hub_[vertex]) continue;
                const auto in_fan = [&](FaceIndex other) {
                    return !(other & settled) && has_no_end_inside(other, vertex, cell);
                };
                const auto count = static_cast<std::size_t>(
                    std::count_if(stack_.begin() + static_cast<std::ptrdiff_t>(begin), stack_.end(), in_fan));
                if (count < least_settled) continue;
                visit_chosen(cell, begin, PairTask::Kind::visit_fan, in_fan);
                for (std::size_t i = begin; i < stack_.size(); ++i)
                    if (in_fan(stack_[i])) stack_[i] |= settled;
                settled_facets += count;
            }
        }
        return settled_facets;
    }

    /// Is `vertex` a vertex of the facet, whose side opposite to it stays out of the cell?
    bool has_no_end_inside(FaceIndex face, VertexIndex vertex, const FacetCell& cell) const {
        const auto [a, b, c] = triangles_[face];
        if (vertex == a) return !enters(points_[b], points_[c], cell.low, cell.side);
        if (vertex == b) return !enters(points_[c], points_[a], cell.low, cell.side);
        if (vertex == c) return !enters(points_[a], points_[b], cell.low, cell.side);
        return false;
    }

    std::span<const Point> points_;
    std::span<const Triangle> triangles_;
    const std::vector<bool>& is_hub_;
    const PairVisitor& visit_pairs_;
    std::vector<PairTask>* tasks_ = nullptr;  ///< where tasks go instead of visits
    const Context* context_ = nullptr;        ///< asked while tasks are made; visits are short
    std::vector<FaceIndex> stack_, chosen_;
    std::vector<std::uint8_t> masks_;
};

struct Doubled {
    std::int64_t x, y, z;
    std::int64_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// Twice the vector from the cube's centre, so that half sides stay integers: |coordinate| < 2^28.
Doubled from_centre(Point p, const std::array<std::int32_t, 3>& low, std::int32_t side) {
    return {2 * (std::int64_t{p.x} - low[0]) - side, 2 * (std::int64_t{p.y} - low[1]) - side,
            2 * (std::int64_t{p.z} - low[2]) - side};
}

/// Do the values lie on one side of [−radius, radius]?
bool apart(std::int64_t a, std::int64_t b, std::int64_t radius) {
    return std::min(a, b) > radius || std::max(a, b) < -radius;
}

}  // namespace

std::vector<PairTask> make_pair_tasks(const PairSearch& search, const Context& context) {
    std::vector<FaceIndex> faces;
    for (FaceIndex face = 0; face < search.triangles.size(); ++face) {
        const auto [a, b, c] = search.triangles[face];
        if (a != b && b != c && c != a) faces.push_back(face);
    }
    const PairVisitor nobody;
    return PairDescent(search, nobody).run_to_tasks(std::move(faces), context);
}

void for_near_pairs(const PairTask& task, const PairSearch& search, const PairVisitor& visit) {
    PairDescent(search, visit).run(task);
}

bool may_enter(const std::array<exact::Point, 3>& facet, const std::array<std::int32_t, 3>& low,
               std::int32_t side) {
    const std::array<Doubled, 3> p{from_centre(facet[0], low, side), from_centre(facet[1], low, side),
                                   from_centre(facet[2], low, side)};
    for (int axis = 0; axis < 3; ++axis)
        if (std::min({p[0][axis], p[1][axis], p[2][axis]}) > side ||
            std::max({p[0][axis], p[1][axis], p[2][axis]}) < -side)
            return false;
    // Cross products of the edges with the coordinate axes: 28 bits · 28 bits, two of them, fit int64.
    for (std::size_t i = 0; i < 3; ++i) {
        const Doubled a = p[i], b = p[(i + 1) % 3], c = p[(i + 2) % 3];
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const std::int64_t eu = b[u] - a[u], ev = b[v] - a[v];
            const std::int64_t radius = side * (std::abs(eu) + std::abs(ev));
            if (apart(eu * a[v] - ev * a[u], eu * c[v] - ev * c[u], radius)) return false;
        }
    }
    // The plane in doubles. Normal components are sums of two products below 2^57 each, their product with a
    // coordinate is below 2^86; the rounding of all steps together stays below 2^-49 of the sum of magnitudes.
    const Doubled e{p[1].x - p[0].x, p[1].y - p[0].y, p[1].z - p[0].z};
    const Doubled f{p[2].x - p[0].x, p[2].y - p[0].y, p[2].z - p[0].z};
    const auto nx = static_cast<double>(e.y * f.z - e.z * f.y);
    const auto ny = static_cast<double>(e.z * f.x - e.x * f.z);
    const auto nz = static_cast<double>(e.x * f.y - e.y * f.x);
    const double tx = nx * static_cast<double>(p[0].x), ty = ny * static_cast<double>(p[0].y),
                 tz = nz * static_cast<double>(p[0].z);
    const double radius = static_cast<double>(side) * (std::fabs(nx) + std::fabs(ny) + std::fabs(nz));
    const double error = 0x1p-49 * (std::fabs(tx) + std::fabs(ty) + std::fabs(tz) + radius);
    return std::fabs(tx + ty + tz) <= radius + error;
}

bool enters(exact::Point p, exact::Point q, const std::array<std::int32_t, 3>& low, std::int32_t side) {
    const Doubled a = from_centre(p, low, side), b = from_centre(q, low, side);
    for (int axis = 0; axis < 3; ++axis)
        if (apart(a[axis], b[axis], side)) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const std::int64_t eu = b[u] - a[u], ev = b[v] - a[v];
        const std::int64_t radius = side * (std::abs(eu) + std::abs(ev));
        if (std::abs(eu * a[v] - ev * a[u]) > radius) return false;
    }
    return true;
}

}  // namespace octavo::mesh
