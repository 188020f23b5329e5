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
#include <octavo/csg/second_look.hpp>
#include <octavo/octree/descend.hpp>

// A CSG program as a problem of the one descent (octree/descend.hpp).
//
// A description is a range of words in the buffer of some level: the program as pruned for the cell. A cell whose
// program pruning would not change (one box, one quadric) lends it to its octants instead of copying. The program
// of octant i is written while octants are split, all eight into the buffer of the next level. The last two levels are
// coloured at once.

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
    struct Description {
        std::uint32_t begin = 0, size = 0;
        std::uint32_t buffer = 0;
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
            counters_->tests += pruner.primitive_tests() + brick.primitive_tests();
            counters_->resolved += resolved;
            std::uint64_t most = counters_->program_bytes;
            while (bytes > most && !counters_->program_bytes.compare_exchange_weak(most, bytes)) {
            }
        }

        std::span<const std::uint32_t> words(const Description& d) const {
            return {buffers[d.buffer].data() + d.begin, d.size};
        }

        csg::Pruner pruner;
        csg::Brick brick;
        csg::SecondLook second_look;
        std::array<csg::Scratch<std::uint32_t>, octree::max_level + 2> buffers;
        csg::Scratch<std::uint32_t> cell_words;
        std::uint64_t octants = 0, resolved = 0;

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
        : program_(program), words_(words), options_(options), counters_(counters) {}

    int depth() const { return options_.depth; }
    Workspace make_workspace() const { return Workspace(&counters_); }
    Output make_output() const { return {}; }

    octree::Restricted<Description> root(Workspace& workspace) const {
        put(words_, workspace.buffers[0]);
        return {octree::Node::split, {0, static_cast<std::uint32_t>(words_.size()), 0}};
    }

    std::size_t weight(const Description& description) const { return description.size; }

    Description transfer(const octree::Cell&, const Description& description, const Workspace& from,
                         Workspace& to) const {
        const std::span<const std::uint32_t> words = from.words(description);
        put(words, to.buffers[description.buffer]);
        return {0, description.size, description.buffer};
    }

    void restrict_to_children(const octree::Cell& parent, const Description& description,
                              Workspace& workspace, octree::Children<Description>& children) const {
        workspace.octants += 8;
        const std::span<const std::uint32_t> words = workspace.words(description);
        csg::Pruner& pruner = workspace.pruner;
        const csg::Seen seen = pruner.evaluate(program_, words, parent);
        if (parent.level + 1 == options_.depth)
            return give_colors(looked_at_again(parent, words, workspace, seen), children);
        const auto buffer = static_cast<std::uint32_t>(parent.level + 1);
        csg::Scratch<std::uint32_t>& to = workspace.buffers[buffer];
        if (!pruner.unchanged()) to.clear();
        for (int i = 0; i < 8; ++i) {
            octree::Restricted<Description>& child = children[static_cast<std::size_t>(i)];
            child.node = octree::leaf_of(seen.octants[i]);
            if (child.node != octree::Node::gray) continue;
            child = {octree::Node::split, description};
            if (pruner.unchanged()) continue;
            const std::size_t begin = to.size();
            pruner.prune(words, i, to);
            child.description = {static_cast<std::uint32_t>(begin),
                                 static_cast<std::uint32_t>(to.size() - begin), buffer};
        }
    }

    static constexpr int finished_levels = 2;
    octree::Node finish(const octree::Cell& cell, const Description& description, Workspace& workspace,
                        Output& output) const {
        return output.finish(color_brick(cell, description, workspace));
    }

    /// The last two levels at once.
    octree::GrandchildColors color_brick(const octree::Cell& cell, const Description& description,
                                         Workspace& workspace) const {
        const std::span<const std::uint32_t> words = workspace.words(description);
        const csg::BrickSeen& seen = workspace.brick.evaluate(program_, words, cell);
        csg::LayerPair colors = seen.cells;
        if (resolves()) {
            csg::Layers unproved = seen.unproved();
            while (const std::optional<csg::BrickCell> next = take_first(unproved)) {
                workspace.brick.prune(words, *next, workspace.cell_words);
                const octree::Color color = look_again(cell_of(cell, *next), workspace);
                if (color == octree::Color::white) next->add_to(colors.out);
                if (color == octree::Color::black) next->add_to(colors.in);
            }
        }
        const octree::GrandchildColors in_order{in_morton_order(colors.out), in_morton_order(colors.in)};
        workspace.octants += 8 + 8 * octants_of_two_colors(in_order);
        return in_order;
    }

  private:
    /// Octants of a cell that are not white as a whole, nor black.
    static std::uint64_t octants_of_two_colors(const octree::GrandchildColors& colors) {
        std::uint64_t count = 0;
        for (unsigned octant = 0; octant < 8; ++octant)
            count += (colors.white >> (8 * octant) & 0xFF) != 0xFF &&
                     (colors.black >> (8 * octant) & 0xFF) != 0xFF;
        return count;
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

    /// Of a tree with one level: the octants of the universe.
    csg::OctantColors looked_at_again(const octree::Cell& parent, std::span<const std::uint32_t> words,
                                      Workspace& workspace, const csg::Seen& seen) const {
        csg::OctantColors colors = seen.octants;
        if (!resolves()) return colors;
        unsigned open = colors.gray() & ~octants_on_both_sides(seen.points);
        for (; open != 0; open &= open - 1) {
            const int octant = std::countr_zero(open);
            workspace.cell_words.clear();
            workspace.pruner.prune(words, octant, workspace.cell_words);
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
};

}  // namespace octavo::classic
