// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/octree/octree.hpp>

namespace octavo::octree {
namespace {

DfCode code_of(const std::vector<Node>& nodes) {
    DfCode code;
    for (const Node node : nodes) code.append(node);
    return code;
}

std::vector<Node> random_nodes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Node> nodes(count);
    for (Node& node : nodes) node = static_cast<Node>(random() % 4);
    return nodes;
}

// A random tree, as nodes in depth-first order, with the leaves' keys beside it from plain recursion.
struct RandomTree {
    std::vector<Node> nodes;
    std::vector<std::pair<CellKey, Color>> leaves;

    RandomTree(int depth, unsigned seed) : random(seed) { grow(CellKey::root(), depth); }

  private:
    void grow(CellKey key, int depth) {
        const bool split =
            key.level() < depth && (key.level() < 2 || random() % 12 == 0 || key.contains(deep));
        nodes.push_back(split ? Node::split : static_cast<Node>(random() % 3));
        if (!split) leaves.emplace_back(key, color_of(nodes.back()));
        for (int i = 0; split && i < 8; ++i) grow(key.child(i), depth);
    }
    static constexpr exact::Point deep{12345678, 45678901, 7654321};  // its cells are split to the last level
    std::mt19937 random;
};

TEST(DfCode, TwoLevelsAtOnceAreThoseOneAfterTheOther) {
    std::mt19937_64 random(5);
    DfCode at_once, one_by_one;
    for (int round = 0; round < 2000; ++round) {
        GrandchildColors colors;
        const int kind = static_cast<int>(random() % 6);
        for (int outer = 0; outer < 8; ++outer) {
            const auto of_octant = [&](std::uint64_t bits) { return (bits & 0xFF) << (8 * outer); };
            const std::uint64_t black = random(), white = ~black & random();
            const bool whole = random() % 2 == 0;
            if (kind == 0 || (kind > 2 && whole && random() % 2 == 0))
                colors.white |= of_octant(0xFF);
            else if (kind == 1 || (kind > 2 && whole))
                colors.black |= of_octant(0xFF);
            else if (kind > 2 || !whole)
                colors.black |= of_octant(black), colors.white |= of_octant(white);
        }
        const auto append_octant = [&](int outer) {
            const std::uint64_t white = colors.white >> (8 * outer) & 0xFF,
                                black = colors.black >> (8 * outer) & 0xFF;
            if (white == 0xFF || black == 0xFF) return one_by_one.append(white ? Node::white : Node::black);
            one_by_one.append(Node::split);
            for (int inner = 0; inner < 8; ++inner)
                one_by_one.append(white >> inner & 1   ? Node::white
                                  : black >> inner & 1 ? Node::black
                                                       : Node::gray);
        };
        Node expected = Node::split;
        if (~colors.white == 0) expected = Node::white;
        if (~colors.black == 0) expected = Node::black;
        one_by_one.append(expected);
        for (int outer = 0; expected == Node::split && outer < 8; ++outer) append_octant(outer);
        EXPECT_EQ(at_once.append(colors), expected);
        ASSERT_EQ(at_once, one_by_one);
    }
}

TEST(DfCode, GivesBackWhatWasAppended) {
    const std::vector<Node> nodes = random_nodes(1000, 1);
    const DfCode code = code_of(nodes);
    ASSERT_EQ(code.size(), nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_EQ(code[i], nodes[i]);
}

TEST(DfCode, AppendsAndTruncatesAtEveryAlignment) {
    for (std::size_t head = 0; head < 70; ++head)
        for (const std::size_t tail : {0, 1, 5, 31, 32, 33, 64, 99}) {
            const std::vector<Node> first = random_nodes(head, 2), second = random_nodes(tail, 3);
            std::vector<Node> both = first;
            both.insert(both.end(), second.begin(), second.end());
            DfCode joined = code_of(first);
            joined.append(code_of(second));
            ASSERT_EQ(joined, code_of(both)) << head << " " << tail;
            joined.truncate(head);
            ASSERT_EQ(joined, code_of(first));
            if (tail <= 32) {
                std::uint64_t bits = 0;
                for (std::size_t i = 0; i < tail; ++i)
                    bits |= static_cast<std::uint64_t>(second[i]) << (2 * i);
                if (tail > 0) joined.append(bits, tail);
                ASSERT_EQ(joined, code_of(both)) << head << " " << tail;
            }
        }
}

TEST(DfCode, GoesToWordsAndBackAndRefusesLyingLengths) {
    const DfCode code = code_of(random_nodes(75, 4));
    EXPECT_EQ(*DfCode::from_words(code.words(), 75), code);
    EXPECT_FALSE(DfCode::from_words(code.words(), 97));
    EXPECT_FALSE(DfCode::from_words(code.words(), 64));
    EXPECT_FALSE(DfCode::from_words(code.words(), 0));
    std::vector<std::uint64_t> words = code.words();
    words.back() |= 1ULL << 63;
    EXPECT_FALSE(DfCode::from_words(words, 75));
    EXPECT_TRUE(DfCode::from_words({}, 0));
}

TEST(DfCursor, FindsEveryLeafWhereRecursionPutIt) {
    for (const int depth : {0, 1, 2, 5, 21}) {
        const RandomTree tree(depth, static_cast<unsigned>(depth));
        const Octree octree(exact::Lattice{}, depth, code_of(tree.nodes));
        ASSERT_TRUE(octree.validate());
        std::vector<std::pair<CellKey, Color>> leaves;
        octree.for_each_leaf([&](CellKey key, Color color) { leaves.emplace_back(key, color); });
        EXPECT_EQ(leaves, tree.leaves);
    }
}

TEST(CheckTree, RefusesTruncatedTrailingAndTooDeepCodes) {
    const RandomTree tree(4, 9);
    EXPECT_TRUE(check_tree(code_of(tree.nodes), 4));
    for (std::size_t size = 0; size < tree.nodes.size(); ++size) {
        DfCode cut = code_of(tree.nodes);
        cut.truncate(size);
        EXPECT_FALSE(check_tree(cut, 4)) << size;
    }
    std::vector<Node> longer = tree.nodes;
    longer.push_back(Node::white);
    EXPECT_FALSE(check_tree(code_of(longer), 4));
    EXPECT_FALSE(check_tree(code_of(tree.nodes), 3));
    EXPECT_FALSE(Octree::from_untrusted({}, 22, code_of({Node::white})));
    EXPECT_FALSE(check_tree(code_of(std::vector<Node>(100, Node::split)), 21)) << "endless splitting";
}

TEST(OctreeStats, CountsLeavesAndAddsVolumesExactly) {
    const RandomTree tree(6, 12);
    const Octree octree(exact::Lattice{}, 6, code_of(tree.nodes));
    const OctreeStats stats = octree.stats();
    std::uint64_t counts[3] = {};
    LatticeVolume volumes[3] = {};
    for (const auto& [key, color] : tree.leaves) {
        ++counts[static_cast<int>(color)];
        const LatticeVolume side = static_cast<LatticeVolume>(key.side());
        volumes[static_cast<int>(color)] += side * side * side;
    }
    EXPECT_EQ(stats.white, counts[0]);
    EXPECT_EQ(stats.black, counts[1]);
    EXPECT_EQ(stats.gray, counts[2]);
    EXPECT_EQ(stats.nodes(), tree.nodes.size());
    EXPECT_EQ(stats.splits * 7 + 1, stats.leaves());
    EXPECT_TRUE(stats.black_volume == volumes[1]);
    EXPECT_TRUE(stats.gray_volume == volumes[2]);
    EXPECT_TRUE(volumes[0] + volumes[1] + volumes[2] == cell_volume(0)) << "the leaves fill the universe";
    EXPECT_EQ(Octree().stats().white, 1u);
}

}  // namespace
}  // namespace octavo::octree
