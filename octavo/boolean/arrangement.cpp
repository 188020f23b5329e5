// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/balanced_chunks.hpp>
#include <octavo/boolean/cells.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
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
    std::span<const std::uint32_t> faces;  ///< ascending
    std::span<const Cut> cuts;
};

/// All sheets, by their first faces.
struct Sheets {
    std::vector<std::uint32_t> faces,
        first_face;  ///< `first_face` and `first_cut` per sheet, and one past the last
    std::vector<Cut> cuts;
    std::vector<std::uint32_t> first_cut;

    std::size_t size() const { return first_face.size() - 1; }
    Sheet operator[](std::size_t sheet) const {
        return {{faces.data() + first_face[sheet], first_face[sheet + 1] - first_face[sheet]},
                {cuts.data() + first_cut[sheet], first_cut[sheet + 1] - first_cut[sheet]}};
    }
};

/// The faces that are in any sheet, ascending.
std::vector<std::uint32_t> faces_in_sheets(std::span<const std::uint32_t> sheet_of, const Context& context) {
    constexpr std::size_t grain = 1 << 12;
    const auto for_each = [&](std::size_t begin, std::size_t end, const auto& visit) {
        for (std::size_t face = begin; face < end; ++face)
            if (sheet_of[face] != no_index) visit(static_cast<std::uint32_t>(face));
    };
    const std::vector<std::size_t> offset =
        chunk_offsets(context, sheet_of.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for_each(begin, end, [&](std::uint32_t) { ++count; });
            return count;
        });
    std::vector<std::uint32_t> faces(offset.back());
    parallel_chunks(context, sheet_of.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t at = offset[begin / grain];
        for_each(begin, end, [&](std::uint32_t face) { faces[at++] = face; });
    });
    return faces;
}

Sheets find_sheets(const Soup& soup, const Contacts& contacts, const Context& context) {
    mesh::DisjointSets sets(contacts.overlaps.empty() ? 0 : soup.facets.size());
    for (const Overlap& overlap : contacts.overlaps) sets.unite(overlap.first, overlap.second);

    UninitialisedVector<std::uint32_t> sheet_of(soup.facets.size());
    parallel_chunks(context, sheet_of.size(), 1 << 12, [&](std::size_t begin, std::size_t end) {
        std::fill(sheet_of.data() + begin, sheet_of.data() + end, no_index);
    });
    Sheets sheets;
    if (context.cancelled()) return sheets;
    for (const Cut& cut : contacts.cuts) sheet_of[cut.face] = 0;
    for (const Overlap& overlap : contacts.overlaps) sheet_of[overlap.first] = sheet_of[overlap.second] = 0;

    // The least face of a set comes first, so it opens the sheet.
    const std::vector<std::uint32_t> faces = faces_in_sheets(sheet_of, context);
    if (context.cancelled()) return sheets;
    for (const std::uint32_t face : faces) {
        const std::uint32_t first = contacts.overlaps.empty() ? face : sets.find(face);
        if (first == face) {
            sheet_of[face] = static_cast<std::uint32_t>(sheets.first_face.size());
            sheets.first_face.push_back(0);
        } else {
            sheet_of[face] = sheet_of[first];
        }
        ++sheets.first_face[sheet_of[face]];
    }
    sheets.first_cut.assign(sheets.first_face.size(), 0);
    for (const Cut& cut : contacts.cuts) ++sheets.first_cut[sheet_of[cut.face]];
    make_offsets(sheets.first_face);
    make_offsets(sheets.first_cut);
    sheets.faces.resize(sheets.first_face.back());
    sheets.cuts.resize(sheets.first_cut.back());
    std::vector<std::uint32_t> next(sheets.first_face);
    for (const std::uint32_t face : faces) sheets.faces[next[sheet_of[face]]++] = face;
    next = sheets.first_cut;
    for (const Cut& cut : contacts.cuts) sheets.cuts[next[sheet_of[cut.face]]++] = cut;
    return sheets;
}

/// Subdivided sheets. Corners and covers are numbered among themselves until all are done.
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

/// Labels the triangles of a sheet: which of its facets cover them.
class CoverSearch {
  public:
    CoverSearch(const Soup& soup, const Plane& plane, const Subdivision& subdivision)
        : soup_(soup), plane_(plane), subdivision_(subdivision) {}

    /// Adds to `covers`, and fills `cover` per triangle of the subdivision: no_index outside of all facets.
    void run(Cells& cells, std::vector<std::uint32_t>& cover, std::vector<Pieces::Cover>& covers) {
        cells.find(subdivision_, is_cut_line);
        std::map<std::vector<std::uint32_t>, std::uint32_t> known;
        std::vector<std::uint32_t> cover_of_cell;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            const std::span<const std::uint32_t> facets = cells.cover(cell);
            if (facets.empty()) {
                cover_of_cell.push_back(no_index);
                continue;
            }
            const auto [place, is_new] =
                known.try_emplace({facets.begin(), facets.end()}, static_cast<std::uint32_t>(covers.size()));
            if (is_new) covers.push_back(cover_by(facets));
            cover_of_cell.push_back(place->second);
        }
        cover.clear();
        for (const std::uint32_t cell : cells.of_triangle()) cover.push_back(cover_of_cell[cell]);
    }

    bool same_way(std::uint32_t facet) const {
        const int axis = plane_.dominant_axis();
        return (plane_of(soup_, facet).normal(axis) > 0) == (plane_.normal(axis) > 0);
    }

  private:
    /// Deltas as seen by the first of the facets.
    Pieces::Cover cover_by(std::span<const std::uint32_t> facets) const {
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

/// Subdivides sheets one after another, in memory that they share.
class SheetCutter {
  public:
    SheetCutter(const Soup& soup, const Faces& faces, const PointTable& points, const CutPlanes& planes,
                Pieces& pieces)
        : soup_(soup), faces_(faces), planes_(planes), subdivision_(points, planes.planes), pieces_(pieces) {}

    void run(const Sheet& sheet) {
        points_.clear();
        if (sheet.faces.size() == 1)
            cut_face(sheet);
        else
            cut_sheet(sheet);
        pieces_.new_points.insert(pieces_.new_points.end(), subdivision_.new_points().begin(),
                                  subdivision_.new_points().end());
    }

  private:
    /// A point of the subdivision as the pieces name it.
    std::uint32_t name(Subdivision::VertexId vertex) const {
        const std::uint32_t id = subdivision_.point_of(vertex);
        return id < Subdivision::new_point ? id : id + static_cast<std::uint32_t>(pieces_.new_points.size());
    }
    mesh::Triangle name(const Subdivision::Triangle& t) const {
        return {name(t.v[0]), name(t.v[1]), name(t.v[2])};
    }

    /// All points that are known go in before any segment, so that a crossing of segments is never one of them.
    void insert_points(const Sheet& sheet) {
        for (const Cut& cut : sheet.cuts) {
            points_.push_back({cut.from, planes_.of_facet[cut.other]});
            points_.push_back({cut.to, planes_.of_facet[cut.other]});
        }
        subdivision_.add_points(points_);
    }

    void insert_segments(const Sheet& sheet) {
        for (const Cut& cut : sheet.cuts)
            if (cut.to != cut.from)
                subdivision_.add_segment(subdivision_.vertex_of(cut.from), subdivision_.vertex_of(cut.to),
                                         planes_.of_facet[cut.other], is_cut_line);
    }

    void cut_face(const Sheet& sheet) {
        const std::uint32_t face = sheet.faces[0];
        const Faces::Corners corners = faces_.corners(soup_, face);
        Point places[4];
        for (std::uint32_t k = 0; k < corners.count; ++k) places[k] = soup_.points[corners.vertex[k]];
        subdivision_.begin(plane_of(soup_, face), {places, corners.count},
                           {corners.vertex.data(), corners.count});
        insert_points(sheet);
        insert_segments(sheet);
        const auto cover = static_cast<std::uint32_t>(pieces_.covers.size());
        pieces_.covers.push_back({face, {}, false});
        for (const Subdivision::Triangle& t : subdivision_.triangles()) pieces_.triangles.push_back(name(t));
        pieces_.cover.resize(pieces_.triangles.size(), cover);
    }

    void cut_sheet(const Sheet& sheet) {
        const Plane plane = plane_of(soup_, sheet.faces[0]);
        corners_.clear();
        for (const std::uint32_t face : sheet.faces) {
            const Faces::Corners corners = faces_.corners(soup_, face);
            for (std::uint32_t k = 0; k < corners.count; ++k)
                corners_.push_back(soup_.points[corners.vertex[k]]);
        }
        subdivision_.begin_round(plane, corners_);
        find_borders(sheet, plane.dominant_axis());
        insert_points(sheet);
        for (const Border& side : borders_)
            subdivision_.add_segment(subdivision_.vertex_of(side.from), subdivision_.vertex_of(side.to),
                                     side.line, side.face);
        insert_segments(sheet);

        CoverSearch search(soup_, plane, subdivision_);
        search.run(cells_, cover_, pieces_.covers);
        const auto triangles = subdivision_.triangles();
        for (std::size_t triangle = 0; triangle < triangles.size(); ++triangle) {
            if (cover_[triangle] == no_index) continue;
            mesh::Triangle corners = name(triangles[triangle]);
            if (!search.same_way(pieces_.covers[cover_[triangle]].facet)) std::swap(corners[1], corners[2]);
            pieces_.triangles.push_back(corners);
            pieces_.cover.push_back(cover_[triangle]);
        }
    }

    /// The sides of a sheet's faces, and their ends, which go in with the points.
    void find_borders(const Sheet& sheet, int axis) {
        BorderLines lines(soup_, axis, subdivision_);
        borders_.clear();
        for (const std::uint32_t face : sheet.faces) {
            const Faces::Corners corners = faces_.corners(soup_, face);
            for (std::uint32_t k = 0; k < corners.count; ++k) {
                const std::uint32_t from = corners.vertex[k], to = corners.vertex[(k + 1) % corners.count];
                borders_.push_back({from, to, face, lines.of(from, to)});
                points_.push_back({from, borders_.back().line});
                points_.push_back({to, borders_.back().line});
            }
        }
    }

    struct Border {
        std::uint32_t from, to, face;
        Subdivision::LineId line;
    };

    const Soup& soup_;
    const Faces& faces_;
    const CutPlanes& planes_;
    Subdivision subdivision_;
    Pieces& pieces_;
    std::vector<Subdivision::PointOnLine> points_;
    std::vector<Point> corners_;
    std::vector<Border> borders_;
    std::vector<std::uint32_t> cover_;
    Cells cells_;
};

/// Names what sheets have made: points first, in their order, then the triangles side by side.
void append(const Soup& soup, std::vector<Pieces>& all, PointTable& points, Complex& complex,
            const Context& context) {
    std::vector<std::vector<PointId>> point_of_new(all.size());
    std::vector<std::vector<TransitionId>> transition_of(all.size());
    std::vector<std::size_t> begin{0};
    std::vector<std::span<const exact::TriplePoint>> lists;
    for (const Pieces& pieces : all) lists.push_back(pieces.new_points);
    const std::vector<std::vector<PointTable::Place>> places =
        points.places<exact::TriplePoint>(lists, context);
    if (context.cancelled()) return;
    for (std::size_t part = 0; part < all.size(); ++part) {
        Pieces& pieces = all[part];
        for (std::size_t i = 0; i < pieces.new_points.size(); ++i)
            point_of_new[part].push_back(points.add(pieces.new_points[i], places[part][i]));
        pieces.new_points = {};
        for (const Pieces::Cover& cover : pieces.covers)
            transition_of[part].push_back(cover.shared ? complex.transitions.intern(cover.deltas)
                                                       : soup.transition[cover.facet]);
        begin.push_back(begin.back() + pieces.triangles.size());
    }
    complex.pieces.resize(begin.back());
    complex.piece_facet.resize(begin.back());
    complex.piece_transition.resize(begin.back());
    parallel_chunks(context, all.size(), 1, [&](std::size_t part, std::size_t) {
        Pieces& pieces = all[part];
        std::size_t at = begin[part];
        for (std::size_t i = 0; i < pieces.triangles.size(); ++i, ++at) {
            mesh::Triangle corners = pieces.triangles[i];
            for (std::uint32_t& corner : corners)
                if (corner >= Subdivision::new_point)
                    corner = point_of_new[part][corner - Subdivision::new_point];
            complex.pieces[at] = corners;
            complex.piece_facet[at] = pieces.covers[pieces.cover[i]].facet;
            complex.piece_transition[at] = transition_of[part][pieces.cover[i]];
        }
        pieces = {};
    });
}

}  // namespace

Complex arrange(const Soup& soup, const Contacts& contacts, PointTable& points, const Context& context) {
    Complex complex;
    complex.soup = &soup;
    complex.transitions = soup.transitions;
    complex.is_cut.assign(soup.facets.size(), 0);
    const Sheets sheets = find_sheets(soup, contacts, context);
    if (context.cancelled()) return complex;
    complex.sheets = sheets.size();
    const CutPlanes planes = find_cut_planes(soup, contacts, context);
    const std::vector<std::size_t> begin = balanced_chunks(sheets.size(), 64, 1024, [&](std::size_t sheet) {
        return sheets[sheet].faces.size() + sheets[sheet].cuts.size();
    });
    std::vector<Pieces> pieces(begin.size() - 1);
    parallel_chunks(context, pieces.size(), 1, [&](std::size_t chunk, std::size_t) {
        SheetCutter cutter(soup, contacts.faces, points, planes, pieces[chunk]);
        for (std::size_t sheet = begin[chunk]; sheet < begin[chunk + 1]; ++sheet) cutter.run(sheets[sheet]);
    });
    for (const std::uint32_t face : sheets.faces) {
        complex.is_cut[face] = 1;
        const std::uint32_t partner = contacts.faces.partner(face);
        if (partner == no_index) continue;
        complex.is_cut[partner] = 1;
        complex.joined.push_back({face, face});
        complex.joined.push_back({partner, face});
    }
    if (!context.cancelled()) append(soup, pieces, points, complex, context);
    return complex;
}

}  // namespace octavo::boolean
