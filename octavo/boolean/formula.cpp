// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <octavo/boolean/formula.hpp>

namespace octavo::boolean {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name_part(char c) { return is_letter(c) || (c >= '0' && c <= '9'); }

class Parser {
  public:
    explicit Parser(std::string_view text) : text_(text) {}

    Result<Formula> run() {
        const std::optional<NodeId> root = sum();
        if (root && !at_end()) fail("an operator is missing");
        if (!error_.empty()) return Error{ErrorCode::bad_input, error_, {}};
        formula_.program.gate(Gate::any, {&*root, 1});  // the root is the last node
        return std::move(formula_);
    }

  private:
    using NodeId = Program::NodeId;
    static constexpr int deepest = 1000;  // of parentheses: the parser is recursive

    bool at_end() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
        return at_ == text_.size();
    }
    /// The next character if it is one of these.
    char take(std::string_view wanted) {
        if (at_end() || wanted.find(text_[at_]) == std::string_view::npos) return 0;
        return text_[at_++];
    }
    std::nullopt_t fail(const std::string& what) {
        if (error_.empty()) error_ = what + " at column " + std::to_string(at_ + 1) + " of the expression";
        return std::nullopt;
    }
    NodeId gate(Gate kind, NodeId first, NodeId second, bool second_negated) {
        const NodeId inputs[2] = {first, second};
        const bool negated[2] = {false, second_negated};
        return formula_.program.gate(kind, inputs, negated);
    }

    std::optional<NodeId> sum() {
        std::optional<NodeId> left = product();
        while (left) {
            const char operation = take("|+-^");
            if (!operation) break;
            const std::optional<NodeId> right = product();
            if (!right) return std::nullopt;
            left = operation == '-'   ? gate(Gate::all, *left, *right, true)
                   : operation == '^' ? gate(Gate::odd, *left, *right, false)
                                      : gate(Gate::any, *left, *right, false);
        }
        return left;
    }

    std::optional<NodeId> product() {
        std::optional<NodeId> left = factor();
        while (left && take("&*")) {
            const std::optional<NodeId> right = factor();
            if (!right) return std::nullopt;
            left = gate(Gate::all, *left, *right, false);
        }
        return left;
    }

    std::optional<NodeId> factor() {
        if (take("(")) {
            if (++depth_ > deepest) return fail("more than 1000 parentheses within one another");
            const std::optional<NodeId> inner = sum();
            if (!inner) return std::nullopt;
            if (!take(")")) return fail("a closing parenthesis is missing");
            --depth_;
            return inner;
        }
        if (at_end() || !is_letter(text_[at_])) return fail("a name or an opening parenthesis is missing");
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_name_part(text_[at_])) ++at_;
        const std::string name(text_.substr(begin, at_ - begin));
        const auto place = std::find(formula_.names.begin(), formula_.names.end(), name);
        const auto operand = static_cast<std::uint32_t>(place - formula_.names.begin());
        if (place == formula_.names.end()) formula_.names.push_back(name);
        return formula_.program.operand(operand);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::string error_;
    Formula formula_;
};

}  // namespace

Result<Formula> parse_formula(std::string_view text) { return Parser(text).run(); }

}  // namespace octavo::boolean
