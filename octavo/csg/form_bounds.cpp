// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/csg/form_bounds.hpp>

namespace octavo::csg {
namespace {

constexpr double infinity = Box3::infinity;
constexpr Box3 whole{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};

Box3 meet(const Box3& a, const Box3& b) {
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::max(a.low[axis], b.low[axis]);
        box.high[axis] = std::min(a.high[axis], b.high[axis]);
    }
    return box;
}

bool has_interior(const Box3& box) {
    return box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z;
}

using Token = FormBounds::Token;

/// Operands that leave the outside of their box open take part where they decide: those that are nothing there in an
/// intersection, those that are full there in a union. When there are none, boxes add.
Token bounds_of_operation(const NormalForm& form, const std::vector<Token>& tokens, std::size_t index) {
    const NormalToken& operation = form.tokens[index];
    const bool intersects = operation.kind == NormalKind::intersection;
    Token sum{{}, operation.kind == NormalKind::symmetric_difference ? operation.complemented : intersects};
    Token meeting{whole, !intersects};
    bool meets = false;
    for (std::size_t at = index + 1; at < index + operation.size; at += form.tokens[at].size) {
        const Token& operand = tokens[at];
        if (operation.kind == NormalKind::symmetric_difference) {
            sum.full_outside ^= operand.full_outside;
        } else if (operand.full_outside != intersects) {
            meeting.box = meet(meeting.box, operand.box);
            meets = true;
        }
        sum.box.add(operand.box);
    }
    Token& result = meets ? meeting : sum;
    if (result.box.empty()) result.box = {};
    return result;
}

/// Writes tokens anew, in place: what is written never overtakes what is read.
class Dropping {
  public:
    Dropping(NormalForm& form, const FormBounds& bounds, double margin)
        : form_(form), bounds_(bounds), margin_(margin) {}

    void run() {
        const std::size_t end = form_.tokens.size();
        for (std::size_t at = 0; at < end;) {
            const NormalToken token = form_.tokens[at];
            const Box3 reach = meet(open_.empty() ? whole : open_.back().reach, box_of(at));
            const bool leaf = token.kind == NormalKind::leaf;
            if (token.kind != NormalKind::constant && !has_interior(reach)) {
                write({NormalKind::constant, bounds_.tokens[at].full_outside, 1, 0});
                at += token.size;
            } else {
                if (!leaf && token.kind != NormalKind::constant)
                    open_.push_back({at + token.size, written_, reach});
                write(token);
                ++at;
            }
            for (; !open_.empty() && open_.back().end == at; open_.pop_back())
                form_.tokens[open_.back().at].size = static_cast<std::uint32_t>(written_ - open_.back().at);
        }
        form_.tokens.resize(written_);
    }

  private:
    struct Open {
        std::size_t end;  // among the tokens read
        std::size_t at;   // among those written
        Box3 reach;
    };

    Box3 box_of(std::size_t at) const {
        Box3 box = bounds_.tokens[at].box;
        for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] -= margin_;
            box.high[axis] += margin_;
        }
        return box;
    }
    void write(const NormalToken& token) { form_.tokens[written_++] = token; }

    NormalForm& form_;
    const FormBounds& bounds_;
    double margin_;
    std::size_t written_ = 0;
    std::vector<Open> open_;
};

}  // namespace

Box3 FormBounds::box() const { return tokens.front().full_outside ? whole : tokens.front().box; }

FormBounds form_bounds(const NormalForm& form) {
    FormBounds result;
    result.leaves.reserve(form.leaves.size());
    for (const PlacedPrimitive& leaf : form.leaves)
        result.leaves.push_back(bounds(*leaf.primitive, leaf.place));
    result.tokens.resize(form.tokens.size());
    // Backwards, so that the operands of an operation are known when it is reached.
    for (std::size_t index = form.tokens.size(); index-- > 0;) {
        const NormalToken& token = form.tokens[index];
        Token& bounds = result.tokens[index];
        if (token.kind == NormalKind::leaf || token.kind == NormalKind::constant) {
            bounds.full_outside = token.complemented;
            if (token.kind == NormalKind::leaf) bounds.box = result.leaves[token.leaf];
        } else {
            bounds = bounds_of_operation(form, result.tokens, index);
        }
    }
    return result;
}

void drop_out_of_reach(NormalForm& form, const FormBounds& bounds, double margin) {
    Dropping(form, bounds, margin).run();
}

}  // namespace octavo::csg
