// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include <octavo/hexmesh/classify.hpp>
#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/cubic_grid.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/hexmesh/size_field.hpp>
#include <octavo/mesh/used_vertices.hpp>
#include <octavo/query/inside.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

double base_size(const Options& options, const Box3& content) {
    const Vec3 extents = content.extents();
    return options.precision != 0 ? options.precision
                                  : std::ldexp(std::max({extents.x, extents.y, extents.z}), -options.level);
}

struct SmallestSize {
    double length;
    const char* option;  ///< that asks for it
};

/// The smallest length that the options ask for.
SmallestSize smallest_size(const Options& options, double base) {
    SmallestSize smallest{base, "the precision"};
    const auto at_most = [&](double length, const char* option) {
        if (length > 0 && length < smallest.length) smallest = {length, option};
    };
    at_most(options.largest, "the largest cell");
    at_most(options.curvature.smallest, "the smallest cell for curvature");
    at_most(options.proximity.smallest, "the smallest cell for proximity");
    for (const SolidSize& solid : options.solids) {
        at_most(solid.surface, "the surface size of a solid");
        at_most(solid.interior, "the interior size of a solid");
    }
    for (const BoxSize& box : options.boxes) at_most(box.size, "the size in a box");
    return smallest;
}

/// The grid, and what it takes to find places in it.
struct Grid {
    double base;  ///< side of cells of the last level
    CubicGrid cubic;

    double side_of(int level) const { return base / std::pow(3.0, cubic.last_level() - level); }
};

/// As many levels as it takes from the base to the smallest size.
Result<Grid> make_grid(const Options& options, const Box3& content) {
    constexpr int most_levels = 12;
    const double base = base_size(options, content);
    const SmallestSize smallest = smallest_size(options, base);
    int levels = 1;
    for (double side = base; side > smallest.length * (1 + 1e-12); side /= 3)
        if (++levels > most_levels)
            return Error{
                ErrorCode::limit,
                std::string(smallest.option) +
                    " is more than 3^11 times smaller than the general size of cells, the most that a "
                    "conforming mesh can do; give a smaller precision or level of its own",
                {}};
    constexpr double most_cells = 1 << 20;
    const double side = base / std::pow(3.0, levels - 1);
    for (const Vec3& corner : {content.low, content.high})
        for (int axis = 0; axis < 3; ++axis)
            if (std::fabs(corner[axis]) / side >= most_cells / 2)
                return Error{
                    ErrorCode::limit, "a conforming mesh reaches at most 2^19 cells from the origin", {}};
    return Grid{base, CubicGrid(levels, options.max_cells)};
}

/// Calls `visit` for the cells of side `side` that meet a box, until it says false; false then.
template <class Visit>
bool for_each_place(const Vec3& low, double reach, double side, const Visit& visit) {
    GridPlace first{}, last{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = low[static_cast<int>(axis)];
        first[axis] = static_cast<std::int64_t>(std::floor(at / side));
        last[axis] = static_cast<std::int64_t>(std::ceil((at + reach) / side));
    }
    for (std::int64_t z = first[2]; z < last[2]; ++z)
        for (std::int64_t y = first[1]; y < last[1]; ++y)
            for (std::int64_t x = first[0]; x < last[0]; ++x)
                if (!visit(GridPlace{x, y, z})) return false;
    return true;
}

/// The level of the grid's cells that an octant asks for: where a surface passes those of its own size, elsewhere those
/// that the size field wants.
int level_for(const mesh::HexMesh& octants, CellIndex cell, const SizeField& sizes, const Grid& grid) {
    const mesh::SolidSet& set = octants.set_of(cell);
    const octree::Cell octant = octree::Cell::of(octants.cells[cell]);
    int wanted = octant.level;
    if (set.boundary.empty()) {
        wanted = sizes.level_in(octant);
        for (const mesh::SolidIndex solid : set.inside)
            wanted = std::max(wanted, sizes.interior_level(solid));
    }
    // An octant of the base's size or larger may be up to half as large as the base: it asks for nothing.
    const double size = octants.lattice.unit() * octree::cell_side(wanted);
    if (2 * size > grid.base) return grid.cubic.last_level();
    int level = 0;
    while (level < grid.cubic.last_level() && grid.side_of(level + 1) <= size) ++level;
    return level;
}

double side_of(const mesh::HexMesh& octants, CellIndex cell) {
    return octants.lattice.unit() * octants.cells[cell].side();
}

/// Whether the grid will have more cells than allowed, as far as the octants' volume tells: their own cells fill them
/// at least. Known before anything is stored.
bool is_too_fine(const mesh::HexMesh& octants, const SizeField& sizes, const Grid& grid, double max_cells) {
    double least = 0;
    for (CellIndex cell = 0; cell < octants.cell_count(); ++cell)
        least += std::pow(side_of(octants, cell) / grid.side_of(level_for(octants, cell, sizes, grid)), 3);
    return least > max_cells * (1 + 1e-9);
}

/// Roots where the octree has cells, and smaller ones where it asks for them.
Status refine_like(const mesh::HexMesh& octants, const SizeField& sizes, const Options& options, Grid& grid,
                   const Context& context) {
    const auto may_go_on = [&] { return !grid.cubic.is_full() && !context.cancelled(); };
    if (is_too_fine(octants, sizes, grid, static_cast<double>(options.max_cells)))
        return too_many_cells(options.max_cells);
    bool done = true;
    for (CellIndex cell = 0; cell < octants.cell_count() && done; ++cell) {
        const Vec3 low = octants.lattice.to_world(octree::Cell::of(octants.cells[cell]).low);
        const double reach = side_of(octants, cell);
        done = for_each_place(low, reach, grid.base, [&](const GridPlace& place) {
            grid.cubic.add_root(place);
            return may_go_on();
        });
        const int level = level_for(octants, cell, sizes, grid);
        done = done && for_each_place(low, reach, grid.side_of(level), [&](const GridPlace& place) {
                   grid.cubic.refine_to(level, place);
                   return may_go_on();
               });
    }
    if (done) grid.cubic.close(context);
    if (context.cancelled()) return Context::cancelled_error();
    if (grid.cubic.is_full()) return too_many_cells(options.max_cells);
    return Done{};
}

/// A point of the grid, in parts of the smallest cells' sides.
struct GridPoint {
    TemplatePoint at;
    friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

struct GridPointHash {
    std::size_t operator()(const GridPoint& p) const {
        std::uint64_t h = 0;
        for (const std::int64_t v : p.at) {
            h = (h ^ static_cast<std::uint64_t>(v)) * 0x9E3779B97F4A7C15ULL;
            h ^= h >> 29;
        }
        return h;
    }
};

/// Hexahedra as they come out of the grid, before it is known which belong to the mesh.
struct LooseHexes {
    std::vector<TemplateHex> hexes;
    std::vector<Vec3> centres;
};

/// Stops soon after `max_cells` are exceeded, or the work is cancelled.
LooseHexes cut_leaves(const Grid& grid, std::uint64_t max_cells, const Context& context) {
    std::map<EdgeSet, std::vector<TemplateHex>> templates;
    LooseHexes loose;
    const double side = grid.side_of(0);
    grid.cubic.for_each_leaf([&](const CubicGrid::Leaf& leaf) {
        if (loose.hexes.size() > max_cells || context.cancelled()) return;
        auto found = templates.find(leaf.cut);
        if (found == templates.end()) found = templates.emplace(leaf.cut, cut_cell(leaf.cut)).first;
        OCTAVO_CHECK(!found->second.empty(), "every leaf of a closed grid has a template");
        std::int64_t scale = 1;
        for (int level = 0; level < leaf.level; ++level) scale *= 3;
        for (const TemplateHex& local : found->second) {
            TemplateHex& hex = loose.hexes.emplace_back();
            Vec3 sum;
            for (std::size_t corner = 0; corner < 8; ++corner)
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    hex[corner][axis] = scale * (leaf.place[axis] * template_side + local[corner][axis]);
                    sum[static_cast<int>(axis)] += static_cast<double>(hex[corner][axis]);
                }
            loose.centres.push_back((side / (8.0 * template_side)) * sum);
        }
    });
    return loose;
}

/// The solids that contain each centre.
Result<std::vector<std::vector<mesh::SolidIndex>>> solids_at(std::span<const mesh::Mesh> solids,
                                                             const std::vector<Vec3>& centres,
                                                             const Options& options, const Context& context) {
    std::vector<std::vector<mesh::SolidIndex>> found(centres.size());
    for (mesh::SolidIndex solid = 0; solid < solids.size(); ++solid) {
        query::InsideOptions asking;
        asking.open = options.open;
        const Result<query::InsideQuery> inside = query::InsideQuery::build(solids[solid], asking, context);
        if (!inside) return inside.error();
        const std::vector<query::Side> sides = (*inside)(centres, context);
        if (context.cancelled()) return Context::cancelled_error();
        for (std::size_t i = 0; i < centres.size(); ++i)
            if (sides[i] == query::Side::inside) found[i].push_back(solid);
    }
    return found;
}

Result<mesh::HexMesh> assemble(const LooseHexes& loose,
                               const std::vector<std::vector<mesh::SolidIndex>>& solids, double side) {
    mesh::HexMesh mesh;
    mesh.sets.push_back({});
    std::map<std::vector<mesh::SolidIndex>, std::uint16_t> sets;  // fits: checked before the next cell
    std::unordered_map<GridPoint, NodeIndex, GridPointHash> nodes;
    for (std::size_t i = 0; i < loose.hexes.size(); ++i) {
        if (solids[i].empty()) continue;
        const auto [set, fresh_set] =
            sets.try_emplace(solids[i], static_cast<std::uint16_t>(mesh.sets.size()));
        if (fresh_set) mesh.sets.push_back({solids[i], {}});
        if (mesh.sets.size() > most_sets) return too_many_sets();
        mesh.set_of_cell.push_back(set->second);
        std::array<NodeIndex, 8>& corners = mesh.corners.emplace_back();
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const TemplatePoint& at = loose.hexes[i][corner];
            const auto [node, fresh] = nodes.try_emplace(GridPoint{at}, static_cast<NodeIndex>(nodes.size()));
            if (fresh)
                mesh.positions.push_back((side / template_side) * Vec3{static_cast<double>(at[0]),
                                                                       static_cast<double>(at[1]),
                                                                       static_cast<double>(at[2])});
            corners[corner] = node->second;
        }
    }
    return mesh;
}

/// Counts what the mesh has; sizes are edges of the least and the largest cube with the cells' volume.
void measure(const mesh::HexMesh& mesh, Report& report) {
    report.inside_cells = mesh.cell_count();
    report.boundary_cells = 0;
    report.cells_of_level = {};
    for (SolidReport& solid : report.solids)
        solid.inside_cells = solid.boundary_cells = 0, solid.inside_volume = solid.boundary_volume = 0;
    for (CellIndex cell = 0; cell < mesh.cell_count(); ++cell) {
        const double volume = volume_of(corners_of(mesh, cell)), side = std::cbrt(volume);
        report.smallest_cell = cell == 0 ? side : std::min(report.smallest_cell, side);
        report.largest_cell = cell == 0 ? side : std::max(report.largest_cell, side);
        for (const mesh::SolidIndex solid : mesh.set_of(cell).inside) {
            ++report.solids[solid].inside_cells;
            report.solids[solid].inside_volume += volume;
        }
    }
}

}  // namespace

Result<Built> build_conforming(std::span<const mesh::Mesh> solids, const Options& options,
                               const Context& context) {
    Options sizing = options;
    sizing.keep = Keep::touched;
    sizing.fractions = Fractions::skip;
    sizing.balance = octree::Contact::face;
    sizing.refine_at_walls = false;  // cells of the grid are as small as `precision` everywhere
    const Box3 content = mesh::bounds_of_facets(solids);
    if (content.empty()) return build(solids, sizing, context);  // which says what is wrong
    if (Status fits = check_size(content); !fits) return std::move(fits).error();
    const Result<exact::Lattice> lattice = grid_lattice(content);
    if (!lattice) return lattice.error();
    const Result<SizeField> sizes = SizeField::from(sizing, solids.size(), content, *lattice);
    if (!sizes) return sizes.error();
    Result<Grid> grid = make_grid(options, content);
    if (!grid) return grid.error();
    Result<Built> built = build(solids, sizing, context);
    if (!built) return built;

    context.report("conform", 0);
    if (Status refined = refine_like(built->mesh, *sizes, options, *grid, context); !refined)
        return refined.error();
    built->mesh = {};
    context.report("conform", 0.3);
    const LooseHexes loose = cut_leaves(*grid, options.max_cells, context);
    if (context.cancelled()) return Context::cancelled_error();
    if (loose.hexes.size() > options.max_cells) return too_many_cells(options.max_cells);
    context.report("conform", 0.6);
    const auto inside = solids_at(solids, loose.centres, options, context);
    if (!inside) return inside.error();
    Result<mesh::HexMesh> mesh = assemble(loose, *inside, grid->side_of(0));
    if (!mesh) return mesh.error();
    built->mesh = std::move(*mesh);
    if (built->mesh.corners.empty()) return empty_error(built->report.solids);
    built->report.tree_cells = loose.hexes.size();
    measure(built->mesh, built->report);
    context.report("conform", 1);
    return built;
}

}  // namespace octavo::hexmesh
