// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/cells.hpp>
#include <octavo/boolean/cut_planes.hpp>
#include <octavo/boolean/subdivision.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

using exact::Plane;
using exact::Point;
using exact::Sign;

Plane plane_of(const Soup& soup, std::uint32_t facet) {
    const mesh::Triangle& corner = soup.facets[facet];
    return Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
}

/// The faces that are subdivided together, with their cuts.
struct Sheet {
    std::vector<std::uint32_t> faces;  ///< ascending
    std::vector<Cut> cuts;
};

std::vector<Sheet> find_sheets(const Soup& soup, const Contacts& contacts) {
    mesh::DisjointSets sets(contacts.overlaps.empty() ? 0 : soup.facets.size());
    for (const Overlap& overlap : contacts.overlaps) sets.unite(overlap.first, overlap.second);
    const auto root = [&](std::uint32_t facet) {
        return contacts.overlaps.empty() ? facet : sets.find(facet);
    };

    std::vector<std::uint32_t> sheet_of(soup.facets.size(), no_index);
    std::vector<std::uint32_t> touched;
    const auto touch = [&](std::uint32_t facet) {
        if (sheet_of[facet] != no_index) return;
        sheet_of[facet] = 0;
        touched.push_back(facet);
    };
    for (const Cut& cut : contacts.cuts) touch(cut.face);
    for (const Overlap& overlap : contacts.overlaps) touch(overlap.first), touch(overlap.second);
    std::sort(touched.begin(), touched.end());

    // The least facet of a set comes first, so it opens the sheet.
    std::vector<Sheet> sheets;
    for (const std::uint32_t facet : touched) {
        const std::uint32_t first = root(facet);
        if (first == facet) {
            sheet_of[facet] = static_cast<std::uint32_t>(sheets.size());
            sheets.emplace_back();
        } else {
            sheet_of[facet] = sheet_of[first];
        }
        sheets[sheet_of[facet]].faces.push_back(facet);
    }
    for (const Cut& cut : contacts.cuts) sheets[sheet_of[cut.face]].cuts.push_back(cut);
    return sheets;
}

/// A subdivided sheet. Corners and covers are numbered within the sheet until all sheets are done.
struct Pieces {
    std::vector<mesh::Triangle> triangles;  ///< point ids, or Subdivision::new_point + index
    std::vector<exact::TriplePoint> new_points;
    std::vector<std::uint32_t> cover;  ///< per triangle, which of the covers
    struct Cover {
        std::uint32_t facet;        ///< the first that covers
        std::vector<Delta> deltas;  ///< used when `shared`
        bool shared;                ///< by several facets
    };
    std::vector<Cover> covers;
};

inline constexpr std::uint32_t is_cut_line =
    no_index;  ///< the tag of segments that are no border of a sheet's face

/// All points that are known go in before any segment, so that a crossing of segments is never one of them.
void insert_points(const Sheet& sheet, const CutPlanes& planes, Subdivision& subdivision,
                   std::vector<Subdivision::PointOnLine>& points) {
    for (const Cut& cut : sheet.cuts) {
        points.push_back({cut.from, planes.of_facet[cut.other]});
        points.push_back({cut.to, planes.of_facet[cut.other]});
    }
    subdivision.add_points(points);
}

void insert_segments(const Sheet& sheet, const CutPlanes& planes, Subdivision& subdivision) {
    for (const Cut& cut : sheet.cuts)
        if (cut.to != cut.from)
            subdivision.add_segment(subdivision.vertex_of(cut.from), subdivision.vertex_of(cut.to),
                                    planes.of_facet[cut.other], is_cut_line);
}

Pieces subdivide_face(const Soup& soup, const Faces& faces, const Sheet& sheet, const CutPlanes& planes,
                      Subdivision& subdivision) {
    const std::uint32_t face = sheet.faces[0];
    const Faces::Corners corners = faces.corners(soup, face);
    Point places[4];
    for (std::uint32_t k = 0; k < corners.count; ++k) places[k] = soup.points[corners.vertex[k]];
    subdivision.begin(plane_of(soup, face), {places, corners.count}, {corners.vertex.data(), corners.count});
    std::vector<Subdivision::PointOnLine> points;
    insert_points(sheet, planes, subdivision, points);
    insert_segments(sheet, planes, subdivision);

    Pieces pieces;
    pieces.covers.push_back({face, {}, false});
    for (const Subdivision::Triangle& t : subdivision.triangles()) {
        pieces.triangles.push_back(
            {subdivision.point_of(t.v[0]), subdivision.point_of(t.v[1]), subdivision.point_of(t.v[2])});
        pieces.cover.push_back(0);
    }
    pieces.new_points.assign(subdivision.new_points().begin(), subdivision.new_points().end());
    return pieces;
}

/// Labels the triangles of a sheet: which of its facets cover them.
class CoverSearch {
  public:
    CoverSearch(const Soup& soup, const Plane& plane, const Subdivision& subdivision)
        : soup_(soup), plane_(plane), subdivision_(subdivision) {}

    /// Fills `covers`, and `cover` per triangle of the subdivision: no_index outside of all facets.
    void run(std::vector<std::uint32_t>& cover, std::vector<Pieces::Cover>& covers) {
        const Cells cells = find_cells(subdivision_, is_cut_line);
        std::map<std::vector<std::uint32_t>, std::uint32_t> known;
        std::vector<std::uint32_t> cover_of_cell;
        for (const std::vector<std::uint32_t>& facets : cells.covers) {
            if (facets.empty()) {
                cover_of_cell.push_back(no_index);
                continue;
            }
            const auto [place, is_new] = known.try_emplace(facets, static_cast<std::uint32_t>(covers.size()));
            if (is_new) covers.push_back(cover_by(facets));
            cover_of_cell.push_back(place->second);
        }
        cover.resize(cells.of_triangle.size());
        for (std::size_t triangle = 0; triangle < cover.size(); ++triangle)
            cover[triangle] = cover_of_cell[cells.of_triangle[triangle]];
    }

    bool same_way(std::uint32_t facet) const {
        const int axis = plane_.dominant_axis();
        return (plane_of(soup_, facet).normal(axis) > 0) == (plane_.normal(axis) > 0);
    }

  private:
    /// Deltas as seen by the first of the facets.
    Pieces::Cover cover_by(const std::vector<std::uint32_t>& facets) const {
        Pieces::Cover cover{facets[0], {}, facets.size() > 1};
        if (!cover.shared) return cover;
        TransitionSum sum;
        const bool first_way = same_way(facets[0]);
        for (const std::uint32_t facet : facets)
            sum.add(soup_.transitions.of(soup_.transition[facet]), same_way(facet) == first_way ? 1 : -1);
        const auto total = sum.normalised();
        cover.deltas.assign(total.begin(), total.end());
        return cover;
    }

    const Soup& soup_;
    const Plane& plane_;
    const Subdivision& subdivision_;
};

/// The borders of a sheet's faces as lines, each once however many faces have a side on it.
class BorderLines {
  public:
    BorderLines(const Soup& soup, int axis, Subdivision& subdivision)
        : soup_(soup), axis_(axis), subdivision_(subdivision) {}

    Subdivision::LineId of(std::uint32_t from, std::uint32_t to) {
        const Point p = soup_.points[from], q = soup_.points[to];
        const int i = (axis_ + 1) % 3, j = (axis_ + 2) % 3;
        std::int64_t dx = q[i] - p[i], dy = q[j] - p[j];
        const std::int64_t divisor = std::gcd(dx, dy) * (dx < 0 || (dx == 0 && dy < 0) ? -1 : 1);
        dx /= divisor, dy /= divisor;
        const auto [place, is_new] = ids_.try_emplace({dx, dy, dx * p[j] - dy * p[i]});
        if (is_new) place->second = subdivision_.add_line(Plane::along_axis(axis_, p, q));
        return place->second;
    }

  private:
    const Soup& soup_;
    int axis_;
    Subdivision& subdivision_;
    std::map<std::array<std::int64_t, 3>, Subdivision::LineId> ids_;
};

Pieces subdivide_sheet(const Soup& soup, const Faces& faces, const Sheet& sheet, const CutPlanes& planes,
                       Subdivision& subdivision) {
    const Plane plane = plane_of(soup, sheet.faces[0]);
    std::vector<Point> all_corners;
    for (const std::uint32_t face : sheet.faces) {
        const Faces::Corners corners = faces.corners(soup, face);
        for (std::uint32_t k = 0; k < corners.count; ++k)
            all_corners.push_back(soup.points[corners.vertex[k]]);
    }
    subdivision.begin_round(plane, all_corners);
    BorderLines borders(soup, plane.dominant_axis(), subdivision);
    struct Border {
        std::uint32_t from, to, face;
        Subdivision::LineId line;
    };
    std::vector<Border> sides;
    std::vector<Subdivision::PointOnLine> points;
    for (const std::uint32_t face : sheet.faces) {
        const Faces::Corners corners = faces.corners(soup, face);
        for (std::uint32_t k = 0; k < corners.count; ++k) {
            const std::uint32_t from = corners.vertex[k], to = corners.vertex[(k + 1) % corners.count];
            sides.push_back({from, to, face, borders.of(from, to)});
            points.push_back({from, sides.back().line});
            points.push_back({to, sides.back().line});
        }
    }
    insert_points(sheet, planes, subdivision, points);
    for (const Border& side : sides)
        subdivision.add_segment(subdivision.vertex_of(side.from), subdivision.vertex_of(side.to), side.line,
                                side.face);
    insert_segments(sheet, planes, subdivision);

    Pieces pieces;
    std::vector<std::uint32_t> cover;
    CoverSearch search(soup, plane, subdivision);
    search.run(cover, pieces.covers);
    const auto triangles = subdivision.triangles();
    for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle) {
        if (cover[triangle] == no_index) continue;
        const Subdivision::Triangle& t = triangles[triangle];
        mesh::Triangle corners{subdivision.point_of(t.v[0]), subdivision.point_of(t.v[1]),
                               subdivision.point_of(t.v[2])};
        if (!search.same_way(pieces.covers[cover[triangle]].facet)) std::swap(corners[1], corners[2]);
        pieces.triangles.push_back(corners);
        pieces.cover.push_back(cover[triangle]);
    }
    pieces.new_points.assign(subdivision.new_points().begin(), subdivision.new_points().end());
    return pieces;
}

void append(const Soup& soup, const Pieces& pieces, PointTable& points, Complex& complex) {
    std::vector<PointId> id_of_new;
    for (const exact::TriplePoint& point : pieces.new_points) id_of_new.push_back(points.add(point));
    std::vector<TransitionId> transition;
    for (const Pieces::Cover& cover : pieces.covers)
        transition.push_back(cover.shared ? complex.transitions.intern(cover.deltas)
                                          : soup.transition[cover.facet]);
    for (std::size_t i = 0; i < pieces.triangles.size(); ++i) {
        mesh::Triangle corners = pieces.triangles[i];
        for (std::uint32_t& corner : corners)
            if (corner >= Subdivision::new_point) corner = id_of_new[corner - Subdivision::new_point];
        complex.pieces.push_back(corners);
        complex.piece_facet.push_back(pieces.covers[pieces.cover[i]].facet);
        complex.piece_transition.push_back(transition[pieces.cover[i]]);
    }
}

}  // namespace

Complex arrange(const Soup& soup, const Contacts& contacts, PointTable& points, const Context& context) {
    Complex complex;
    complex.soup = &soup;
    complex.transitions = soup.transitions;
    complex.is_cut.assign(soup.facets.size(), 0);
    const std::vector<Sheet> sheets = find_sheets(soup, contacts);
    complex.sheets = sheets.size();
    const CutPlanes planes = find_cut_planes(soup, contacts, context);
    std::vector<Pieces> pieces(sheets.size());
    parallel_chunks(context, sheets.size(), 64, [&](std::size_t begin, std::size_t end) {
        Subdivision subdivision(points, planes.planes);
        for (std::size_t i = begin; i < end; ++i)
            pieces[i] = sheets[i].faces.size() == 1
                            ? subdivide_face(soup, contacts.faces, sheets[i], planes, subdivision)
                            : subdivide_sheet(soup, contacts.faces, sheets[i], planes, subdivision);
    });
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        for (const std::uint32_t face : sheets[i].faces) {
            complex.is_cut[face] = 1;
            const std::uint32_t partner = contacts.faces.partner(face);
            if (partner == no_index) continue;
            complex.is_cut[partner] = 1;
            complex.joined.push_back({face, face});
            complex.joined.push_back({partner, face});
        }
        append(soup, pieces[i], points, complex);
    }
    return complex;
}

}  // namespace octavo::boolean
