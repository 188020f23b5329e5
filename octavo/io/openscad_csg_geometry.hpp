// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/csg/expression.hpp>
#include <octavo/csg/region.hpp>
#include <octavo/io/openscad_csg_parameters.hpp>

// What a node of a .csg tree is: nothing at all (% and *), empty, flat or solid; and what each kind of node makes of
// its parameters and of its children's geometry.

namespace octavo::io::openscad {

struct Geometry {
    enum class Kind : std::uint8_t { absent, empty, flat, solid } kind = Kind::absent;
    csg::Region region;
    csg::Expr solid;

    static Geometry none() { return {Kind::empty, {}, {}}; }
    static Geometry of(csg::Region region);
    static Geometry of(csg::Expr solid) { return {Kind::solid, {}, std::move(solid)}; }
    bool is_flat() const { return kind == Kind::flat; }
    bool is_solid() const { return kind == Kind::solid; }
};

/// What evaluating a node may use.
struct Scope {
    const Syntax& syntax;
    const CsgReadOptions& options;
    const Context& context;
    const std::string& folder;
    std::vector<std::string>& warnings;
    std::vector<std::string>& files;  ///< that were imported
    bool faceted;                     ///< round things must be polyhedra here

    void warn(const Node& node, const std::string& sentence) const;
    /// Whether a mesh of so many vertices is too large; then the error says so.
    std::optional<Error> too_large(const Node& node, double vertices) const;
    /// The same of something round that becomes a polygon or polyhedron.
    std::optional<Error> too_fine(const Node& node, int segments) const;
    /// An error that names the node; with `skip_unsupported` a warning and empty geometry.
    Result<Geometry> unsupported(const Node& node, const std::string& why) const;
};

/// A node without children: cube, sphere, cylinder, polyhedron, square, circle, polygon, import. Nothing when it is
/// not one of these.
std::optional<Result<Geometry>> make_leaf(const Node& node, const Scope& scope);

/// Any other node, from its children's geometry without absent ones. Errors: bad_input for an unknown name.
Result<Geometry> make_inner(const Node& node, std::vector<Geometry> children, const Scope& scope);

/// Whether the operands of this node must be polyhedra.
bool needs_facets(std::string_view name);

/// The children united; flat and solid ones do not mix, the first one's kind counts.
Geometry unite(const Node& node, std::vector<Geometry> children, const Scope& scope);

}  // namespace octavo::io::openscad
