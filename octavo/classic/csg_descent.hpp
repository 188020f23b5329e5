// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/local_arrangement.hpp>
#include <octavo/csg/prune.hpp>
#include <octavo/octree/descend.hpp>

// A CSG program as a problem of the one descent (octree/descend.hpp).
//
// A description is a range of words in the buffer of some level: the program as pruned for the cell. A cell whose
// program pruning would not change (one box, one quadric) lends it to its octants instead of copying. The program
// of octant i is written while octants are split, all eight into the buffer of the next level.

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
            counters_->tests += pruner.primitive_tests();
            counters_->resolved += resolved;
            std::uint64_t most = counters_->program_bytes;
            while (bytes > most && !counters_->program_bytes.compare_exchange_weak(most, bytes)) {
            }
        }

        std::span<const std::uint32_t> words(const Description& d) const {
            return {buffers[d.buffer].data() + d.begin, d.size};
        }

        csg::Pruner pruner;
        csg::LocalArrangement arrangement;
        csg::PointSampler sampler;
        std::array<std::vector<std::uint32_t>, octree::max_level + 2> buffers;
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
        workspace.buffers[0].assign(words_.begin(), words_.end());
        return {octree::Node::split, {0, static_cast<std::uint32_t>(words_.size()), 0}};
    }

    std::size_t weight(const Description& description) const { return description.size; }

    Description transfer(const octree::Cell&, const Description& description, const Workspace& from,
                         Workspace& to) const {
        const std::span<const std::uint32_t> words = from.words(description);
        to.buffers[description.buffer].assign(words.begin(), words.end());
        return {0, description.size, description.buffer};
    }

    void restrict_to_children(const octree::Cell& parent, const Description& description,
                              Workspace& workspace, octree::Children<Description>& children) const {
        const std::span<const std::uint32_t> words = workspace.words(description);
        const csg::OctantColors colors = workspace.pruner.evaluate(program_, words, parent);
        workspace.octants += 8;
        const bool last = parent.level + 1 == options_.depth;
        for (std::size_t i = 0; i < 8; ++i) children[i].node = octree::leaf_of(colors[static_cast<int>(i)]);
        if (last && options_.last_level == CsgDescentOptions::LastLevel::keep_gray) return;
        if (colors.gray() == 0) return;
        if (workspace.pruner.unchanged()) {
            if (last) return;  // one surface, and it meets each of these cells
            for (octree::Restricted<Description>& child : children)
                if (child.node == octree::Node::gray) child = {octree::Node::split, description};
            return;
        }
        std::uint8_t settled = 0;
        if (last) settled = csg::octants_on_both_sides(workspace.sampler.sample(program_, words, parent));
        const auto buffer = static_cast<std::uint32_t>(parent.level + 1);
        std::vector<std::uint32_t>& to = workspace.buffers[buffer];
        to.clear();
        for (int i = 0; i < 8; ++i) {
            octree::Restricted<Description>& child = children[static_cast<std::size_t>(i)];
            if (child.node != octree::Node::gray || (settled >> i & 1)) continue;
            const std::size_t begin = to.size();
            workspace.pruner.prune(words, i, to);
            if (last) {
                const octree::Color color = workspace.arrangement.resolve(
                    program_, {to.data() + begin, to.size() - begin}, parent.child(i));
                workspace.resolved += is_decided(color);
                child.node = octree::leaf_of(color);
                to.resize(begin);
            } else {
                child = {octree::Node::split,
                         {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(to.size() - begin),
                          buffer}};
            }
        }
    }

  private:
    const csg::Program& program_;
    std::span<const std::uint32_t> words_;
    CsgDescentOptions options_;
    Counters& counters_;
};

}  // namespace octavo::classic
