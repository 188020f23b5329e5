// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <string>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/closing.hpp>
#include <octavo/boolean/coincident_facets.hpp>
#include <octavo/boolean/soup.hpp>
#include <octavo/boolean/weld.hpp>
#include <octavo/exact/orient.hpp>

namespace octavo::boolean {

mesh::Source Soup::source(std::uint32_t facet) const {
    const auto after = std::upper_bound(first_triangle.begin(), first_triangle.end(), origin[facet]);
    const auto operand = static_cast<std::uint32_t>(after - first_triangle.begin() - 1);
    return {operand, origin[facet] - first_triangle[operand]};
}

void drop_facets(const std::vector<char>& dropped, Soup& soup, const Context& context) {
    constexpr std::size_t grain = 1 << 12;
    const std::vector<std::size_t> offset =
        chunk_offsets(context, dropped.size(), grain, [&](std::size_t begin, std::size_t end) {
            return static_cast<std::size_t>(std::count(dropped.data() + begin, dropped.data() + end, 0));
        });
    UninitialisedVector<mesh::Triangle> facets(offset.back());
    UninitialisedVector<TransitionId> transition(offset.back());
    UninitialisedVector<std::uint32_t> origin(offset.back());
    parallel_chunks(context, dropped.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t kept = offset[begin / grain];
        for (std::size_t facet = begin; facet < end; ++facet) {
            if (dropped[facet]) continue;
            facets[kept] = soup.facets[facet];
            transition[kept] = soup.transition[facet];
            origin[kept++] = soup.origin[facet];
        }
    });
    soup.facets.swap(facets), soup.transition.swap(transition), soup.origin.swap(origin);
}

namespace {

/// Runs of elements that are counted through all operands.
struct Ranges {
    std::vector<std::size_t> begin;  ///< per operand, and one past the last

    /// Calls `visit(operand, from, to, offset)` for the parts of [first, last) that belong to one operand; `offset` is
    /// what its elements are counted from.
    template <class Visit>
    void for_each(std::size_t first, std::size_t last, const Visit& visit) const {
        auto operand =
            static_cast<std::size_t>(std::upper_bound(begin.begin(), begin.end(), first) - begin.begin()) - 1;
        for (; first < last; ++operand) {
            const std::size_t to = std::min(last, begin[operand + 1]);
            if (first < to) visit(static_cast<std::uint32_t>(operand), first, to, begin[operand]);
            first = to;
        }
    }
};

constexpr std::size_t chunk_size = 1 << 12;

Error error_of_operand(std::uint32_t operand, const char* what) {
    Error error{ErrorCode::bad_input, what, {}};
    error.place.operand = operand;
    return error;
}

std::string name_of(std::uint32_t operand, std::span<const std::string> names) {
    return operand < names.size() ? names[operand] : "operand " + std::to_string(operand);
}

/// For each vertex of all operands, whether a facet uses it: others are no part of a solid, and may be anywhere.
std::vector<std::uint8_t> find_used(std::span<const mesh::Mesh* const> operands, const Ranges& triangles,
                                    const Ranges& vertices, const Context& context) {
    std::vector<std::uint8_t> used(vertices.begin.back(), 0);
    parallel_chunks(context, triangles.begin.back(), chunk_size, [&](std::size_t first, std::size_t last) {
        triangles.for_each(first, last,
                           [&](std::uint32_t operand, std::size_t from, std::size_t to, std::size_t offset) {
                               // Bytes may alias anything: what the loop needs is out of their reach.
                               const std::span<const mesh::Triangle> all = operands[operand]->triangles;
                               const std::size_t count = operands[operand]->vertices.size();
                               std::uint8_t* const marks = used.data() + vertices.begin[operand];
                               for (const mesh::Triangle& triangle : all.subspan(from - offset, to - from))
                                   for (const mesh::VertexIndex corner : triangle)
                                       if (corner < count)
                                           std::atomic_ref(marks[corner]).store(1, std::memory_order_relaxed);
                           });
    });
    return used;
}

/// The bounds of each operand's used vertices. Errors: bad_input when one is not finite.
Result<std::vector<Box3>> bounds_of(std::span<const mesh::Mesh* const> operands, const Ranges& vertices,
                                    const std::vector<std::uint8_t>& used, const Context& context) {
    struct Part {
        std::uint32_t operand;
        Box3 bounds;
        bool finite;
    };
    const std::size_t count = vertices.begin.back();
    std::vector<std::vector<Part>> parts(count / chunk_size + 1);
    parallel_chunks(context, count, chunk_size, [&](std::size_t first, std::size_t last) {
        vertices.for_each(first, last,
                          [&](std::uint32_t operand, std::size_t from, std::size_t to, std::size_t offset) {
                              Part part{operand, {}, true};
                              for (std::size_t i = from; i < to; ++i) {
                                  if (!used[i]) continue;
                                  const Vec3& vertex = operands[operand]->vertices[i - offset];
                                  part.finite = part.finite && is_finite(vertex);
                                  part.bounds.add(vertex);
                              }
                              parts[first / chunk_size].push_back(part);
                          });
    });
    std::vector<Box3> bounds(operands.size());
    for (const std::vector<Part>& chunk : parts)
        for (const Part& part : chunk) {
            if (!part.finite) return error_of_operand(part.operand, "has a vertex that is not finite");
            bounds[part.operand].add(part.bounds);
        }
    return bounds;
}

Result<exact::Lattice> joint_lattice(const std::vector<Box3>& bounds) {
    Box3 all;
    for (const Box3& each : bounds) all.add(each);
    if (all.empty()) return exact::Lattice{};
    return exact::Lattice::fit(all);
}

/// The vertices of all operands on the lattice; unused ones all go to one place, where nothing comes of them.
UninitialisedVector<exact::Point> snap_vertices(std::span<const mesh::Mesh* const> operands,
                                                const Ranges& vertices, const std::vector<std::uint8_t>& used,
                                                Soup& soup, const Context& context) {
    constexpr std::int32_t middle = exact::universe_side / 2;
    struct Moved {
        std::size_t count = 0;
        double farthest = 0;  // in units, whose squares are doubles; squared
    };
    UninitialisedVector<exact::Point> positions(vertices.begin.back());
    std::vector<Moved> moved(positions.size() / chunk_size + 1);
    const double per_unit = 1 / soup.lattice.unit();
    parallel_chunks(context, positions.size(), chunk_size, [&](std::size_t first, std::size_t last) {
        Moved& here = moved[first / chunk_size];
        vertices.for_each(first, last,
                          [&](std::uint32_t operand, std::size_t from, std::size_t to, std::size_t offset) {
                              for (std::size_t i = from; i < to; ++i) {
                                  positions[i] = {middle, middle, middle};
                                  if (!used[i]) continue;
                                  const Vec3& vertex = operands[operand]->vertices[i - offset];
                                  positions[i] = soup.lattice.snap(vertex);
                                  const Vec3 way = per_unit * (soup.lattice.to_world(positions[i]) - vertex);
                                  here.count += way != Vec3{};
                                  here.farthest = std::max(here.farthest, dot(way, way));
                              }
                          });
    });
    for (const Moved& part : moved) {
        soup.moved_vertices += part.count;
        soup.largest_displacement =
            std::max(soup.largest_displacement, std::sqrt(part.farthest) * soup.lattice.unit());
    }
    return positions;
}

Error missing_corner(std::uint32_t operand, std::size_t face) {
    Error error = error_of_operand(operand, "has a facet with a corner that does not exist");
    error.place.faces = {static_cast<std::uint32_t>(face)};
    return error;
}

/// All facets that have an area.
Status add_facets(std::span<const mesh::Mesh* const> operands, const Ranges& triangles,
                  const Ranges& vertices, std::span<const std::uint32_t> point_of, Soup& soup,
                  const Context& context) {
    const std::size_t count = triangles.begin.back();
    soup.facets.resize(count), soup.transition.resize(count), soup.origin.resize(count);
    std::vector<char> flat(count, 0);
    std::vector<std::size_t> bad(count / chunk_size + 1, count), flats(count / chunk_size + 1, 0);
    parallel_chunks(context, count, chunk_size, [&](std::size_t first, std::size_t last) {
        triangles.for_each(
            first, last, [&](std::uint32_t operand, std::size_t from, std::size_t to, std::size_t offset) {
                const mesh::Mesh& mesh = *operands[operand];
                const std::uint32_t* const points = point_of.data() + vertices.begin[operand];
                for (std::size_t i = from; i < to; ++i) {
                    const mesh::Triangle& triangle = mesh.triangles[i - offset];
                    if (std::max({triangle[0], triangle[1], triangle[2]}) >= mesh.vertices.size()) {
                        bad[first / chunk_size] = std::min(bad[first / chunk_size], i);
                        return;
                    }
                    const mesh::Triangle facet{points[triangle[0]], points[triangle[1]], points[triangle[2]]};
                    soup.facets[i] = facet;
                    soup.transition[i] = operand;
                    soup.origin[i] = static_cast<std::uint32_t>(i);
                    flat[i] =
                        exact::collinear(soup.points[facet[0]], soup.points[facet[1]], soup.points[facet[2]]);
                    flats[first / chunk_size] += flat[i];
                }
            });
    });
    const std::size_t first_bad = *std::min_element(bad.begin(), bad.end());
    if (first_bad < count) {
        const auto after = std::upper_bound(triangles.begin.begin(), triangles.begin.end(), first_bad);
        const auto operand = static_cast<std::uint32_t>(after - triangles.begin.begin() - 1);
        return missing_corner(operand, first_bad - triangles.begin[operand]);
    }
    for (const std::size_t part : flats) soup.flat_facets += part;
    if (soup.flat_facets > 0) drop_facets(flat, soup, context);
    return Done{};
}

/// Operands that are a few units across lose their shape, and vanish below one unit; that is never silent.
void warn_of_small_operands(const std::vector<Box3>& bounds, std::span<const std::string> names, Soup& soup) {
    constexpr double few_units = 4096;
    std::string listed;
    std::size_t count = 0;
    double least = few_units;
    for (std::uint32_t operand = 0; operand < bounds.size(); ++operand) {
        if (bounds[operand].empty()) continue;
        const Vec3 extents = bounds[operand].extents();
        const double units = std::max({extents.x, extents.y, extents.z}) / soup.lattice.unit();
        if (units >= few_units) continue;
        least = std::min(least, units);
        if (count++ < 4) listed += (listed.empty() ? "" : ", ") + name_of(operand, names);
    }
    if (count == 0) return;
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", least);
    soup.warnings.push_back(listed + (count > 4 ? " and others" : "") + (count == 1 ? " is" : " are") +
                            " small beside the whole: " + text +
                            " lattice units across, so shapes are rounded or vanish; split the job or scale");
}

std::string warning_of(const Closing& closing, std::span<const std::string> names) {
    const std::size_t open = closing.operands.size();
    return (open == 1 ? "1 operand is" : std::to_string(open) + " operands are") + " open, the first is " +
           name_of(closing.operands[0], names) + ": " + std::to_string(closing.open_sides) +
           " open sides were closed by " + std::to_string(closing.added_facets) +
           (closing.added_facets == 1 ? " facet" : " facets");
}

}  // namespace

Result<Soup> make_soup(std::span<const mesh::Mesh* const> operands, OpenOperands open,
                       std::span<const std::string> names, const Context& context) {
    Soup soup;
    Ranges triangles{{0}}, vertices{{0}};
    for (const mesh::Mesh* operand : operands) {
        soup.first_triangle.push_back(static_cast<std::uint32_t>(triangles.begin.back()));
        triangles.begin.push_back(triangles.begin.back() + operand->triangles.size());
        vertices.begin.push_back(vertices.begin.back() + operand->vertices.size());
    }
    // Corners are numbered three to a facet, with ids of 32 bits.
    if (triangles.begin.back() > (std::size_t{1} << 30) / 3 || vertices.begin.back() > (std::size_t{1} << 30))
        return Error{
            ErrorCode::limit, "the operands have more than 357 million facets or 1 billion vertices", {}};
    soup.first_triangle.push_back(static_cast<std::uint32_t>(triangles.begin.back()));
    const std::vector<std::uint8_t> used = find_used(operands, triangles, vertices, context);
    const Result<std::vector<Box3>> bounds = bounds_of(operands, vertices, used, context);
    if (!bounds) return bounds.error();
    if (context.cancelled()) return Context::cancelled_error();
    const Result<exact::Lattice> lattice = joint_lattice(*bounds);
    if (!lattice) return lattice.error();
    soup.lattice = *lattice;
    soup.transitions = TransitionTable(static_cast<std::uint32_t>(operands.size()));
    Welded welded = weld(snap_vertices(operands, vertices, used, soup, context), context);
    if (context.cancelled()) return Context::cancelled_error();
    soup.points = std::move(welded.points);
    const Status added = add_facets(operands, triangles, vertices, welded.point_of, soup, context);
    if (!added) return added.error();
    if (context.cancelled()) return Context::cancelled_error();
    if (soup.flat_facets > 0)
        soup.warnings.push_back(std::to_string(soup.flat_facets) +
                                " facets have no area on the lattice and were dropped");
    warn_of_small_operands(*bounds, names, soup);
    if (open == OpenOperands::winding) {
        const Closing closing = close_operands(soup);
        soup.closing_facets = closing.added_facets;
        if (!closing.operands.empty()) soup.warnings.push_back(warning_of(closing, names));
    }
    merge_coincident(soup, context);
    if (context.cancelled()) return Context::cancelled_error();
    return soup;
}

}  // namespace octavo::boolean
