// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>

#include <octavo/csg/normal_form.hpp>

namespace octavo::csg {
namespace {

Error limit_error(std::uint64_t leaves) {
    return {ErrorCode::limit, "the expression has more than " + std::to_string(leaves) + " primitives", {}};
}

bool is_finite(const Affine& map) {
    // No branches: twelve differences, of which one that is not finite makes the sum no number.
    double sum = 0;
    for (const auto& row : map.m)
        for (const double entry : row) sum += entry - entry;
    return sum == 0;
}

/// Walks the expression with a stack of its own and writes tokens in the opposite of prefix order, operands
/// first, because an operation is known to be needed only when its operands are.
class Normaliser {
  public:
    explicit Normaliser(const NormalFormOptions& options) : options_(options) {}

    Result<NormalForm> run(const Expr& expression) {
        open(expression, nullptr, false);
        while (!frames_.empty() && !error_) {
            Frame& frame = frames_.back();
            if (frame.next == 0 || frame.decided) {
                close();
            } else {
                // The last operand first: the array is reversed at the end.
                const std::size_t index = --frame.next;
                const bool flip = frame.negate_all != (frame.difference && index > 0);
                open((*frame.operands)[index], frame.place, flip);
            }
        }
        if (error_) return std::move(*error_);
        if (form_.tokens.empty()) form_.tokens.push_back({NormalKind::constant, constant_, 1, 0});
        std::reverse(form_.tokens.begin(), form_.tokens.end());
        form_.expression = expression;
        return std::move(form_);
    }

  private:
    struct Frame {
        NormalKind kind;
        const Affine*
            place;  // none where nothing has moved it; of the expression, or the last of `composed_`
        const std::vector<Expr>* operands;
        std::size_t next;         // operands not yet visited
        std::size_t begin;        // where its tokens begin
        std::size_t first_leaf;   // where its leaves begin
        std::uint32_t count = 0;  // operands written
        bool negate_all = false;  // each operand is complemented (De Morgan)
        bool difference = false;  // each operand but the first is complemented
        bool flipped = false;     // of a symmetric difference
        bool melted = false;      // its operands belong to the frame below, which is of the same kind
        bool decided = false;     // the rest does not matter
        bool composed = false;    // its place is in `composed_`
    };

    void open(const Expr& start, const Affine* place, bool negated) {
        // Chains of maps and complements need no frame. A place is copied where it stays only: the machine waits for
        // numbers that were just written one by one and are then copied several at a time.
        const Expr* expr = &start;
        Affine composed;
        for (;;) {
            if (expr->operation() == Operation::transform) {
                if (!is_finite(expr->map())) {
                    error_ = Error{
                        ErrorCode::bad_input, "a transformation matrix has an entry that is not finite", {}};
                    return;
                }
                if (place) {
                    composed = compose(*place, expr->map());
                    place = &composed;
                } else {
                    place = &expr->map();
                }
                if (!is_finite(*place)) {
                    error_ = Error{
                        ErrorCode::limit, "transformations together go beyond what a double can hold", {}};
                    return;
                }
                if (is_singular(*place)) return add_constant(negated);
            } else if (expr->operation() == Operation::complement) {
                negated = !negated;
            } else {
                break;
            }
            expr = &expr->operands().front();
        }
        if (expr->operation() == Operation::primitive)
            add_leaf(expr->primitive(), place ? *place : composed, negated);
        else
            open_operation(*expr, place, place == &composed, negated);
    }

    void open_operation(const Expr& expr, const Affine* place, bool composed, bool negated) {
        Frame frame{};
        frame.operands = &expr.operands();
        frame.next = expr.operands().size();
        frame.begin = form_.tokens.size();
        frame.first_leaf = form_.leaves.size();
        switch (expr.operation()) {
            case Operation::symmetric_difference:
                frame.kind = NormalKind::symmetric_difference;
                frame.flipped = negated;
                break;
            case Operation::difference:
                if (expr.operands().empty()) return add_constant(negated);
                frame.kind = negated ? NormalKind::union_of : NormalKind::intersection;
                frame.difference = true;
                frame.negate_all = negated;
                break;
            default:
                frame.kind = (expr.operation() == Operation::union_of) != negated ? NormalKind::union_of
                                                                                  : NormalKind::intersection;
                frame.negate_all = negated;
        }
        if (!frames_.empty() && frames_.back().kind == frame.kind) {
            frame.melted = true;
            frame.flipped = false;
            if (frame.kind == NormalKind::symmetric_difference && negated) toggle();
        }
        frame.composed = composed;
        frame.place = composed ? &composed_.emplace_back(*place) : place;
        frames_.push_back(frame);
    }

    void add_leaf(const Primitive& primitive, const Affine& place, bool negated) {
        if (!csg::is_finite(primitive)) {
            error_ = Error{ErrorCode::bad_input, "a parameter of a primitive is not a finite number", {}};
            return;
        }
        if (std::holds_alternative<Everything>(primitive)) return add_constant(!negated);
        if (is_degenerate(primitive)) return add_constant(negated);
        if (form_.leaves.size() >= options_.max_leaves) {
            error_ = limit_error(options_.max_leaves);
            return;
        }
        const auto index = static_cast<std::uint32_t>(form_.leaves.size());
        PlacedPrimitive& leaf = form_.leaves.emplace_back();
        leaf.primitive = &primitive;
        leaf.place = place;
        form_.tokens.push_back({NormalKind::leaf, negated, 1, index});
        if (!frames_.empty()) ++frames_.back().count;
    }

    /// An operand that is everything or nothing.
    void add_constant(bool value) {
        if (frames_.empty()) {
            constant_ = value;
            return;
        }
        switch (frames_.back().kind) {
            case NormalKind::symmetric_difference:
                if (value) toggle();
                break;
            case NormalKind::union_of:
                decide(value);
                break;
            default:
                decide(!value);
        }
    }

    /// Complements the symmetric difference that is being written.
    void toggle() {
        for (auto frame = frames_.rbegin();; ++frame)
            if (!frame->melted) {
                frame->flipped = !frame->flipped;
                return;
            }
    }

    /// A union met everything or an intersection nothing; those melted together are decided together.
    void decide(bool absorbing) {
        if (!absorbing) return;
        for (auto frame = frames_.rbegin();; ++frame) {
            frame->decided = true;
            if (!frame->melted) return;
        }
    }

    void close() {
        const Frame frame = frames_.back();
        frames_.pop_back();
        if (frame.composed) composed_.pop_back();
        if (frame.melted) {
            frames_.back().count += frame.count;
            return;
        }
        if (frame.decided) {
            form_.tokens.resize(frame.begin);
            form_.leaves.resize(frame.first_leaf);
            return add_constant(frame.kind == NormalKind::union_of);
        }
        if (frame.count == 0) return add_constant(frame.kind == NormalKind::intersection || frame.flipped);
        if (frame.count == 1) return close_single(frame);
        const std::size_t size = form_.tokens.size() - frame.begin + 1;
        form_.tokens.push_back({frame.kind, frame.flipped, static_cast<std::uint32_t>(size), 0});
        if (!frames_.empty()) ++frames_.back().count;
    }

    /// One operand is left: it takes the place of the operation.
    void close_single(const Frame& frame) {
        if (frame.flipped) complement_sub_tree(frame.begin);
        if (frames_.empty()) return;
        Frame& outer = frames_.back();
        // An operand of the outer operation's own kind melts into it; its operands are already in place.
        const NormalToken operand = form_.tokens.back();
        if (operand.kind != outer.kind) {
            ++outer.count;
            return;
        }
        form_.tokens.pop_back();
        if (operand.complemented) toggle();
        outer.count += operands_in(form_.tokens.size(), operand.size - 1);
    }

    std::uint32_t operands_in(std::size_t end, std::uint32_t tokens) const {
        std::uint32_t count = 0;
        while (tokens > 0) {
            const std::uint32_t size = form_.tokens[end - 1].size;
            end -= size;
            tokens -= size;
            ++count;
        }
        return count;
    }

    /// De Morgan on tokens that are already written.
    void complement_sub_tree(std::size_t begin) {
        std::size_t index = form_.tokens.size();
        while (index > begin) {
            NormalToken& token = form_.tokens[--index];
            switch (token.kind) {
                case NormalKind::union_of:
                    token.kind = NormalKind::intersection;
                    break;
                case NormalKind::intersection:
                    token.kind = NormalKind::union_of;
                    break;
                case NormalKind::symmetric_difference:
                    token.complemented = !token.complemented;
                    index -= token.size - 1;  // its operands stay as they are
                    break;
                default:
                    token.complemented = !token.complemented;
            }
        }
    }

    const NormalFormOptions& options_;
    NormalForm form_;
    std::vector<Frame> frames_;
    std::deque<Affine> composed_;  // where they are they stay
    std::optional<Error> error_;
    bool constant_ = false;
};

}  // namespace

Result<NormalForm> normal_form(const Expr& expression, const NormalFormOptions& options) {
    return Normaliser(options).run(expression);
}

}  // namespace octavo::csg
