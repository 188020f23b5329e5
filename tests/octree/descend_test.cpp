// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/descend.hpp>
#include <octavo/octree/octree.hpp>

namespace octavo::octree {
namespace {

struct Ball {
    std::int64_t x, y, z, radius;
};

// Squares of the least and the greatest distance of the closed cell to the ball's centre; 26-bit coordinates.
std::pair<std::int64_t, std::int64_t> squared_distances(const Cell& cell, const Ball& ball) {
    std::int64_t least = 0, greatest = 0;
    const exact::Point high = cell.high();
    const std::int64_t centre[3] = {ball.x, ball.y, ball.z};
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t a = cell.low[axis] - centre[axis], b = high[axis] - centre[axis];
        const std::int64_t near = a > 0 ? a : b < 0 ? b : 0;
        least += near * near;
        greatest += std::max(a * a, b * b);
    }
    return {least, greatest};
}

// The union of balls: a problem whose descriptions have bulk data, the list of balls that still matter.
class Balls {
  public:
    struct Description {
        std::uint32_t begin = 0, end = 0;
    };
    struct Workspace {
        std::array<std::vector<std::uint32_t>, max_level + 1> lists;
    };
    using Output = DfOutput;

    Balls(std::vector<Ball> balls, int depth) : balls_(std::move(balls)), depth_(depth) {}

    int depth() const { return depth_; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    std::size_t weight(const Description& d) const { return d.end - d.begin; }

    Restricted<Description> root(Workspace& workspace) const {
        std::vector<std::uint32_t>& list = workspace.lists[0];
        list.clear();
        for (std::uint32_t i = 0; i < balls_.size(); ++i) list.push_back(i);
        return {Node::split, {0, static_cast<std::uint32_t>(balls_.size())}};
    }

    Description transfer(const Cell& cell, const Description& d, const Workspace& from, Workspace& to) const {
        const std::vector<std::uint32_t>& source = from.lists[static_cast<std::size_t>(cell.level)];
        std::vector<std::uint32_t>& target = to.lists[static_cast<std::size_t>(cell.level)];
        target.assign(source.begin() + d.begin, source.begin() + d.end);
        return {0, d.end - d.begin};
    }

    void restrict_to_children(const Cell& parent, const Description& d, Workspace& workspace,
                              Children<Description>& children) const {
        const std::vector<std::uint32_t>& list = workspace.lists[static_cast<std::size_t>(parent.level)];
        std::vector<std::uint32_t>& next = workspace.lists[static_cast<std::size_t>(parent.level) + 1];
        next.clear();
        for (std::size_t octant = 0; octant < 8; ++octant) {
            Restricted<Description>& child = children[octant];
            child.description.begin = static_cast<std::uint32_t>(next.size());
            child.node = Node::white;
            for (std::uint32_t i = d.begin; i < d.end && child.node != Node::black; ++i) {
                const Node node = classify(parent.child(static_cast<int>(octant)), balls_[list[i]]);
                if (node == Node::white) continue;
                child.node = node;
                if (node == Node::split) next.push_back(list[i]);
            }
            if (child.node != Node::split) next.resize(child.description.begin);
            child.description.end = static_cast<std::uint32_t>(next.size());
        }
    }

    static Node classify(const Cell& cell, const Ball& ball) {
        const auto [least, greatest] = squared_distances(cell, ball);
        const std::int64_t square = ball.radius * ball.radius;
        return greatest <= square ? Node::black : least >= square ? Node::white : Node::split;
    }

  private:
    std::vector<Ball> balls_;
    int depth_;
};

std::vector<Ball> random_balls(int count, std::int64_t largest, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int64_t> place(0, exact::universe_side - 1), radius(1, largest);
    std::vector<Ball> balls;
    for (int i = 0; i < count; ++i)
        balls.push_back({place(random), place(random), place(random), radius(random)});
    return balls;
}

Octree build(const Balls& balls, const Context& context, const DescentOptions& options = {}) {
    Result<DfOutput> output = descend(balls, context, options);
    return {exact::Lattice{}, balls.depth(), output->take_code()};
}

Context with_threads(int threads) {
    Context context;
    context.threads = threads;
    return context;
}

TEST(Descend, ClassifiesEveryCellAsAnIndependentTestOfAllBallsDoes) {
    const std::vector<Ball> balls = random_balls(20, exact::universe_side / 4, 7);
    const int depth = 4;
    const Octree octree = build(Balls(balls, depth), with_threads(1));
    ASSERT_TRUE(octree.validate());
    // Every cell of the last level must have the colour of the leaf that contains it.
    octree.for_each_leaf([&](CellKey key, Color color) {
        const CellKey last = key.last_descendant();
        for (CellKey small = key.first_descendant().ancestor(depth);;
             small = CellKey::from_code(small.code() + (1ULL << (3 * (max_level - depth))), depth)) {
            // A cell is black only if one ball covers one of its ancestors or itself.
            Color expected = Color::white;
            for (int level = 0; level <= depth && expected != Color::black; ++level)
                for (const Ball& ball : balls) {
                    const Node node = Balls::classify(Cell::of(small.ancestor(level)), ball);
                    if (node == Node::black) expected = Color::black;
                    if (node == Node::split && level == depth && expected == Color::white)
                        expected = Color::gray;
                }
            EXPECT_EQ(color, expected) << small.bits();
            if (small.last_descendant() == last) break;
        }
    });
}

TEST(Descend, GivesTheSameBytesForAnyNumberOfThreadsAndForks) {
    const Balls balls(random_balls(300, exact::universe_side / 16, 3), 7);
    const Octree serial = build(balls, with_threads(1));
    EXPECT_GT(serial.code().size(), 10000u);
    for (const int threads : {0, 2, 5})
        for (const std::size_t fork_weight : {std::size_t{0}, std::size_t{10}, std::size_t{1000}}) {
            DescentOptions options;
            options.fork_weight = fork_weight;
            EXPECT_EQ(build(balls, with_threads(threads), options), serial);
        }
}

// Each cell of level `depth` is of one colour, so that everything merges to one leaf.
struct Monochrome {
    struct Description {};
    struct Workspace {};
    using Output = DfOutput;
    Node node = Node::black;

    int depth() const { return 3; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    Restricted<Description> root(Workspace&) const { return {Node::split, {}}; }
    std::size_t weight(const Description&) const { return 1; }
    Description transfer(const Cell&, const Description& d, const Workspace&, Workspace&) const { return d; }
    void restrict_to_children(const Cell& parent, const Description&, Workspace&,
                              Children<Description>& children) const {
        for (Restricted<Description>& child : children) child.node = parent.level == 2 ? node : Node::split;
    }
};

TEST(Descend, MergesDecidedSiblingsOfOneColourAndNeverGrayOnes) {
    for (const int threads : {1, 2}) {
        DescentOptions options;
        options.fork_weight = 0;
        const auto code = [&](Node node) {
            return descend(Monochrome{node}, with_threads(threads), options)->take_code();
        };
        const DfCode black = code(Node::black);
        ASSERT_EQ(black.size(), 1u);
        EXPECT_EQ(black[0], Node::black);
        EXPECT_EQ(code(Node::white)[0], Node::white);
        EXPECT_EQ(code(Node::gray).size(), 1u + 8 + 64 + 512);
        EXPECT_EQ(code(Node::split).size(), 1u + 8 + 64 + 512) << "undecided at the last level is gray";
    }
}

TEST(Descend, RefusesMoreNodesThanAllowedAndExactlyThese) {
    const Balls balls(random_balls(300, exact::universe_side / 16, 3), 7);
    const std::uint64_t nodes = build(balls, with_threads(1)).code().size();
    for (const int threads : {1, 4})
        for (const std::size_t fork_weight : {std::size_t{0}, std::size_t{1000}}) {
            DescentOptions options;
            options.fork_weight = fork_weight;
            options.max_nodes = nodes;
            EXPECT_TRUE(descend(balls, with_threads(threads), options));
            options.max_nodes = nodes - 1;
            const Result<DfOutput> refused = descend(balls, with_threads(threads), options);
            ASSERT_FALSE(refused);
            EXPECT_EQ(refused.error().code, ErrorCode::limit);
            EXPECT_NE(refused.error().sentence.find("at depth 7"), std::string::npos);
        }
    DescentOptions one;
    one.max_nodes = 1;
    EXPECT_TRUE(descend(Monochrome{Node::black}, with_threads(1), one)) << "merged nodes do not count";
}

// Every cell down to the last level is split: 8^21 nodes. The first levels fork.
struct Endless {
    struct Description {
        std::size_t weight = 5;
    };
    struct Workspace {};
    using Output = DfOutput;

    int depth() const { return max_level; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    Restricted<Description> root(Workspace&) const { return {Node::split, {}}; }
    std::size_t weight(const Description& d) const { return d.weight; }
    Description transfer(const Cell&, const Description& d, const Workspace&, Workspace&) const { return d; }
    void restrict_to_children(const Cell&, const Description& d, Workspace&,
                              Children<Description>& children) const {
        for (Restricted<Description>& child : children)
            child = {Node::split, {d.weight > 0 ? d.weight - 1 : 0}};
    }
};

TEST(Descend, StopsSoonWhenThereAreTooManyNodes) {
    for (const int threads : {1, 3}) {
        DescentOptions options;
        options.fork_weight = 2;
        options.max_nodes = 1'000'000;
        const Result<DfOutput> refused = descend(Endless{}, with_threads(threads), options);
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::limit);
    }
}

TEST(Descend, ReportsProgressThatRisesToOne) {
    for (const int threads : {1, 3}) {
        std::mutex mutex;
        std::vector<double> seen;
        Context context = with_threads(threads);
        context.on_progress = [&](std::string_view phase, double done) {
            const std::scoped_lock lock(mutex);
            EXPECT_EQ(phase, "octree");
            seen.push_back(done);
        };
        build(Balls(random_balls(100, exact::universe_side / 16, 5), 7), context);
        EXPECT_GT(seen.size(), 20u);
        EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
        EXPECT_EQ(seen.back(), 1.0);
    }
}

TEST(Descend, StopsSoonWhenCancelled) {
    for (const int threads : {1, 3}) {
        std::atomic<bool> cancel{false};
        Context context = with_threads(threads);
        context.cancel = &cancel;
        context.on_progress = [&](std::string_view, double done) {
            if (done > 0.1) cancel = true;
            EXPECT_LT(done, 0.9) << "went on after the cancellation";
        };
        const Result<DfOutput> output =
            descend(Balls(random_balls(300, exact::universe_side / 16, 5), 8), context);
        ASSERT_FALSE(output);
        EXPECT_EQ(output.error().code, ErrorCode::cancelled);
    }
}

}  // namespace
}  // namespace octavo::octree
