// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octavo/csg/brick.hpp>
#include <octavo/csg/leaves_in_cells.hpp>
#include <octavo/csg/second_look.hpp>
#include <octavo/octree/descend.hpp>

// A CSG program as a problem of the one descent (octree/descend.hpp).
//
// A description is a range of words in the buffer of some level: the program as pruned for the cell. A cell whose
// program pruning would not change (one box, one quadric) lends it to its octants instead of copying. The program
// of octant i is written while octants are split, all eight into the buffer of the next level. The leaves of a large
// expression are sorted into cells first (csg/leaves_in_cells.hpp). The last two levels are coloured at once.

namespace octavo::classic {

/// Which cells a descent looks into and what it makes of the last level.
struct CsgDescentOptions {
    int depth = 0;
    /// Look again at gray cells of the last level. Off for single primitives of the classic method, whose octrees
    /// are combined before anything is decided.
    enum class LastLevel : std::uint8_t { resolve, keep_gray } last_level = LastLevel::resolve;
};

class CsgDescent {
  public:
    /// Words in a buffer; or, above the level to which leaves are sorted, cells of that level.
    struct Description {
        std::uint32_t begin = 0, size = 0;
        std::uint32_t buffer = 0;

        static constexpr std::uint32_t sorted_cells = 0xFFFFFFFF;
        bool is_sorted() const { return buffer == sorted_cells; }
    };

    struct Counters {
        std::atomic<std::uint64_t> octants{0}, tests{0}, resolved{0}, program_bytes{0};
    };

    class Workspace {
      public:
        explicit Workspace(Counters* counters) : counters_(counters) {}
        Workspace(Workspace&&) = default;
        ~Workspace() {
            if (!counters_ || octants == 0) return;
            std::uint64_t bytes = 0;
            for (const auto& buffer : buffers) bytes += buffer.capacity() * sizeof(std::uint32_t);
            counters_->octants += octants;
            counters_->tests += pruner.primitive_tests() + placed;
            for (const csg::Brick& brick : bricks) counters_->tests += brick.primitive_tests();
            counters_->resolved += resolved;
            std::uint64_t most = counters_->program_bytes;
            while (bytes > most && !counters_->program_bytes.compare_exchange_weak(most, bytes)) {
            }
        }

        std::span<const std::uint32_t> words(const Description& d) const {
            return {buffers[d.buffer].data() + d.begin, d.size};
        }

        csg::Pruner pruner;
        std::array<csg::Brick, 8> bricks;
        csg::BodiesInCells bodies;
        csg::SecondLook second_look;
        std::array<csg::Scratch<std::uint32_t>, octree::max_level + 2> buffers;
        csg::Scratch<std::uint32_t> cell_words;
        std::uint64_t octants = 0, resolved = 0;
        std::uint64_t placed = 0;  // leaves in cells of the level to which they are sorted

      private:
        Counters* counters_;
    };

    /// The nodes as a DF code, with the most that there were at a time.
    class Output : public octree::DfOutput {
      public:
        // Nodes only ever vanish when octants merge, so that is when to look.
        void merge(const octree::Cell& cell, octree::Color color) {
            peak_ = std::max<std::uint64_t>(peak_, code().size());
            octree::DfOutput::merge(cell, color);
        }
        void append(Output&& next) {
            peak_ = std::max(peak_, code().size() + next.peak());
            octree::DfOutput::append(std::move(next));
        }
        std::uint64_t peak() const { return std::max<std::uint64_t>(peak_, code().size()); }

      private:
        std::uint64_t peak_ = 0;
    };

    /// `words` is the program's own list, or that of one of its sub-expressions; not empty.
    CsgDescent(const csg::Program& program, std::span<const std::uint32_t> words,
               const CsgDescentOptions& options, Counters& counters)
        : program_(program),
          words_(words),
          options_(options),
          counters_(counters),
          // A brick needs words.
          sorted_(csg::LeavesInCells::sort(program, words, options.depth - 2)) {
        if (sorted_) counters_.program_bytes += sorted_->memory_bytes();
    }

    int depth() const { return options_.depth; }
    Workspace make_workspace() const { return Workspace(&counters_); }
    Output make_output() const { return {}; }

    octree::Restricted<Description> root(Workspace& workspace) const {
        if (sorted_)
            return {octree::Node::split, {0, 1U << (3 * sorted_->level()), Description::sorted_cells}};
        put(words_, workspace.buffers[0]);
        return {octree::Node::split, {0, static_cast<std::uint32_t>(words_.size()), 0}};
    }

    std::size_t weight(const Description& description) const {
        return description.is_sorted() ? sorted_->count(description.begin, description.size)
                                       : description.size;
    }

    Description transfer(const octree::Cell&, const Description& description, const Workspace& from,
                         Workspace& to) const {
        if (description.is_sorted()) return description;
        const std::span<const std::uint32_t> words = from.words(description);
        put(words, to.buffers[description.buffer]);
        return {0, description.size, description.buffer};
    }

    void restrict_to_children(const octree::Cell& parent, const Description& description,
                              Workspace& workspace, octree::Children<Description>& children) const {
        workspace.octants += 8;
        if (description.is_sorted()) return share_sorted(parent, description, workspace, children);
        const std::span<const std::uint32_t> words = workspace.words(description);
        csg::Pruner& pruner = workspace.pruner;
        if (parent.level + 1 == options_.depth)
            return give_colors(looked_at_again(parent, words, workspace), children);
        const csg::OctantColors colors = pruner.evaluate_colors(program_, words, parent);
        const auto buffer = static_cast<std::uint32_t>(parent.level + 1);
        std::array<csg::Pruner::Part, 8> parts;
        if (!pruner.unchanged()) {
            workspace.buffers[buffer].clear();
            parts = pruner.prune(words, colors.gray(), workspace.buffers[buffer]);
        }
        for (std::size_t i = 0; i < 8; ++i) {
            octree::Restricted<Description>& child = children[i];
            child.node = octree::leaf_of(colors[static_cast<int>(i)]);
            if (child.node != octree::Node::gray) continue;
            child.node = octree::Node::split;
            child.description =
                pruner.unchanged() ? description : Description{parts[i].begin, parts[i].size, buffer};
        }
    }

    static constexpr int finished_levels = 3;
    octree::Node finish(const octree::Cell& cell, const Description& description, Workspace& workspace,
                        Output& output) const {
        return write(cell, color_octants(cell, description, 0xFF, workspace), description, workspace, output);
    }

    /// The octants of a cell three levels above the last: decided ones, and those that are split with the colours of
    /// all that is two levels below them.
    struct Octant {
        octree::Node node = octree::Node::split;
        octree::GrandchildColors colors{};
    };
    using Octants = std::array<Octant, 8>;

    /// Octants that are not in the set `open` are left split, without colours. The bodies of all eight bricks share
    /// the lanes in which the cells that they may enter are looked at.
    Octants color_octants(const octree::Cell& cell, const Description& description, unsigned open,
                          Workspace& workspace) const {
        octree::Children<Description> children;
        restrict_to_children(cell, description, workspace, children);
        Octants octants;
        for (std::size_t i = 0; i < 8; ++i) {
            octants[i].node = children[i].node;
            if (!(open >> i & 1))
                octants[i].node = octree::Node::split;
            else if (is_leaf(children[i].node))
                open &= ~(1U << i);
        }
        const auto each_open = [open](const auto& visit) {
            for (unsigned left = open; left != 0; left &= left - 1)
                visit(static_cast<std::size_t>(std::countr_zero(left)));
        };
        each_open([&](std::size_t i) {
            csg::Brick& brick = workspace.bricks[i];
            brick.look(program_, workspace.words(children[i].description), cell.child(static_cast<int>(i)));
            brick.ask(workspace.bodies);
        });
        workspace.bodies.finish();
        each_open([&](std::size_t i) {
            octants[i].colors = colors_of(workspace.bricks[i], cell.child(static_cast<int>(i)), workspace);
        });
        return octants;
    }

    /// Returns the colour of all of the cell when its octants are merged, else split.
    static octree::Node write(const octree::Cell& cell, const Octants& octants,
                              const Description& description, const Workspace& workspace, Output& output) {
        output.split(cell, description, workspace);
        octree::Node common = octree::Node::split;
        for (std::size_t i = 0; i < 8; ++i) {
            const Octant& octant = octants[i];
            octree::Node node = octant.node;
            if (node == octree::Node::split)
                node = output.finish(octant.colors);
            else
                output.leaf(cell.child(static_cast<int>(i)), octree::Restricted<Description>{node, {}},
                            workspace);
            common = i == 0 || node == common ? node : octree::Node::split;
        }
        if (common == octree::Node::white || common == octree::Node::black) {
            output.merge(cell, color_of(common));
            return common;
        }
        return octree::Node::split;
    }

  private:
    /// Octants of a cell above the level to which leaves are sorted.
    void share_sorted(const octree::Cell& parent, const Description& description, Workspace& workspace,
                      octree::Children<Description>& children) const {
        const auto buffer = static_cast<std::uint32_t>(parent.level + 1);
        csg::Scratch<std::uint32_t>& words = workspace.buffers[buffer];
        words.clear();
        for (std::uint32_t i = 0; i < 8; ++i) {
            octree::Restricted<Description>& child = children[i];
            child.description = {description.begin + description.size / 8 * i, description.size / 8,
                                 Description::sorted_cells};
            const std::uint32_t count = sorted_->count(child.description.begin, child.description.size);
            child.node = count == 0 ? octree::leaf_of(sorted_->color_without()) : octree::Node::split;
            if (count == 0 || child.description.size > 1) continue;
            workspace.placed += count;
            const auto begin = static_cast<std::uint32_t>(words.size());
            const octree::Color color = sorted_->write(child.description.begin, words);
            if (is_decided(color)) child.node = octree::leaf_of(color);
            child.description = {begin, static_cast<std::uint32_t>(words.size()) - begin, buffer};
        }
    }

    /// The cells of a brick that has been looked at, and whose bodies have been asked about.
    octree::GrandchildColors colors_of(csg::Brick& brick, const octree::Cell& cell,
                                       Workspace& workspace) const {
        const csg::Brick::Colors& seen = brick.settle();
        csg::LayerPair colors = seen.cells;
        if (resolves() && seen.unproved.any())
            for_each_cell(seen.unproved, [&](csg::BrickCell next) {
                brick.prune(next, workspace.cell_words);
                const octree::Color color = look_again(cell_of(cell, next), workspace);
                if (color == octree::Color::white) next.add_to(colors.out);
                if (color == octree::Color::black) next.add_to(colors.in);
            });
        const csg::InMortonOrder in_order(colors.out, colors.in);
        const octree::GrandchildColors result{in_order.first, in_order.second};
        workspace.octants += 8 + 8 * octants_of_two_colors(result);
        return result;
    }

    /// Octants of a cell that are not white as a whole, nor black.
    static std::uint64_t octants_of_two_colors(const octree::GrandchildColors& colors) {
        // The highest bit of each byte that is not zero.
        const auto nonzero_bytes = [](std::uint64_t bytes) {
            constexpr std::uint64_t low_bits = 0x7F7F7F7F7F7F7F7F;
            return (((bytes & low_bits) + low_bits) | bytes) & ~low_bits;
        };
        return static_cast<std::uint64_t>(
            std::popcount(nonzero_bytes(~colors.white) & nonzero_bytes(~colors.black)));
    }

    static octree::Cell cell_of(const octree::Cell& brick, const csg::BrickCell& cell) {
        const auto quarters = [&](std::uint32_t count) {
            return static_cast<int>(count) * (brick.side() / 4);
        };
        return {
            {brick.low.x + quarters(cell.x), brick.low.y + quarters(cell.y), brick.low.z + quarters(cell.z)},
            brick.level + 2};
    }

    static void put(std::span<const std::uint32_t> words, csg::Scratch<std::uint32_t>& buffer) {
        buffer.clear();
        buffer.end_at(std::copy(words.begin(), words.end(), buffer.room(words.size())));
    }

    static void give_colors(csg::OctantColors colors, octree::Children<Description>& children) {
        for (std::size_t i = 0; i < 8; ++i) children[i].node = octree::leaf_of(colors[static_cast<int>(i)]);
    }

    bool resolves() const { return options_.last_level == CsgDescentOptions::LastLevel::resolve; }

    /// Of a tree with one level or two, which has no bricks: the octants on the last.
    csg::OctantColors looked_at_again(const octree::Cell& parent, std::span<const std::uint32_t> words,
                                      Workspace& workspace) const {
        const csg::Seen seen = workspace.pruner.evaluate(program_, words, parent);
        csg::OctantColors colors = seen.octants;
        if (!resolves()) return colors;
        unsigned open = colors.gray() & ~octants_on_both_sides(seen.points);
        for (; open != 0; open &= open - 1) {
            workspace.cell_words.clear();
            workspace.pruner.prune(words, open & -open, workspace.cell_words);
            const int octant = std::countr_zero(open);
            colors.set(octant, look_again(parent.child(octant), workspace));
        }
        return colors;
    }

    octree::Color look_again(const octree::Cell& cell, Workspace& workspace) const {
        const csg::Scratch<std::uint32_t>& words = workspace.cell_words;
        const octree::Color color = workspace.second_look.color(program_, {words.data(), words.size()}, cell);
        workspace.resolved += is_decided(color);
        return color;
    }

    const csg::Program& program_;
    std::span<const std::uint32_t> words_;
    CsgDescentOptions options_;
    Counters& counters_;
    std::optional<csg::LeavesInCells> sorted_;
};

}  // namespace octavo::classic
