// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

#include <octavo/io/input.hpp>
#include <octavo/io/openscad_csg.hpp>
#include <octavo/io/openscad_csg_geometry.hpp>

namespace octavo::io {
namespace {

using namespace openscad;

class Evaluator {
  public:
    Evaluator(const Syntax& syntax, const std::string& folder, const CsgReadOptions& options,
              const Context& context)
        : syntax_(syntax), folder_(folder), options_(options), context_(context) {}

    Result<CsgFile> run() {
        if (syntax_.nodes.empty()) return syntax_.error_at(0, "the file holds no node", ErrorCode::bad_input);
        mark();
        geometry_.resize(syntax_.nodes.size());
        // Leaves in the order of the file, so that the first one that is wrong is reported first; then operations,
        // from the last on, as children have greater indices than their parents.
        const std::size_t count = syntax_.nodes.size();
        for (std::size_t step = 0; step < 2 * count; ++step) {
            if (step % 256 == 0 && context_.cancelled()) return Context::cancelled_error();
            const std::size_t i = step < count ? step : 2 * count - 1 - step;
            if (marks_[i] & (skipped | made)) continue;
            std::optional<Result<Geometry>> geometry = step < count ? leaf(i) : operation(i);
            if (!geometry) continue;
            if (!*geometry) return with_place(geometry->error(), syntax_.nodes[i]);
            geometry_[i] = std::move(**geometry);
            marks_[i] |= made;
        }
        return finish();
    }

  private:
    static constexpr std::uint8_t skipped = 1, faceted = 2, made = 4;

    /// Which nodes are left out and which are below one that needs polyhedra: parents come first. With a '!', only
    /// that sub-tree is evaluated.
    void mark() {
        marks_.assign(syntax_.nodes.size(), 0);
        const auto alone = std::find_if(syntax_.nodes.begin(), syntax_.nodes.end(),
                                        [](const Node& node) { return node.alone && !node.disabled; });
        alone_ = alone == syntax_.nodes.end() ? no_node
                                              : static_cast<std::uint32_t>(alone - syntax_.nodes.begin());
        for (std::size_t i = 0; i < syntax_.nodes.size(); ++i) {
            const Node& node = syntax_.nodes[i];
            std::uint8_t mark = options_.faceted ? faceted : std::uint8_t{0};
            if (node.parent != no_node) {
                mark = marks_[node.parent];
                if (needs_facets(syntax_.nodes[node.parent].name)) mark |= faceted;
            } else if (alone_ != no_node) {
                mark |= skipped;
            }
            if (i == alone_) mark = static_cast<std::uint8_t>(mark & ~skipped);
            if (node.background || node.disabled) mark |= skipped;
            marks_[i] = mark;
        }
    }

    Scope scope_of(std::size_t index) {
        return {syntax_,
                options_,
                context_,
                folder_,
                file_.warnings,
                file_.files,
                (marks_[index] & faceted) != 0};
    }
    /// Nothing when the node is an operation.
    std::optional<Result<Geometry>> leaf(std::size_t index) {
        std::optional<Result<Geometry>> made_leaf = make_leaf(syntax_.nodes[index], scope_of(index));
        if (made_leaf) ++file_.primitives;
        return made_leaf;
    }
    Result<Geometry> operation(std::size_t index) {
        const Node& node = syntax_.nodes[index];
        return make_inner(node, children_of(node.first_child), scope_of(index));
    }

    std::vector<Geometry> children_of(std::uint32_t first) {
        std::vector<Geometry> children;
        for (std::uint32_t child = first; child != no_node; child = syntax_.nodes[child].next_sibling)
            if (!(marks_[child] & skipped)) children.push_back(std::exchange(geometry_[child], {}));
        return children;
    }

    Error with_place(Error error, const Node& node) const {
        if (error.place.line == 0 && error.code != ErrorCode::cancelled) {
            Error placed =
                syntax_.error_at(node.place, std::string(node.name) + "(…): " + error.sentence, error.code);
            return placed;
        }
        return error;
    }

    Result<CsgFile> finish() {
        const Scope scope{syntax_, options_, context_, folder_, file_.warnings, file_.files, true};
        Node top;
        top.name = "the file";
        Geometry geometry;
        if (alone_ != no_node && !(marks_[alone_] & skipped))
            geometry = std::move(geometry_[alone_]);
        else
            geometry = unite(top, children_of(0), scope);
        if (geometry.is_flat())
            return syntax_.error_at(syntax_.nodes.front().place, "the tree is flat: it has no solid part",
                                    ErrorCode::not_a_solid);
        if (geometry.is_solid())
            file_.expression = std::move(geometry.solid);
        else
            file_.warnings.push_back("the solid is empty");
        file_.nodes = syntax_.nodes.size();
        return std::move(file_);
    }

    const Syntax& syntax_;
    const std::string& folder_;
    const CsgReadOptions& options_;
    const Context& context_;
    std::vector<std::uint8_t> marks_;
    std::vector<Geometry> geometry_;
    std::uint32_t alone_ = no_node;
    CsgFile file_;
};

}  // namespace

Result<CsgFile> read_csg_text(std::string_view text, const std::string& folder, const CsgReadOptions& options,
                              const Context& context) {
    Result<Syntax> syntax = parse(text, options, context);
    if (!syntax) return syntax.error();
    return Evaluator(*syntax, folder, options, context).run();
}

Result<CsgFile> read_csg(const std::string& path, const CsgReadOptions& options, const Context& context) {
    Result<ByteBlock> bytes = read_bytes(path, context);
    if (!bytes) return bytes.error();
    const std::string folder =
        path == "-" ? std::string(".") : std::filesystem::path(path).parent_path().string();
    Result<CsgFile> file = read_csg_text(text_of(bytes->bytes()), folder, options, context);
    if (file) return file;
    Error error = file.error();
    error.place.file = path;
    return error;
}

}  // namespace octavo::io
