// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

#include <octavo/hexmesh/separating_surface.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/materials.hpp>
#include <octavo/mesh/snap.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::NodeIndex;
using mesh::SolidIndex;
using Solids = std::vector<SolidIndex>;

Separation separation_of(const Solids& a, const Solids& b) {
    Separation result;
    std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result.one_side));
    std::set_difference(b.begin(), b.end(), a.begin(), a.end(), std::back_inserter(result.other_side));
    if (result.other_side < result.one_side) std::swap(result.one_side, result.other_side);
    return result;
}

/// Numbers the separations and notes which node has which.
class NodeCollector {
  public:
    explicit NodeCollector(const mesh::HexMesh& mesh) : materials_(mesh::materials_of(mesh)) {
        const mesh::AllSides sides = mesh::all_sides(mesh);
        for (const mesh::InnerSide& inner : sides.inner)
            add(inner.side.corners,
                number(materials_.of(mesh, inner.side.cell), materials_.of(mesh, inner.other)));
        for (const mesh::HexSide& side : sides.boundary)
            add(side.corners, number(materials_.of(mesh, side.cell), nothing));
        for (const mesh::CoveredInPart& part : sides.covered_in_part)
            for (std::size_t i = 0; i < 4; ++i)
                if (!part.covered[i])
                    add({&part.side.corners[i], 1}, number(materials_.of(mesh, part.side.cell), nothing));
    }

    SeparatingNodes take(const mesh::HexMesh& mesh) {
        std::vector<std::uint8_t> hangs(mesh.node_count(), 0);
        for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging) hangs[hanging.node] = 1;
        for (const mesh::FaceHangingNode& hanging : mesh.face_hanging) hangs[hanging.node] = 1;
        std::sort(at_.begin(), at_.end());
        at_.erase(std::unique(at_.begin(), at_.end()), at_.end());
        SeparatingNodes result;
        for (const auto& [node, id] : at_) {
            if (hangs[node]) continue;
            if (result.nodes.empty() || result.nodes.back() != node) {
                result.nodes.push_back(node);
                result.begin.push_back(static_cast<std::uint32_t>(result.ids.size()));
            }
            result.ids.push_back(id);
        }
        result.begin.push_back(static_cast<std::uint32_t>(result.ids.size()));
        result.separations = std::move(separations_);
        return result;
    }

  private:
    using Material = std::uint32_t;
    static constexpr Material nothing = ~Material{0};
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// `none` when nothing separates the materials.
    std::uint32_t number(Material a, Material b) {
        if (a == b) return none;
        const auto [at, fresh] = numbers_.try_emplace(std::minmax({a, b}), none);
        if (!fresh) return at->second;
        const auto solids = [&](Material m) { return m == nothing ? Solids{} : materials_.solids[m]; };
        Separation separation = separation_of(solids(a), solids(b));
        if (separation == Separation{}) return none;
        const auto known = std::find(separations_.begin(), separations_.end(), separation);
        at->second = static_cast<std::uint32_t>(known - separations_.begin());
        if (known == separations_.end()) separations_.push_back(std::move(separation));
        return at->second;
    }
    void add(std::span<const NodeIndex> nodes, std::uint32_t id) {
        if (id == none) return;
        for (const NodeIndex node : nodes) at_.push_back({node, id});
    }

    mesh::Materials materials_;
    std::vector<Separation> separations_;
    std::map<std::pair<Material, Material>, std::uint32_t> numbers_;
    std::vector<std::pair<NodeIndex, std::uint32_t>> at_;
};

enum class Use : std::uint8_t { none, alone, with_others };

/// Whether the mesh has cells of each solid, and cells that belong to others too.
std::vector<Use> uses_of(const mesh::HexMesh& mesh, std::size_t solids) {
    std::vector<Use> uses(solids, Use::none);
    for (const Solids& material : mesh::materials_of(mesh).solids)
        for (const SolidIndex solid : material) {
            OCTAVO_CHECK(solid < solids, "a mesh is fitted to the solids that it was made of");
            uses[solid] = std::max(uses[solid], material.size() > 1 ? Use::with_others : Use::alone);
        }
    return uses;
}

Result<query::ClosestQuery> closest_on(const mesh::Mesh& solid, bool has_sign, const Context& context) {
    Result<mesh::Snapped> snapped = mesh::snap(solid);
    if (!snapped) return snapped.error();
    const std::vector<classic::OpenEdge> open = classic::open_edges(snapped->mesh);
    if (!open.empty()) snapped->mesh = classic::close_holes(snapped->mesh, open);
    query::ClosestOptions asking;
    if (!has_sign) asking.sign = query::ClosestOptions::Sign::none;
    return query::ClosestQuery::build(snapped->mesh, asking, context);
}

/// The answers of all solids that the separations of some node name.
class Answers {
  public:
    Answers(const SeparatingNodes& nodes, std::span<const Vec3> points,
            const std::vector<std::optional<query::ClosestQuery>>& closest, const Context& context) {
        for (std::uint32_t i = 0; i < points.size(); ++i)
            for (const std::uint32_t id : nodes.of(i))
                for (const auto* side : {&nodes.separations[id].one_side, &nodes.separations[id].other_side})
                    for (const SolidIndex solid : *side) asked_.push_back({solid, i});
        std::sort(asked_.begin(), asked_.end());
        asked_.erase(std::unique(asked_.begin(), asked_.end()), asked_.end());
        for (std::size_t first = 0; first < asked_.size();) {
            const SolidIndex solid = asked_[first].first;
            std::vector<Vec3> of_solid;
            for (; first < asked_.size() && asked_[first].first == solid; ++first)
                of_solid.push_back(points[asked_[first].second]);
            const std::vector<query::Closest> answers = (*closest[solid])(of_solid, context);
            answers_.insert(answers_.end(), answers.begin(), answers.end());
        }
    }

    const query::Closest& of(SolidIndex solid, std::uint32_t point) const {
        const auto at = std::lower_bound(asked_.begin(), asked_.end(), std::pair(solid, point));
        return answers_[static_cast<std::size_t>(at - asked_.begin())];
    }

  private:
    std::vector<std::pair<SolidIndex, std::uint32_t>> asked_;
    std::vector<query::Closest> answers_;
};

}  // namespace

SeparatingNodes separating_nodes(const mesh::HexMesh& mesh) { return NodeCollector(mesh).take(mesh); }

Result<SeparatingSurfaces> SeparatingSurfaces::build(std::span<const mesh::Mesh> solids,
                                                     const mesh::HexMesh& mesh, const Context& context) {
    SeparatingSurfaces result;
    const std::vector<Use> uses = uses_of(mesh, solids.size());
    for (std::size_t solid = 0; solid < solids.size(); ++solid) {
        result.closest_.emplace_back();
        if (uses[solid] == Use::none) continue;
        Result<query::ClosestQuery> closest =
            closest_on(solids[solid], uses[solid] == Use::with_others, context);
        if (!closest) return closest.error();
        result.closest_.back() = std::move(*closest);
    }
    return result;
}

std::vector<query::Closest> SeparatingSurfaces::operator()(const SeparatingNodes& nodes,
                                                           std::span<const Vec3> points,
                                                           const Context& context) const {
    const Answers answers(nodes, points, closest_, context);
    const auto distance = [](const query::Closest* c) { return std::fabs(c->distance); };
    std::vector<query::Closest> result;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        const query::Closest* farthest = nullptr;
        for (const std::uint32_t id : nodes.of(i)) {
            const query::Closest* nearest = nullptr;
            for (const auto* side : {&nodes.separations[id].one_side, &nodes.separations[id].other_side}) {
                const query::Closest* of_union = nullptr;
                for (const SolidIndex solid : *side) {
                    const query::Closest& answer = answers.of(solid, i);
                    if (!of_union || answer.distance < of_union->distance) of_union = &answer;
                }
                if (of_union && (!nearest || distance(of_union) < distance(nearest))) nearest = of_union;
            }
            if (!farthest || distance(nearest) > distance(farthest)) farthest = nearest;
        }
        result.push_back(*farthest);
        result.back().distance = std::fabs(result.back().distance);
    }
    return result;
}

}  // namespace octavo::hexmesh
