// SPDX-License-Identifier: Apache-2.0
#include <functional>
#include <memory>
#include <numeric>

#include <gtest/gtest.h>

#include <octavo/boolean/evaluate.hpp>
#include "solids.hpp"

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
            nodes.push_back({result.program.operand(k), [k](std::uint32_t bits) { return (bits >> k & 1) != 0; }, std::string(1, static_cast<char>('A' + k))});
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
                                 return gate == Gate::any ? count > 0 : gate == Gate::all ? count == inputs.size() : count % 2 == 1;
                             },
                             text + ")"});
        }
        result.holds = nodes[0].holds;
        result.text = nodes[0].text;
        return result;
    }
}

/// The volume where an expression holds, from the volumes of all intersections.
double expected_volume(const std::vector<Convex>& bodies, const std::function<bool(std::uint32_t)>& holds) {
    const std::uint32_t all = 1u << bodies.size();
    std::vector<double> atom(all, 0);  // first of the intersection of the bodies in the set, then of exactly those
    for (std::uint32_t set = 1; set < all; ++set) {
        std::vector<tests::HalfSpace> sides;
        for (std::size_t k = 0; k < bodies.size(); ++k)
            if (set >> k & 1) sides.insert(sides.end(), bodies[k].sides.begin(), bodies[k].sides.end());
        atom[set] = tests::volume_of(sides);
    }
    for (std::size_t k = 0; k < bodies.size(); ++k)
        for (std::uint32_t set = 1; set < all; ++set)
            if (!(set >> k & 1)) atom[set] -= atom[set | 1u << k];
    double volume = 0;
    for (std::uint32_t set = 1; set < all; ++set)
        if (holds(set)) volume += atom[set];
    return volume;
}

void expect_solid(const Result<Evaluated>& result, double volume, const std::string& what) {
    ASSERT_TRUE(result) << what << ": " << result.error().describe();
    EXPECT_EQ(tests::manifold_defect(result->mesh), "") << what;
    EXPECT_NEAR(tests::volume_of(result->mesh), volume, 1e-9) << what;
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
        const double volume = expected_volume(bodies, expression.holds);
        const std::string what = "run " + std::to_string(run) + " of " + std::to_string(count) + " bodies, " + expression.text;
        for (const Simplify simplify : {Simplify::none, Simplify::coplanar})
            expect_solid(evaluate(meshes_of(bodies), expression.program, {.simplify = simplify}, context), volume,
                         what + (simplify == Simplify::none ? "" : ", simplified"));
    }
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomConvexBodies,
                         testing::Combine(testing::Values(2, 3, 4), testing::Values(2, 3, 5)));

}  // namespace
}  // namespace octavo::boolean
