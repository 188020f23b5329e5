// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include <octavo/hexmesh/size_field.hpp>

namespace octavo::hexmesh {
namespace {

using octree::max_level;

/// Two facets face away from each other when their normals differ by more than this; walls and gaps of parts taper,
/// dihedral angles of ordinary edges stay below it.
constexpr double opposite_cosine = -0.866;  // 150 degrees

Error bad(std::string sentence) { return {ErrorCode::bad_input, std::move(sentence), {}}; }

/// The level of the largest cells whose side is at most `length`; 0 for length 0, which asks for nothing.
Result<int> level_of(double length, const std::string& what, const exact::Lattice& lattice) {
    if (!(length >= 0) || !std::isfinite(length))
        return bad(what + " must be a length, 0 or more, and finite");
    if (length == 0) return 0;
    const double finest = std::ldexp(lattice.unit(), exact::coordinate_bits - max_level);
    if (length < finest) {
        std::array<char, 32> side;
        std::snprintf(side.data(), side.size(), "%g", finest);
        return Error{ErrorCode::limit,
                     what + " is smaller than the smallest cells possible here, whose side is " + side.data(),
                     {}};
    }
    int level = 0;
    while (std::ldexp(lattice.unit(), exact::coordinate_bits - level) > length) ++level;
    return level;
}

Vec3 normal_direction(const classic::Facet& facet) {
    const classic::Normal n = normal_of(facet);
    const Vec3 v{static_cast<double>(n.x), static_cast<double>(n.y), static_cast<double>(n.z)};
    return (1 / length(v)) * v;
}

/// Whether two of the directions have a smaller cosine, that is, a wider angle between them; in whatever order they
/// come.
///
/// Two directions are no wider apart than their angles to a third, here to the mean of all, say together. So only those
/// few are compared that lean away from it far enough, and none where the surface is flat for its size.
bool are_some_wider_apart(std::span<const Vec3> directions, double cosine) {
    constexpr double rounding = 1e-9;  // of the angles, which only choose what is compared
    const double widest = std::acos(cosine) - rounding;
    Vec3 sum;
    for (const Vec3& direction : directions) sum = sum + direction;
    if (length(sum) == 0) sum = directions[0];
    const Vec3 mean = (1 / length(sum)) * sum;
    std::vector<std::pair<double, std::size_t>> leaning;
    double most = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double angle = std::acos(std::clamp(dot(mean, directions[i]), -1.0, 1.0));
        leaning.push_back({angle, i});
        most = std::max(most, angle);
    }
    std::erase_if(leaning, [&](const auto& entry) { return entry.first + most < widest; });
    std::sort(leaning.begin(), leaning.end(), std::greater<>());
    for (std::size_t i = 0; i < leaning.size(); ++i)
        for (std::size_t k = 0; k < i && leaning[k].first + leaning[i].first >= widest; ++k)
            if (dot(directions[leaning[k].second], directions[leaning[i].second]) < cosine) return true;
    return false;
}

}  // namespace

Result<exact::Lattice> grid_lattice(const Box3& content) {
    Result<exact::Lattice> fitted = exact::Lattice::fit(content);
    if (!fitted) return fitted;
    constexpr int aligned_bits = exact::coordinate_bits - 2;
    // With units four times as large the content spans a quarter of the universe, and alignment moves it by less than
    // another; its origin is within half of the range of origins.
    for (int exponent = fitted->exponent(); exponent <= fitted->exponent() + 2; ++exponent) {
        std::array<std::int64_t, 3> origin{};
        bool fits = true;
        for (int axis = 0; axis < 3; ++axis) {
            // One unit stays free on either side.
            const double low = std::floor(std::ldexp(content.low[axis], -exponent)) - 1;
            const double high = std::ceil(std::ldexp(content.high[axis], -exponent)) + 1;
            const double corner = std::ldexp(std::floor(std::ldexp(low, -aligned_bits)), aligned_bits);
            fits = fits && high - corner < exact::universe_side && std::fabs(corner) <= 0x1p53;
            if (fits) origin[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(corner);
        }
        if (!fits) continue;
        // Beside the last origin that there is, only larger units are left.
        Result<exact::Lattice> lattice = exact::Lattice::from_parts(exponent, origin);
        if (lattice) return lattice;
    }
    return Error{ErrorCode::limit,
                 "the content is too large for a lattice whose cells lie at multiples of their side",
                 {}};
}

Result<SizeField> SizeField::from(const Options& options, std::size_t solids, const Box3& content,
                                  const exact::Lattice& lattice) {
    SizeField field;
    const Vec3 extents = content.extents();
    if (options.level < 0 || options.level > max_level) return bad("the level must be 0 to 21");
    const double longest = std::max({extents.x, extents.y, extents.z});
    const double precision = options.precision != 0 ? options.precision : std::ldexp(longest, -options.level);
    Error error;
    bool failed = false;
    const auto level = [&](double length, const std::string& what) {
        const Result<int> result = level_of(length, what, lattice);
        if (!result && !failed) error = result.error(), failed = true;
        const int value = result ? *result : 0;
        field.deepest_ = std::max(field.deepest_, value);
        return value;
    };

    field.largest_level_ = level(options.largest, "the largest cell");
    const std::string general = options.precision != 0
                                    ? "the precision"
                                    : "the size of cells of level " + std::to_string(options.level);
    field.surface_.assign(solids, level(precision, general));
    field.interior_.assign(solids, 0);
    for (const SolidSize& size : options.solids) {
        if (size.solid >= solids)
            return bad("a size is given for solid " + std::to_string(size.solid) + ", but there are only " +
                       std::to_string(solids));
        if (size.surface != 0)
            field.surface_[size.solid] = level(size.surface, "the surface size of a solid");
        field.interior_[size.solid] = level(size.interior, "the interior size of a solid");
    }
    const exact::Point last{exact::universe_side - 1, exact::universe_side - 1, exact::universe_side - 1};
    const Vec3 low = lattice.to_world({0, 0, 0}), high = lattice.to_world(last);
    for (const BoxSize& box : options.boxes) {
        if (box.box.empty()) return bad("a box with its own size is empty");
        const int box_level = level(box.size, "the size in a box");
        Box3 cut = box.box;
        for (int axis = 0; axis < 3; ++axis) {
            cut.low[axis] = std::clamp(cut.low[axis], low[axis], high[axis]);
            cut.high[axis] = std::clamp(cut.high[axis], low[axis], high[axis]);
        }
        field.boxes_.push_back({lattice.snap(cut.low), lattice.snap(cut.high), box_level});
    }
    field.curvature_level_ = level(options.curvature.smallest, "the smallest cell for curvature");
    field.proximity_level_ = level(options.proximity.smallest, "the smallest cell for proximity");
    if (!(options.curvature.angle_degrees > 0 && options.curvature.angle_degrees <= 180))
        return bad("the angle of curvature must be more than 0 and at most 180 degrees");
    field.least_cosine_ = std::cos(options.curvature.angle_degrees * std::numbers::pi / 180);
    if (failed) return error;
    return field;
}

int SizeField::level_in(const octree::Cell& cell) const {
    int level = largest_level_;
    const exact::Point high = cell.high();
    for (const Box& box : boxes_) {
        bool meets = true;
        for (int axis = 0; axis < 3; ++axis)
            meets = meets && box.low[axis] < high[axis] && cell.low[axis] < box.high[axis];
        if (meets) level = std::max(level, box.level);
    }
    return level;
}

bool SizeField::is_too_coarse_for(int level, std::span<const classic::Facet> facets,
                                  std::span<const std::uint32_t> list) const {
    const bool bends = level < curvature_level_, faces = level < proximity_level_;
    if (list.size() < 2 || !(bends || faces)) return false;
    std::vector<Vec3> directions;
    directions.reserve(list.size());
    for (const std::uint32_t facet : list) directions.push_back(normal_direction(facets[facet]));
    std::sort(directions.begin(), directions.end(),
              [](const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); });
    directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
    // What bends far enough for either asks no more.
    const double cosine = bends && faces ? std::max(least_cosine_, opposite_cosine)
                          : bends        ? least_cosine_
                                         : opposite_cosine;
    return are_some_wider_apart(directions, cosine);
}

}  // namespace octavo::hexmesh
