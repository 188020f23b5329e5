// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include <octavo/base/any_scale.hpp>
#include <octavo/csg/compile_leaf.hpp>

namespace octavo::csg {
namespace {

using Matrix = std::array<std::array<long double, 3>, 3>;

/// The inverse of the linear part, in long double, whose range no product of doubles leaves. Its rounding, 2^-63 over
/// the ratio of is_singular, is less than the lattice can tell but for bodies thinner than a thousandth of its unit.
Matrix inverse(const Affine& map) {
    const auto& m = map.m;
    const auto minor = [&](std::size_t r, std::size_t c) {
        const std::size_t r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return static_cast<long double>(m[r1][c1]) * m[r2][c2] -
               static_cast<long double>(m[r1][c2]) * m[r2][c1];
    };
    long double determinant = 0;
    for (std::size_t c = 0; c < 3; ++c) determinant += m[0][c] * minor(0, c);
    Matrix result;
    for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c) result[r][c] = minor(c, r) / determinant;
    return result;
}

/// Rows of round bodies that are larger make a body thinner than 2^-199 lattice units, and products that are no
/// doubles.
constexpr double largest_magnitude = 0x1p200;

Vec3 column(const Affine& map, std::size_t c) { return {map.m[0][c], map.m[1][c], map.m[2][c]}; }

/// Whether each axis goes to an axis, so that a box stays a box.
bool keeps_axes(const Affine& map) {
    for (std::size_t r = 0; r < 3; ++r) {
        int entries = 0;
        for (std::size_t c = 0; c < 3; ++c) entries += map.m[r][c] != 0;
        if (entries != 1) return false;
    }
    return true;
}

/// The edges of a convex mesh, to find its farthest vertex in a direction by walking uphill.
class Neighbours {
  public:
    explicit Neighbours(const mesh::Mesh& mesh)
        : begin_(mesh.vertices.size() + 1), to_(3 * mesh.triangles.size()) {
        for (const mesh::Triangle& t : mesh.triangles)
            for (const mesh::VertexIndex v : t) ++begin_[v + 1];
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (const mesh::Triangle& t : mesh.triangles)
            for (std::size_t i = 0; i < 3; ++i) to_[next[t[i]]++] = t[(i + 1) % 3];
    }

    mesh::VertexIndex farthest(const std::vector<Vec3>& points, Vec3 direction,
                               mesh::VertexIndex start) const {
        mesh::VertexIndex best = start;
        for (bool moved = true; moved;) {
            moved = false;
            const mesh::VertexIndex here = best;
            for (std::uint32_t i = begin_[here]; i < begin_[here + 1]; ++i)
                if (dot(direction, points[to_[i]]) > dot(direction, points[best]))
                    best = to_[i], moved = true;
        }
        return best;
    }

  private:
    std::vector<std::uint32_t> begin_, to_;
};

}  // namespace

class LeafCompiler::Primitives {
  public:
    using Compiled = CompiledLeaf;

    explicit Primitives(Program& program) : program_(program), units_(1 / program.lattice.unit()) {}

    Result<Compiled> compile(const PlacedPrimitive& placed, const Box3& bounds) {
        bounds_ = bounds;
        if (!std::holds_alternative<HalfSpace>(*placed.primitive) &&
            !(is_finite(to_lattice(bounds.low)) && is_finite(to_lattice(bounds.high))))
            return too_far();
        return std::visit([&](const auto& primitive) { return put(primitive, placed.place); },
                          *placed.primitive);
    }

  private:
    static Error too_far() {
        return {ErrorCode::limit,
                "a primitive reaches farther than a double can hold, in units of the lattice",
                {}};
    }

    Vec3 to_lattice(Vec3 world) const {
        const exact::Lattice& lattice = program_.lattice;
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis)
            p[axis] =
                world[axis] * units_ - static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]);
        return p;
    }

    static std::int32_t clamped(double value) {
        return static_cast<std::int32_t>(std::clamp(value, 0.0, static_cast<double>(exact::universe_side)));
    }

    /// A leaf whose box holds all lattice points that the primitive's bounds can reach, with a unit to spare for what
    /// snapping moves. Empty when that misses the universe.
    std::optional<Leaf> leaf_within(LeafKind kind) const {
        Leaf leaf;
        leaf.kind = kind;
        const Vec3 low = to_lattice(bounds_.low), high = to_lattice(bounds_.high);
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            leaf.low[a] = clamped(std::floor(low[axis]) - 1);
            leaf.high[a] = clamped(std::ceil(high[axis]) + 1);
            if (leaf.low[a] >= leaf.high[a]) return {};
        }
        return leaf;
    }

    Compiled add(const Leaf& leaf) {
        program_.leaves.push_back(leaf);
        return {static_cast<std::uint32_t>(program_.leaves.size() - 1), false};
    }

    Result<Compiled> put(const Everything&, const Affine&) { return Compiled{{}, true}; }

    Result<Compiled> put(const Cuboid& cuboid, const Affine& place) {
        const Vec3 low = to_lattice(place(cuboid.low)), high = to_lattice(place(cuboid.high));
        if (keeps_axes(place)) {
            Leaf leaf;
            leaf.kind = LeafKind::box;
            for (int axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<std::size_t>(axis);
                leaf.low[a] = clamped(std::nearbyint(std::min(low[axis], high[axis])));
                leaf.high[a] = clamped(std::nearbyint(std::max(low[axis], high[axis])));
                if (leaf.low[a] >= leaf.high[a]) return Compiled{};
            }
            return add(leaf);
        }
        begin_convex();
        const bool mirrors = place.mirrors();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            Vec3 normal = cross_direction(column(place, (axis + 1) % 3), column(place, (axis + 2) % 3));
            if (mirrors) normal = -normal;
            add_plane(normal, low);
            add_plane(-normal, high);
        }
        return end_convex();
    }

    /// By coefficients: a point on the plane may be farther away than doubles reach, although the plane is near.
    Result<Compiled> put(const HalfSpace& half_space, const Affine& place) {
        // The image of the normal, by the inverse transpose, and the offset from the lattice's origin.
        const Matrix inverted = inverse(place);
        std::array<long double, 3> inward{};
        long double offset = half_space.offset, of_origin = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            for (std::size_t r = 0; r < 3; ++r)
                inward[c] -= inverted[r][c] * half_space.normal[static_cast<int>(r)];
            offset -= inward[c] * place.m[c][3];
            of_origin += inward[c] * static_cast<long double>(program_.lattice.origin()[c]);
        }
        begin_convex();
        add(snap_plane(inward, offset / program_.lattice.unit() + of_origin));
        return end_convex();
    }

    Result<Compiled> put(const Ball& ball, const Affine& place) {
        begin_convex();
        SecondOrderCone cone = local_frame(place, {}, 1 / static_cast<long double>(ball.radius), 3);
        cone.row[3][3] = 1;
        add_cone(cone);
        return end_convex();
    }

    Result<Compiled> put(const Frustum& frustum, const Affine& place) {
        begin_convex();
        const long double largest = std::max(frustum.bottom, frustum.top);
        const Vec3 middle{0, 0, 0.5 * frustum.low + 0.5 * frustum.high};
        SecondOrderCone cone = local_frame(place, middle, 1 / largest, 3);
        // The third row, along the axis, becomes the radius there.
        const long double change = (static_cast<long double>(frustum.top) - frustum.bottom) /
                                   (static_cast<long double>(frustum.high) - frustum.low);
        for (std::size_t c = 0; c < 4; ++c)
            cone.row[3][c] = static_cast<double>(change * static_cast<long double>(cone.row[2][c]));
        cone.row[3][3] +=
            static_cast<double>(0.5L * (static_cast<long double>(frustum.top) + frustum.bottom) / largest);
        cone.row[2] = {};
        add_cone(cone);
        Vec3 normal = cross_direction(column(place, 0), column(place, 1));
        if (place.mirrors()) normal = -normal;
        add_plane(normal, to_lattice(place({0, 0, frustum.low})));
        add_plane(-normal, to_lattice(place({0, 0, frustum.high})));
        return end_convex();
    }

    Result<Compiled> put(const Torus& torus, const Affine& place) {
        std::optional<Leaf> leaf = leaf_within(LeafKind::torus);
        if (!leaf) return Compiled{};
        // With radii near one, whose squares are doubles.
        const int exponent = std::ilogb(std::max(torus.major, torus.minor));
        const SecondOrderCone frame = local_frame(place, {}, std::ldexp(1.0L, -exponent), 3);
        LatticeTorus on_lattice;
        for (std::size_t r = 0; r < 3; ++r) on_lattice.row[r] = frame.row[r];
        on_lattice.origin = frame.origin;
        on_lattice.major = std::ldexp(torus.major, -exponent);
        on_lattice.minor = std::ldexp(torus.minor, -exponent);
        on_lattice.finish();
        if (!(on_lattice.magnitude <= largest_magnitude)) return Compiled{};
        leaf->first = static_cast<std::uint32_t>(program_.tori.size());
        program_.tori.push_back(on_lattice);
        return add(*leaf);
    }

    Result<Compiled> put(const Polyhedron& polyhedron, const Affine& place) {
        if (polyhedron.convexity == Convexity::convex) return put_convex(polyhedron, place);
        // One mesh in one place is one leaf, however often it occurs: its occurrences then meet without a trace.
        const auto [known, fresh] = meshes_.try_emplace({polyhedron.mesh.get(), place.m});
        if (!fresh) return known->second;
        Result<Compiled> compiled = put_mesh(polyhedron, place);
        if (compiled) known->second = *compiled;
        return compiled;
    }

    Result<Compiled> put_mesh(const Polyhedron& polyhedron, const Affine& place) {
        std::optional<Leaf> leaf = leaf_within(LeafKind::polyhedron);
        if (!leaf) return Compiled{};
        Result<LatticePolyhedron> snapped = snap_polyhedron(*polyhedron.mesh, place, program_.lattice);
        if (!snapped) return snapped.error();
        if (snapped->triangles.empty()) return Compiled{};
        leaf->first = static_cast<std::uint32_t>(program_.polyhedra.size());
        program_.polyhedra.push_back(std::move(*snapped));
        return add(*leaf);
    }

    /// The half spaces of the facets; those in one plane become one.
    Result<Compiled> put_convex(const Polyhedron& polyhedron, const Affine& place) {
        begin_convex();
        const mesh::Mesh& mesh = *polyhedron.mesh;
        const double turn = place.mirrors() ? -1 : 1;
        std::vector<Vec3> points;
        points.reserve(mesh.vertices.size());
        for (const Vec3& vertex : mesh.vertices) {
            points.push_back(place(vertex));
            if (!is_finite(to_lattice(points.back()))) return too_far();
        }
        const Neighbours neighbours(mesh);
        for (const mesh::Triangle& triangle : mesh.triangles) {
            const Vec3 a = points[triangle[0]], b = points[triangle[1]], c = points[triangle[2]];
            const Vec3 inward = -turn * cross_direction(b - a, c - a);
            if (inward == Vec3{}) continue;
            // The plane is moved out to the farthest vertex: the normal of a sliver may point anywhere near its
            // true direction, and a plane that leaves all vertices inside cannot cut anything off.
            add_plane(inward, to_lattice(points[neighbours.farthest(points, -inward, triangle[0])]));
        }
        merge_planes();
        if (const std::optional<std::uint32_t> known = equal_body()) {
            forget_body();
            return Compiled{*known, false};
        }
        const std::uint64_t hash = hash_of_planes();
        const Compiled compiled = end_convex();
        if (compiled.leaf) bodies_.emplace(hash, *compiled.leaf);
        return compiled;
    }

    std::span<const LatticePlane> present_planes() const {
        return std::span(program_.planes).subspan(first_plane_);
    }
    std::uint64_t hash_of_planes() const {
        std::uint64_t hash = 0;
        const auto mix = [&](std::int64_t number) {
            hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9E3779B97F4A7C15;
            hash ^= hash >> 32;
        };
        for (const LatticePlane& plane : present_planes()) {
            for (const std::int64_t component : plane.normal) mix(component);
            mix(plane.offset);
        }
        return hash;
    }
    /// A convex polyhedron with the planes of the present one. Two such are one leaf, so that they meet without a trace
    /// however many facets they have.
    std::optional<std::uint32_t> equal_body() const {
        const std::span<const LatticePlane> planes = present_planes();
        const auto [begin, end] = bodies_.equal_range(hash_of_planes());
        for (auto candidate = begin; candidate != end; ++candidate) {
            const Leaf& leaf = program_.leaves[candidate->second];
            const LatticePlane* const first = program_.planes.data() + program_.constraints[leaf.first];
            if (leaf.count == planes.size() && std::equal(planes.begin(), planes.end(), first))
                return candidate->second;
        }
        return {};
    }

    /// Rows that take lattice differences to `origin` to the primitive's own frame about `middle`, scaled.
    SecondOrderCone local_frame(const Affine& place, Vec3 middle, long double scale, std::size_t rows) const {
        SecondOrderCone cone;
        const Matrix inverted = inverse(place);
        const Vec3 centre = to_lattice(place(middle));
        const long double factor = scale * program_.lattice.unit();
        for (std::size_t axis = 0; axis < 3; ++axis)
            cone.origin[axis] = std::nearbyint(centre[static_cast<int>(axis)]);
        for (std::size_t r = 0; r < rows; ++r) {
            long double shift = 0;
            for (std::size_t c = 0; c < 3; ++c) {
                cone.row[r][c] = static_cast<double>(factor * inverted[r][c]);
                shift -= factor * inverted[r][c] *
                         (static_cast<long double>(centre[static_cast<int>(c)]) - cone.origin[c]);
            }
            cone.row[r][3] = static_cast<double>(shift);
        }
        return cone;
    }

    void begin_convex() {
        first_constraint_ = program_.constraints.size();
        first_plane_ = program_.planes.size();
        empty_ = false;
    }
    void add_plane(Vec3 inward, Vec3 through) { add(snap_plane(inward, through)); }
    void add(const SnappedPlane& snapped) {
        if (!snapped.plane) {
            empty_ |= !snapped.whole;
            return;
        }
        program_.constraints.push_back(static_cast<std::uint32_t>(program_.planes.size()));
        program_.planes.push_back(*snapped.plane);
    }
    void add_cone(SecondOrderCone& cone) {
        cone.finish();
        if (!(cone.magnitude <= largest_magnitude)) {
            empty_ = true;
            return;
        }
        program_.constraints.push_back(static_cast<std::uint32_t>(program_.cones.size()) |
                                       ConstraintId::cone_bit);
        program_.cones.push_back(cone);
        program_.quadrics.emplace_back(cone);
    }
    /// Equal planes of the present body, kept once.
    void merge_planes() {
        auto begin = program_.planes.begin() + static_cast<std::ptrdiff_t>(first_plane_);
        const auto key = [](const LatticePlane& p) { return std::tie(p.normal, p.offset); };
        std::sort(begin, program_.planes.end(),
                  [&](const LatticePlane& a, const LatticePlane& b) { return key(a) < key(b); });
        program_.planes.erase(std::unique(begin, program_.planes.end()), program_.planes.end());
        program_.constraints.resize(first_constraint_);
        for (std::size_t i = first_plane_; i < program_.planes.size(); ++i)
            program_.constraints.push_back(static_cast<std::uint32_t>(i));
    }
    void forget_body() {
        program_.constraints.resize(first_constraint_);
        program_.planes.resize(first_plane_);
    }
    Compiled end_convex() {
        const std::optional<Leaf> leaf = leaf_within(LeafKind::convex);
        const std::size_t count = program_.constraints.size() - first_constraint_;
        if (empty_ || !leaf) {
            forget_body();
            return {};
        }
        if (count == 0) return {{}, true};
        Leaf convex = *leaf;
        convex.first = static_cast<std::uint32_t>(first_constraint_);
        convex.count = static_cast<std::uint32_t>(count);
        return add(convex);
    }

    Program& program_;
    double units_;  // in a length of one; a power of two
    std::map<std::pair<const mesh::Mesh*, std::array<std::array<double, 4>, 3>>, Compiled> meshes_;
    std::unordered_multimap<std::uint64_t, std::uint32_t>
        bodies_;   // convex polyhedra, by the hash of their planes
    Box3 bounds_;  // of the present primitive, in the world
    std::size_t first_constraint_ = 0, first_plane_ = 0;
    bool empty_ = false;
};

LeafCompiler::LeafCompiler(Program& program) : primitives_(std::make_unique<Primitives>(program)) {}

LeafCompiler::~LeafCompiler() = default;

Result<CompiledLeaf> LeafCompiler::compile(const PlacedPrimitive& placed, const Box3& bounds) {
    return primitives_->compile(placed, bounds);
}

}  // namespace octavo::csg
