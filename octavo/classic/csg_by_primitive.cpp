// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/classic/csg_by_primitive.hpp>
#include <octavo/classic/csg_descent.hpp>
#include <octavo/classic/set_operations.hpp>

namespace octavo::classic {
namespace {

namespace word = csg::word;
using octree::DfCode;

SetOperation set_operation(std::uint32_t w) {
    switch (word::operation(w)) {
        case word::union_of:
            return SetOperation::union_of;
        case word::intersection:
            return SetOperation::intersection;
        default:
            return SetOperation::symmetric_difference;
    }
}

/// Combines the operands of one operation as they come, like a binary counter.
class Gathering {
  public:
    Gathering(std::uint32_t w, std::size_t end) : word_(w), end_(end) {}

    std::size_t end() const { return end_; }
    template <class Combine>
    void add(DfCode code, const Combine& combine_two) {
        std::uint32_t count = 1;
        while (!trees_.empty() && trees_.back().count == count) {
            code = combine_two(set_operation(word_), std::move(trees_.back().code), std::move(code));
            count *= 2;
            trees_.pop_back();
        }
        trees_.push_back({std::move(code), count});
    }
    template <class Combine>
    DfCode finish(const Combine& combine_two) {
        DfCode code = std::move(trees_.back().code);
        for (trees_.pop_back(); !trees_.empty(); trees_.pop_back())
            code = combine_two(set_operation(word_), std::move(trees_.back().code), std::move(code));
        if (word::operation(word_) == word::symmetric_difference && (word_ & word::even_bit))
            code = complement(code);
        return code;
    }

  private:
    struct Tree {
        DfCode code;
        std::uint32_t count;
    };
    std::uint32_t word_;
    std::size_t end_;
    std::vector<Tree> trees_;
};

class Builder {
  public:
    Builder(const csg::Program& program, const CsgBuildOptions& options, const Context& context)
        : program_(program), options_(options), context_(context) {}

    Result<PrimitivewiseOctree> run() {
        const std::vector<std::uint32_t>& words = program_.words;
        const auto combine_two = [&](SetOperation operation, DfCode a, DfCode b) {
            DfCode result = combine(operation, a, b);
            grow(result);
            shrink(a);
            shrink(b);
            return result;
        };
        std::vector<Gathering> open;
        for (std::size_t at = 0; at < words.size();) {
            if (!word::is_leaf(words[at])) {
                open.emplace_back(words[at], at + word::size(words.data() + at));
                ++at;
                continue;
            }
            Result<DfCode> leaf = build_leaf({words.data() + at, 1});
            if (!leaf) return leaf.error();
            if (nodes_ > options_.max_nodes)
                return octree::too_many_nodes(options_.max_nodes, options_.depth);
            ++at;
            DfCode code = std::move(*leaf);
            while (!open.empty()) {
                open.back().add(std::move(code), combine_two);
                if (open.back().end() != at) break;
                code = open.back().finish(combine_two);
                open.pop_back();
            }
            if (open.empty()) result_.code = std::move(code);
            context_.report("primitives", static_cast<double>(at) / static_cast<double>(words.size()));
        }
        result_.stats.octants = counters_.octants;
        result_.stats.primitive_tests = counters_.tests;
        return std::move(result_);
    }

  private:
    Result<DfCode> build_leaf(std::span<const std::uint32_t> leaf) {
        if (context_.cancelled()) return Context::cancelled_error();
        Context quiet = context_;
        quiet.on_progress = nullptr;
        const CsgDescent problem(program_, leaf, {options_.depth, CsgDescentOptions::LastLevel::keep_gray},
                                 counters_);
        Result<CsgDescent::Output> built = octree::descend(problem, quiet, {.max_nodes = options_.max_nodes});
        if (!built) return built.error();
        DfCode code = built->take_code();
        grow(code);
        return code;
    }

    void grow(const DfCode& code) {
        nodes_ += code.size();
        bytes_ += code.memory_bytes();
        result_.stats.peak_nodes = std::max(result_.stats.peak_nodes, nodes_);
        result_.stats.peak_bytes = std::max(result_.stats.peak_bytes, bytes_);
    }
    void shrink(const DfCode& code) {
        nodes_ -= code.size();
        bytes_ -= code.memory_bytes();
    }

    const csg::Program& program_;
    const CsgBuildOptions& options_;
    const Context& context_;
    CsgDescent::Counters counters_;
    std::uint64_t nodes_ = 0, bytes_ = 0;
    PrimitivewiseOctree result_;
};

}  // namespace

Result<PrimitivewiseOctree> build_by_primitive(const csg::Program& program, const CsgBuildOptions& options,
                                               const Context& context) {
    return Builder(program, options, context).run();
}

}  // namespace octavo::classic
