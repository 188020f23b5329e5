// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include <octavo/base/check.hpp>
#include <octavo/csg/expression.hpp>

namespace octavo::csg {

Expr::Node::~Node() {
    // Nodes that only this one holds are taken apart here, one after the other: a deep tree would otherwise be
    // destroyed by recursion and overrun the stack.
    std::vector<Expr> doomed = std::move(operands);
    while (!doomed.empty()) {
        const Expr expr = std::move(doomed.back());
        doomed.pop_back();
        if (expr.node_ && expr.node_.use_count() == 1) {
            // The last holder may take the operands of a node that is const to everybody else.
            std::vector<Expr>& below = const_cast<Node&>(*expr.node_).operands;
            for (Expr& operand : below) doomed.push_back(std::move(operand));
            below.clear();
        }
    }
}

namespace {

std::shared_ptr<const Expr::Node> empty_solid() {
    static const std::shared_ptr<const Expr::Node> node = std::make_shared<Expr::Node>();
    return node;
}

}  // namespace

Expr::Expr() : node_(empty_solid()) {}

Expr::Expr(Primitive primitive) {
    auto node = std::make_shared<Node>();
    node->operation = Operation::primitive;
    node->primitive = std::move(primitive);
    node_ = std::move(node);
}

Expr combine(Operation operation, std::vector<Expr> operands) {
    OCTAVO_CHECK(operation != Operation::primitive && operation != Operation::transform,
                 "combine takes a set operation");
    OCTAVO_CHECK(operation != Operation::complement || operands.size() == 1, "a complement has one operand");
    auto node = std::make_shared<Expr::Node>();
    node->operation = operation;
    node->operands = std::move(operands);
    return Expr(std::shared_ptr<const Expr::Node>(std::move(node)));
}

Expr transform(const Affine& map, Expr operand) {
    if (map == Affine{}) return operand;
    auto node = std::make_shared<Expr::Node>();
    node->operation = Operation::transform;
    node->map = map;
    node->operands.push_back(std::move(operand));
    return Expr(std::shared_ptr<const Expr::Node>(std::move(node)));
}

}  // namespace octavo::csg
