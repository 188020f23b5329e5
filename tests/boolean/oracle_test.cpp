// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <memory>
#include <numeric>

#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>

#include "effort.hpp"
#include "solids.hpp"

// Random expressions over random bodies on a grid, which touch and coincide, against volumes found without the code
// under test: by rational clipping of convex bodies, and by counting cells.

namespace octavo::boolean {
namespace {

using tests::Convex;

/// A random expression: as a program, and as a function of which operands hold.
struct RandomProgram {
    Program program;
    std::function<bool(std::uint32_t)> holds;  ///< of a bit per operand
    std::string text;
};

template <class Random>
RandomProgram random_program(Random& random, std::uint32_t operands) {
    struct Node {
        Program::NodeId id;
        std::function<bool(std::uint32_t)> holds;
        std::string text;
    };
    for (;;) {
        RandomProgram result;
        std::vector<Node> nodes;
        for (std::uint32_t k = 0; k < operands; ++k)
            nodes.push_back({result.program.operand(k),
                             [k](std::uint32_t bits) { return (bits >> k & 1) != 0; },
                             std::string(1, static_cast<char>('A' + k))});
        while (nodes.size() > 1) {
            const std::size_t arity = std::uniform_int_distribution<std::size_t>(2, nodes.size())(random);
            std::shuffle(nodes.begin(), nodes.end(), random);
            std::vector<Node> inputs(nodes.end() - static_cast<std::ptrdiff_t>(arity), nodes.end());
            nodes.resize(nodes.size() - arity);
            const int kind = std::uniform_int_distribution<int>(0, 3)(random);
            const Gate gate = kind == 0 ? Gate::any : kind == 3 ? Gate::odd : Gate::all;
            const bool difference = kind == 2;
            std::vector<Program::NodeId> ids;
            const auto negated = std::make_unique<bool[]>(arity);
            std::string text = kind == 0 ? "or(" : kind == 1 ? "and(" : kind == 2 ? "minus(" : "xor(";
            for (std::size_t i = 0; i < arity; ++i) {
                ids.push_back(inputs[i].id);
                negated[i] = difference && i > 0;
                text += (i ? "," : "") + inputs[i].text;
            }
            const Program::NodeId id = result.program.gate(gate, ids, {negated.get(), arity});
            nodes.push_back({id,
                             [inputs, gate, difference](std::uint32_t bits) {
                                 std::size_t count = 0;
                                 for (std::size_t i = 0; i < inputs.size(); ++i)
                                     count += inputs[i].holds(bits) != (difference && i > 0);
                                 return gate == Gate::any   ? count > 0
                                        : gate == Gate::all ? count == inputs.size()
                                                            : count % 2 == 1;
                             },
                             text + ")"});
        }
        result.holds = nodes[0].holds;
        result.text = nodes[0].text;
        return result;
    }
}

/// The volume where an expression holds, from the volumes of all intersections.
tests::Rational expected_volume(const std::vector<Convex>& bodies,
                                const std::function<bool(std::uint32_t)>& holds) {
    const std::uint32_t all = 1u << bodies.size();
    std::vector<tests::Rational> atom(
        all, 0);  // first of the intersection of the bodies in the set, then of exactly those
    for (std::uint32_t set = 1; set < all; ++set) {
        std::vector<tests::HalfSpace> sides;
        for (std::size_t k = 0; k < bodies.size(); ++k)
            if (set >> k & 1) sides.insert(sides.end(), bodies[k].sides.begin(), bodies[k].sides.end());
        atom[set] = tests::exact_volume(sides);
    }
    for (std::size_t k = 0; k < bodies.size(); ++k)
        for (std::uint32_t set = 1; set < all; ++set)
            if (!(set >> k & 1)) atom[set] -= atom[set | 1u << k];
    tests::Rational volume = 0;
    for (std::uint32_t set = 1; set < all; ++set)
        if (holds(set)) volume += atom[set];
    return volume;
}

void expect_exact_volume(const Result<Evaluated>& result, const tests::Rational& volume,
                         const std::string& what) {
    ASSERT_TRUE(result) << what << ": " << result.error().describe();
    EXPECT_EQ(tests::manifold_defect(result->mesh), "") << what;
    EXPECT_EQ(tests::exact_volume(result->mesh), volume) << what;
    EXPECT_EQ(result->report.inverted_facets + result->report.crossing_facets, 0U) << what;
}

std::vector<const mesh::Mesh*> meshes_of(const std::vector<Convex>& bodies) {
    std::vector<const mesh::Mesh*> meshes;
    for (const Convex& body : bodies) meshes.push_back(&body.mesh);
    return meshes;
}

class RandomConvexBodies : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(RandomConvexBodies, GiveTheVolumeThatRationalClippingGives) {
    const auto [count, side] = GetParam();
    const int runs = (count == 2 ? 3000 : 800) * tests::effort();
    Context context;
    context.threads = 1;
    for (int run = 0; run < runs && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run * 1000 + count * 10 + side));
        std::vector<Convex> bodies;
        for (int k = 0; k < count; ++k) {
            const bool repeat = k > 0 && std::uniform_int_distribution<int>(0, 7)(random) == 0;
            bodies.push_back(repeat ? bodies[0] : tests::random_convex(random, side));
        }
        const RandomProgram expression = random_program(random, static_cast<std::uint32_t>(count));
        const tests::Rational volume = expected_volume(bodies, expression.holds);
        const std::string what =
            "run " + std::to_string(run) + " of " + std::to_string(count) + " bodies, " + expression.text;
        for (const Simplify simplify : {Simplify::none, Simplify::coplanar})
            expect_exact_volume(
                evaluate(meshes_of(bodies), expression.program, {.simplify = simplify}, context), volume,
                what + (simplify == Simplify::none ? "" : ", simplified"));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomConvexBodies,
                         testing::Combine(testing::Values(2, 3, 4), testing::Values(2, 3, 5)));

/// Boxes on a grid, as bits of its cells.
class Voxels {
  public:
    static constexpr int side = 6;
    void add(tests::Grid low, tests::Grid high) {
        for (int x = low[0]; x < high[0]; ++x)
            for (int y = low[1]; y < high[1]; ++y)
                for (int z = low[2]; z < high[2]; ++z)
                    cells_[static_cast<std::size_t>((x * side + y) * side + z)] = 1;
    }
    bool at(std::size_t cell) const { return cells_[cell] != 0; }
    static constexpr std::size_t count = side * side * side;

  private:
    std::array<char, count> cells_{};
};

/// Operands of a few boxes each, and an expression over them.
struct BoxScene {
    std::vector<Voxels> voxels;
    std::vector<mesh::Mesh> meshes;
    RandomProgram expression;

    explicit BoxScene(int run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const auto number = [&](int low, int high) {
            return std::uniform_int_distribution<int>(low, high)(random);
        };
        voxels.resize(static_cast<std::size_t>(number(1, 5)));
        for (Voxels& cells : voxels) {
            std::vector<Convex> boxes;
            for (int i = number(1, 4); i > 0; --i) {
                tests::Grid low, high;
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    low[axis] = number(0, Voxels::side - 1);
                    high[axis] = number(low[axis] + 1, Voxels::side);
                }
                boxes.push_back(tests::box(low, high, number(0, 1) == 1));
                cells.add(low, high);
            }
            meshes.push_back(tests::joined(boxes));
        }
        expression = random_program(random, static_cast<std::uint32_t>(voxels.size()));
    }
    /// A bit per operand that holds in the cell; none outside of the grid.
    std::uint32_t bits(tests::Grid cell) const {
        std::uint32_t bits = 0;
        for (const int part : cell)
            if (part < 0 || part >= Voxels::side) return 0;
        const auto index =
            static_cast<std::size_t>((cell[0] * Voxels::side + cell[1]) * Voxels::side + cell[2]);
        for (std::size_t k = 0; k < voxels.size(); ++k)
            bits |= static_cast<std::uint32_t>(voxels[k].at(index)) << k;
        return bits;
    }
    Result<Evaluated> evaluate(const Options& options) const {
        std::vector<const mesh::Mesh*> pointers;
        for (const mesh::Mesh& mesh : meshes) pointers.push_back(&mesh);
        return boolean::evaluate(pointers, expression.program, options);
    }
};

template <class Visit>
void for_each_cell(int low, const Visit& visit) {
    for (int x = low; x < Voxels::side; ++x)
        for (int y = low; y < Voxels::side; ++y)
            for (int z = low; z < Voxels::side; ++z) visit(tests::Grid{x, y, z});
}

TEST(BoxScenes, CountsTheCellsOfOperandsThatAreManyOverlappingBoxes) {
    for (int run = 0; run < 1000 * tests::effort() && !HasFailure(); ++run) {
        const BoxScene scene(run);
        std::size_t volume = 0;
        for_each_cell(0, [&](tests::Grid cell) { volume += scene.expression.holds(scene.bits(cell)); });
        for (const Simplify simplify : {Simplify::none, Simplify::coplanar})
            expect_exact_volume(scene.evaluate({.simplify = simplify}), volume,
                                "run " + std::to_string(run) + ", " + scene.expression.text);
    }
}

/// The solid without its dangling facets, and these.
std::pair<mesh::Mesh, double> split(const Evaluated& evaluated) {
    mesh::Mesh solid = evaluated.mesh;
    const std::size_t facets = solid.triangles.size() - evaluated.report.dangling_facets;
    const double area = tests::area_of(solid, facets);
    solid.triangles.resize(facets);
    std::uint32_t vertices = 0;
    for (const mesh::Triangle& t : solid.triangles)
        vertices = std::max({vertices, t[0] + 1, t[1] + 1, t[2] + 1});
    solid.vertices.resize(vertices);
    return {solid, area};
}

TEST(BoxScenes, KeepsTheFacesOnWhichAnExpressionHoldsAndBesideWhichItDoesNot) {
    std::size_t dangling = 0;
    for (int run = 0; run < 500 * tests::effort() && !HasFailure(); ++run) {
        const BoxScene scene(run);
        const auto holds = [&](std::uint32_t bits) { return scene.expression.holds(bits); };
        std::size_t area = 0, volume = 0;
        for_each_cell(-1, [&](tests::Grid cell) {
            volume += holds(scene.bits(cell));
            for (std::size_t axis = 0; axis < 3; ++axis) {
                tests::Grid next = cell;
                ++next[axis];
                const std::uint32_t here = scene.bits(cell), there = scene.bits(next);
                area += holds(here | there) && !holds(here) && !holds(there);
            }
        });
        for (const Simplify simplify : {Simplify::none, Simplify::coplanar}) {
            const Result<Evaluated> result =
                scene.evaluate({.simplify = simplify, .dangling = Dangling::kept});
            const std::string what = "run " + std::to_string(run) + ", " + scene.expression.text;
            ASSERT_TRUE(result) << what;
            const auto [solid, dangling_area] = split(*result);
            EXPECT_EQ(tests::manifold_defect(solid), "") << what;
            EXPECT_EQ(tests::exact_volume(solid), volume) << what;
            EXPECT_DOUBLE_EQ(dangling_area, static_cast<double>(area)) << what;
            EXPECT_EQ(result->report.closed, area == 0) << what;
        }
        dangling += area > 0;
    }
    EXPECT_GT(dangling, 10u) << "too few of the scenes have dangling faces";
}

}  // namespace
}  // namespace octavo::boolean
