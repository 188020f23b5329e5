// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <octavo/classic/facet_lists.hpp>
#include <octavo/hexmesh/cell_tree.hpp>
#include <octavo/hexmesh/cell_volume.hpp>
#include <octavo/hexmesh/classify.hpp>
#include <octavo/octree/descend.hpp>

namespace octavo::hexmesh {
namespace {

using classic::FacetRange;
using octree::Cell;
using octree::CellKey;

/// A solid as a cell sees it: what its facets there are, or, with none, that the cell lies inside.
struct LocalSolid {
    mesh::SolidIndex solid = 0;
    bool touched = false;  ///< a facet meets the open cell; the list may be missing on the last level
    FacetRange range;
};

struct SolidsInCell {
    std::uint32_t begin = 0, end = 0;                ///< in the workspace's buffer of the cell's level
    std::uint32_t facets = 0;                        ///< in all their lists
    std::uint32_t first_target = 0, end_target = 0;  ///< the given cells inside this one
};

struct Workspace {
    std::vector<classic::FacetLists> lists;  ///< per solid
    std::array<std::vector<LocalSolid>, octree::max_level + 1> solids;
    struct Octants {
        classic::OctantFacets found;
        std::array<FacetRange, 8> ranges;
    };
    std::vector<Octants> octants;  ///< per solid of the cell at hand
};

/// Sets of solids by number, in the order in which they are met.
class SetTable {
  public:
    /// Twice the index of a solid, plus one where its surface passes through; ascending.
    using Signature = std::vector<std::uint32_t>;

    SetTable() { number_of({}); }
    SetTable(SetTable&&) = default;
    SetTable& operator=(SetTable&&) = default;

    std::uint32_t number_of(const Signature& signature) {
        if (!all_.empty() && is_last(signature)) return last_number_;
        const auto [at, fresh] = numbers_.try_emplace(signature, static_cast<std::uint32_t>(all_.size()));
        if (fresh) all_.push_back(&at->first);
        last_ = &at->first;
        last_number_ = at->second;
        return last_number_;
    }
    std::size_t size() const { return all_.size(); }
    const Signature& operator[](std::size_t number) const { return *all_[number]; }

  private:
    /// Nearly always there is one solid, for which the call that compares vectors is most of the work.
    bool is_last(const Signature& signature) const {
        if (signature.size() != last_->size()) return false;
        for (std::size_t i = 0; i < signature.size(); ++i)
            if (signature[i] != (*last_)[i]) return false;
        return true;
    }

    std::map<Signature, std::uint32_t> numbers_;  // its keys stay where they are
    std::vector<const Signature*> all_;
    const Signature* last_ = nullptr;
    std::uint32_t last_number_ = 0;
};

class SolidsProblem;

class CellOutput {
  public:
    explicit CellOutput(const SolidsProblem* problem) : problem_(problem) {}

    void split(const Cell&, const SolidsInCell&, const Workspace&) {}
    void leaf(const Cell& cell, const octree::Restricted<SolidsInCell>& leaf, const Workspace& workspace);
    void merge(const Cell&, octree::Color) {}  // never: all leaves are given as gray
    void append(CellOutput&& next);

    Result<ClassifiedCells> take() &&;

  private:
    void note_overlap(const Cell& cell, const LocalSolid& local, std::span<const std::uint32_t> list);

    const SolidsProblem* problem_;
    SetTable sets_;
    SetTable::Signature signature_;
    ClassifiedCells cells_;
    bool too_many_sets_ = false;
};

/// The problem of the descent: cells are split as the size field asks or, when cells are given, as they say.
class SolidsProblem {
  public:
    using Description = SolidsInCell;
    using Workspace = hexmesh::Workspace;
    using Output = CellOutput;

    SolidsProblem(std::span<const SolidFacets> solids, const SizeField* sizes,
                  std::span<const CellKey> targets, const Options& options)
        : solids_(solids), sizes_(sizes), targets_(targets), options_(options) {
        if (sizes) depth_ = sizes->deepest();
        for (const CellKey key : targets) depth_ = std::max(depth_, key.level());
    }

    int depth() const { return depth_; }
    Output make_output() const { return Output(this); }
    Workspace make_workspace() const {
        Workspace workspace;
        workspace.lists.resize(solids_.size());
        return workspace;
    }
    std::size_t weight(const SolidsInCell& in) const { return in.facets; }
    bool computes_fractions() const { return options_.fractions == Fractions::compute; }
    std::span<const classic::Facet> facets(mesh::SolidIndex solid) const { return solids_[solid].facets; }

    octree::Restricted<SolidsInCell> root(Workspace& workspace) const {
        std::vector<LocalSolid>& locals = workspace.solids[0];
        locals.clear();
        SolidsInCell in;
        for (mesh::SolidIndex solid = 0; solid < solids_.size(); ++solid) {
            LocalSolid local;
            local.solid = solid;
            local.range = universe_facets(facets(solid), classic::Touch::interior, workspace.lists[solid]);
            local.touched = local.range.size() > 0;
            if (local.touched || local.range.winding != 0) locals.push_back(local);
            in.facets += local.range.size();
        }
        in.end = static_cast<std::uint32_t>(locals.size());
        in.end_target = static_cast<std::uint32_t>(targets_.size());
        return {is_to_be_split(Cell::root(), in, workspace) ? octree::Node::split : octree::Node::gray, in};
    }

    void restrict_to_children(const Cell& cell, const SolidsInCell& in, Workspace& workspace,
                              octree::Children<SolidsInCell>& children) const {
        find_octants(cell, in, workspace);
        const auto level = static_cast<std::size_t>(cell.level);
        const std::vector<LocalSolid>& locals = workspace.solids[level];
        std::vector<LocalSolid>& next = workspace.solids[level + 1];
        next.clear();
        std::uint32_t target = in.first_target;
        for (std::size_t octant = 0; octant < 8; ++octant) {
            SolidsInCell& child = children[octant].description;
            child = {static_cast<std::uint32_t>(next.size()), 0, 0, 0, 0};
            for (std::uint32_t i = in.begin; i < in.end; ++i) {
                const Workspace::Octants& octants = workspace.octants[i - in.begin];
                const bool touched = octants.found.touched >> octant & 1;
                if (!touched && octants.found.winding[octant] == 0) continue;
                FacetRange range = octants.ranges[octant];
                range.winding = octants.found.winding[octant];
                child.facets += range.size();
                next.push_back({locals[i].solid, touched, range});
            }
            child.end = static_cast<std::uint32_t>(next.size());
            const Cell child_cell = cell.child(static_cast<int>(octant));
            child.first_target = target;
            while (target < in.end_target && targets_[target] <= child_cell.key().last_descendant()) {
                // Most octants hold one target, or all that is left of a large one: step, then search.
                if (target > child.first_target) {
                    const auto end =
                        std::upper_bound(targets_.begin() + target, targets_.begin() + in.end_target,
                                         child_cell.key().last_descendant());
                    target = static_cast<std::uint32_t>(end - targets_.begin());
                    break;
                }
                ++target;
            }
            child.end_target = target;
            children[octant].node =
                is_to_be_split(child_cell, child, workspace) ? octree::Node::split : octree::Node::gray;
        }
    }

    SolidsInCell transfer(const Cell& cell, const SolidsInCell& in, const Workspace& from,
                          Workspace& to) const {
        const auto level = static_cast<std::size_t>(cell.level);
        std::vector<LocalSolid>& locals = to.solids[level];
        locals.assign(from.solids[level].begin() + in.begin, from.solids[level].begin() + in.end);
        for (LocalSolid& local : locals)
            local.range =
                classic::transfer(cell, local.range, from.lists[local.solid], to.lists[local.solid]);
        SolidsInCell moved = in;
        moved.begin = 0;
        moved.end = static_cast<std::uint32_t>(locals.size());
        return moved;
    }

  private:
    /// Octants of this level get their facets' lists only when something will look at them.
    bool needs_lists(int level) const { return level < depth_ || computes_fractions(); }

    /// What each solid's facets say about the octants, to `workspace.octants`.
    void find_octants(const Cell& cell, const SolidsInCell& in, Workspace& workspace) const {
        const bool lists = needs_lists(cell.level + 1);
        workspace.octants.resize(in.end - in.begin);
        for (std::uint32_t i = in.begin; i < in.end; ++i) {
            const LocalSolid local = workspace.solids[static_cast<std::size_t>(cell.level)][i];
            Workspace::Octants& octants = workspace.octants[i - in.begin];
            octants.ranges = {};
            if (!local.touched) {
                octants.found.touched = 0;
                octants.found.winding.fill(local.range.winding);
                continue;
            }
            classic::FacetLists& of_solid = workspace.lists[local.solid];
            constexpr classic::Touch interior = classic::Touch::interior;
            octants.found =
                lists ? classic::find_octants<interior>(facets(local.solid), cell, local.range, of_solid)
                      : classic::find_touched<interior>(facets(local.solid), cell, local.range, of_solid);
            if (lists) octants.ranges = distribute(cell, local.range, octants.found, of_solid);
        }
    }

    bool is_to_be_split(const Cell& cell, const SolidsInCell& in, const Workspace& workspace) const {
        if (!sizes_) return in.end_target - in.first_target > 1;
        if (cell.level >= depth_) return false;
        const bool in_mesh = in.begin != in.end || options_.keep == Keep::all;
        int level = in_mesh ? sizes_->level_in(cell) : 0;
        const auto depth = static_cast<std::size_t>(cell.level);
        for (std::uint32_t i = in.begin; i < in.end && level <= cell.level; ++i) {
            const LocalSolid& local = workspace.solids[depth][i];
            level = std::max(level, local.touched ? sizes_->surface_level(local.solid) : 0);
            level = std::max(level, sizes_->interior_level(local.solid));
            if (local.touched && sizes_->looks_at_facets() &&
                sizes_->is_too_coarse_for(cell.level, facets(local.solid),
                                          workspace.lists[local.solid].list(cell.level, local.range)))
                return true;
        }
        return level > cell.level;
    }

    std::span<const SolidFacets> solids_;
    const SizeField* sizes_;
    std::span<const CellKey> targets_;
    const Options& options_;
    int depth_ = 0;
};

void CellOutput::leaf(const Cell& cell, const octree::Restricted<SolidsInCell>& leaf,
                      const Workspace& workspace) {
    const SolidsInCell& in = leaf.description;
    const std::vector<LocalSolid>& locals = workspace.solids[static_cast<std::size_t>(cell.level)];
    signature_.clear();
    for (std::uint32_t i = in.begin; i < in.end; ++i) {
        const LocalSolid& local = locals[i];
        const std::int32_t winding = local.range.winding;
        if (local.touched || winding > 0) signature_.push_back(2 * local.solid + (local.touched ? 1 : 0));
        if (!local.touched && winding == 1) continue;
        const std::span<const std::uint32_t> list =
            workspace.lists[local.solid].list(cell.level, local.range);
        if (winding != 0 && winding != 1) note_overlap(cell, local, list);
        if (local.touched && problem_->computes_fractions())
            cells_.fractions.push_back(filled_part(problem_->facets(local.solid), list, cell, winding));
    }
    const std::uint32_t number = sets_.number_of(signature_);
    too_many_sets_ = too_many_sets_ || number > 0xFFFF;
    cells_.keys.push_back(cell.key());
    cells_.set_of_cell.push_back(static_cast<std::uint16_t>(number));
}

/// The facet whose box is nearest to the cell: where walls between cells hold all facets, no cell has a list.
std::uint32_t nearest_facet(std::span<const classic::Facet> facets, const Cell& cell) {
    std::size_t nearest = 0;
    std::int64_t least = std::int64_t{1} << 62;
    const exact::Point high = cell.high();
    for (std::size_t i = 0; i < facets.size(); ++i) {
        std::int64_t distance = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            distance = std::max<std::int64_t>({distance, facets[i].low[k] - std::int64_t{high[axis]},
                                               cell.low[axis] - std::int64_t{facets[i].high[k]}});
        }
        if (distance < least) least = distance, nearest = i;
    }
    return facets[nearest].source;
}

void CellOutput::note_overlap(const Cell& cell, const LocalSolid& local,
                              std::span<const std::uint32_t> list) {
    if (!cells_.overlap.empty()) return;
    constexpr std::size_t enough = 4;
    for (std::size_t i = 0; i < std::min(list.size(), enough); ++i)
        cells_.overlap.push_back(problem_->facets(local.solid)[list[i]].source);
    if (list.empty()) cells_.overlap.push_back(nearest_facet(problem_->facets(local.solid), cell));
    cells_.overlapping_solid = local.solid;
}

void CellOutput::append(CellOutput&& next) {
    std::vector<std::uint16_t> renumbered(next.sets_.size());
    for (std::size_t i = 0; i < renumbered.size(); ++i) {
        const std::uint32_t number = sets_.number_of(next.sets_[i]);
        too_many_sets_ = too_many_sets_ || number > 0xFFFF;
        renumbered[i] = static_cast<std::uint16_t>(number);
    }
    cells_.keys.insert(cells_.keys.end(), next.cells_.keys.begin(), next.cells_.keys.end());
    cells_.set_of_cell.reserve(cells_.keys.size());
    for (const std::uint16_t number : next.cells_.set_of_cell)
        cells_.set_of_cell.push_back(renumbered[number]);
    cells_.fractions.insert(cells_.fractions.end(), next.cells_.fractions.begin(),
                            next.cells_.fractions.end());
    too_many_sets_ = too_many_sets_ || next.too_many_sets_;
    if (cells_.overlap.empty()) {
        cells_.overlap = std::move(next.cells_.overlap);
        cells_.overlapping_solid = next.cells_.overlapping_solid;
    }
    next = CellOutput(problem_);
}

Result<ClassifiedCells> CellOutput::take() && {
    if (too_many_sets_) return too_many_sets();
    if (cells_.keys.size() > CellTree::most_leaves)
        return Error{ErrorCode::limit, "the octree has more than 2^31 - 2 cells", {}};
    for (std::size_t i = 0; i < sets_.size(); ++i) {
        mesh::SolidSet& set = cells_.sets.emplace_back();
        for (const std::uint32_t entry : sets_[i])
            (entry & 1 ? set.boundary : set.inside).push_back(entry / 2);
    }
    return std::move(cells_);
}

Result<ClassifiedCells> run(const SolidsProblem& problem, const char* phase, std::uint64_t max_cells,
                            const Context& context) {
    // Every cell that is split adds eight nodes, of which seven more are leaves.
    const std::uint64_t max_nodes = max_cells + max_cells / 7;
    Result<CellOutput> output = octree::descend(problem, context, {.phase = phase, .max_nodes = max_nodes});
    if (output) return std::move(*output).take();
    if (output.error().code == ErrorCode::limit) return too_many_cells(max_cells);
    return output.error();
}

}  // namespace

Error too_many_cells(std::uint64_t max_cells) {
    return {
        ErrorCode::limit,
        "the octree has more than " + grouped(max_cells) + " cells; ask for larger cells, or raise the limit",
        {},
        "max_cells"};
}

Error too_many_sets() {
    return {ErrorCode::limit, "the solids overlap in more than 65536 different ways", {}};
}

Result<ClassifiedCells> refine(std::span<const SolidFacets> solids, const SizeField& sizes,
                               const Options& options, const Context& context) {
    return run(SolidsProblem(solids, &sizes, {}, options), "refine", options.max_cells, context);
}

Result<ClassifiedCells> classify(std::span<const SolidFacets> solids, std::span<const CellKey> keys,
                                 const Options& options, const Context& context) {
    return run(SolidsProblem(solids, nullptr, keys, options), "classify", options.max_cells, context);
}

}  // namespace octavo::hexmesh
