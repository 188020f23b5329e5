// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/select_planes.hpp>

namespace octavo::bp_octree {
namespace {

constexpr double cell_volume = Polytope::cell_side * Polytope::cell_side * Polytope::cell_side;

struct Candidate {
    double gain;
    Direction direction;
    std::int32_t reach;
    std::size_t measured_at;  ///< number of planes taken when `gain` was right
};

bool less_gain(const Candidate& a, const Candidate& b) { return a.gain < b.gain; }

/// With many points, those that are extreme in some of 578 directions stand for all while planes are compared;
/// what is taken is measured with all of them.
constexpr std::size_t many_points = 2000;

PointSet extreme_points(const PointSet& content) {
    std::vector<std::size_t> extreme;
    constexpr int grid = 12;
    for (int a = -grid; a <= grid; ++a)
        for (int b = -grid; b <= grid; ++b) {
            const int rest = grid - magnitude(a) - magnitude(b);
            if (rest < 0) continue;
            for (const int c : {rest, -rest}) {
                extreme.push_back(content.farthest(nearest_direction(a, b, c)));
                if (rest == 0) break;
            }
        }
    std::sort(extreme.begin(), extreme.end());
    extreme.erase(std::unique(extreme.begin(), extreme.end()), extreme.end());
    PointSet points;
    for (const std::size_t i : extreme) points.add(content, i);
    return points;
}

class Selection {
  public:
    Selection(const PointSet& content, const SelectionOptions& options, Polytope& envelope)
        : all_(content), options_(options), envelope_(envelope) {
        if (content.size() > many_points) extreme_ = extreme_points(content);
    }

    void propose(Direction direction) {
        Candidate candidate = measured(direction);
        if (candidate.gain > least_volume()) heap_.push_back(candidate);
    }

    std::vector<BoundingPlane> run() {
        std::vector<BoundingPlane> planes;
        std::make_heap(heap_.begin(), heap_.end(), less_gain);
        int rounds = options_.vertex_rounds;
        while (planes.size() < options_.most_planes) {
            if (heap_.empty()) {
                if (rounds-- <= 0) break;
                propose_at_vertices();
                std::make_heap(heap_.begin(), heap_.end(), less_gain);
                if (heap_.empty()) break;
            }
            std::pop_heap(heap_.begin(), heap_.end(), less_gain);
            Candidate best = heap_.back();
            heap_.pop_back();
            if (best.measured_at != taken_) {
                best.gain = gain_of(best.direction, best.reach);
                best.measured_at = taken_;
                if (best.gain > least_volume()) {
                    heap_.push_back(best);
                    std::push_heap(heap_.begin(), heap_.end(), less_gain);
                }
                continue;
            }
            const Candidate refined = refine(best);
            const BoundingPlane plane =
                BoundingPlane::at(refined.direction, reach_of_all(refined.direction, refined.reach));
            const bool clipped = envelope_.clip(plane.half_space(), Polytope::cell_faces);
            if (!clipped) continue;
            planes.push_back(plane);
            ++taken_;
            if (envelope_.empty()) break;
            if (!(refined.direction == best.direction)) {
                // The direction it came from may still have something to cut.
                heap_.push_back(best);
                std::push_heap(heap_.begin(), heap_.end(), less_gain);
            }
        }
        return planes;
    }

  private:
    double least_volume() const { return options_.least_gain * cell_volume; }
    const PointSet& points() const { return extreme_.empty() ? all_ : extreme_; }
    std::int32_t reach_of_all(Direction u, std::int32_t reach) const {
        return extreme_.empty() ? reach : all_.support(u);
    }
    double gain_of(Direction u, std::int32_t reach) const {
        return envelope_.removed_volume(BoundingPlane::at(u, reach).half_space());
    }
    Candidate measured(Direction u) const {
        const std::int32_t reach = points().support(u);
        return {gain_of(u, reach), u, reach, taken_};
    }

    /// The directions that part the envelope's vertices from the content: what no normal of a face points to.
    void propose_at_vertices() {
        const std::vector<Vec3> vertices = envelope_.vertices();
        for (const Vec3& vertex : vertices) propose(parting_direction(vertex));
    }

    /// About the direction from the nearest point of the content's hull to `outside`, by the conditional gradient
    /// method (M. Frank and P. Wolfe, 1956): some steps, for the gain is measured anyway.
    Direction parting_direction(Vec3 outside) const {
        constexpr int steps = 8;
        const Vec3 middle = points().point(points().size() / 2);
        Vec3 away = outside - middle;
        Vec3 nearest = points().point(points().farthest(nearest_direction(away.x, away.y, away.z)));
        for (int i = 0; i < steps; ++i) {
            away = outside - nearest;
            const Vec3 ahead = points().point(points().farthest(nearest_direction(away.x, away.y, away.z)));
            const Vec3 step = ahead - nearest;
            const double gain = dot(away, step), square = dot(step, step);
            if (!(gain > 0) || square == 0) break;
            nearest = nearest + std::min(1.0, gain / square) * step;
        }
        away = outside - nearest;
        return nearest_direction(away.x, away.y, away.z);
    }

    /// Uphill from a candidate in steps of 16, 8, 4 … of the 127 along each tangential direction.
    Candidate refine(Candidate best) const {
        int step = 16;
        for (int i = 0; i < options_.refine_steps; ++i, step /= 2) {
            const Direction centre = best.direction;
            for (int k = 0; k < 6; ++k) {
                // The three axes both ways span all tangential moves; the octahedron's length is restored.
                std::array<double, 3> moved{static_cast<double>(centre.a), static_cast<double>(centre.b),
                                            static_cast<double>(centre.c)};
                moved[static_cast<std::size_t>(k / 2)] += k % 2 ? -step : step;
                const Candidate other = measured(nearest_direction(moved[0], moved[1], moved[2]));
                if (other.gain > best.gain) best = other;
            }
        }
        return best;
    }

    const PointSet& all_;
    PointSet extreme_;
    const SelectionOptions& options_;
    Polytope& envelope_;
    std::vector<Candidate> heap_;
    std::size_t taken_ = 0;
};

/// The mean normals by bins of direction, 16 × 16 on the unfolded octahedron.
std::vector<Direction> mean_directions(std::span<const Vec3> normals) {
    constexpr int bins = 16;
    std::array<Vec3, bins * bins> sums{};
    std::array<bool, bins * bins> used{};
    for (const Vec3& n : normals) {
        if (n == Vec3{}) continue;
        const DirectionCode code = code_of(nearest_direction(n.x, n.y, n.z));
        const std::size_t bin =
            static_cast<std::size_t>(code / 255 * bins / 255 * bins + code % 255 * bins / 255);
        sums[bin] = sums[bin] + n;
        used[bin] = true;
    }
    std::vector<Direction> directions;
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (used[i] && !(sums[i] == Vec3{}))
            directions.push_back(nearest_direction(sums[i].x, sums[i].y, sums[i].z));
    return directions;
}

}  // namespace

std::vector<BoundingPlane> select_planes(const PointSet& content, std::span<const Vec3> normals,
                                         const SelectionOptions& options, Polytope& envelope) {
    if (content.empty() || envelope.empty()) return {};
    Selection selection(content, options, envelope);
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (x != 0 || y != 0 || z != 0) selection.propose(nearest_direction(x, y, z));
    for (const Direction& direction : mean_directions(normals)) selection.propose(direction);
    return selection.run();
}

}  // namespace octavo::bp_octree
