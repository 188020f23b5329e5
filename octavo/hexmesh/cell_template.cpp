// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/check.hpp>
#include <octavo/hexmesh/cell_template.hpp>

namespace octavo::hexmesh {
namespace {

using Segment = std::array<TemplatePoint, 2>;

/// A hexahedron as a map from [0, 12]³, where 12 is one side: thirds are 4, the depth of the template is 6.
class Hex {
  public:
    /// `axis` of the cut edges comes first, and sides are mirrored where `flips` says.
    Hex(const TemplateHex& corners, std::size_t axis, unsigned flips)
        : axis_(axis), flips_(flips), corners_(corners) {}

    TemplatePoint operator()(std::int64_t u, std::int64_t v, std::int64_t w) const {
        std::array<std::int64_t, 3> place{};
        const std::array<std::int64_t, 3> given{u, v, w};
        for (std::size_t i = 0; i < 3; ++i)
            place[(axis_ + i) % 3] = flips_ >> i & 1 ? 12 - given[i] : given[i];
        TemplatePoint point{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::int64_t sum = 0;
            for (unsigned corner = 0; corner < 8; ++corner) {
                std::int64_t weight = 1;
                for (std::size_t i = 0; i < 3; ++i) weight *= corner >> i & 1 ? place[i] : 12 - place[i];
                sum += weight * corners_[corner][k];
            }
            point[k] = sum / (12 * 12 * 12);
            OCTAVO_DCHECK(point[k] * 12 * 12 * 12 == sum, "a template's point is no integer");
        }
        return point;
    }

    /// The hexahedron with these corners, given in the order of octants of (u, v, w).
    TemplateHex made_of(const std::array<TemplatePoint, 8>& local) const {
        TemplateHex hex;
        for (unsigned corner = 0; corner < 8; ++corner) {
            unsigned target = 0;
            for (unsigned i = 0; i < 3; ++i)
                if ((corner >> i & 1) != (flips_ >> i & 1)) target |= 1U << (axis_ + i) % 3;
            hex[target] = local[corner];
        }
        return hex;
    }

  private:
    std::size_t axis_;
    unsigned flips_;
    const TemplateHex& corners_;
};

constexpr std::int64_t depth = 6;

/// All four edges: three slabs.
void cut_slabs(const Hex& hex, std::vector<TemplateHex>& out) {
    for (const std::int64_t u : {0, 4, 8})
        out.push_back(hex.made_of({hex(u, 0, 0), hex(u + 4, 0, 0), hex(u, 12, 0), hex(u + 4, 12, 0),
                                   hex(u, 0, 12), hex(u + 4, 0, 12), hex(u, 12, 12), hex(u + 4, 12, 12)}));
}

/// The edges at v = 0: the template of a square, drawn out along w.
void cut_side(const Hex& hex, std::vector<TemplateHex>& out) {
    struct Place {
        std::int64_t u, v;
    };
    // Corners (low u, low v), (high u, low v), (low u, high v), (high u, high v).
    constexpr std::array<std::array<Place, 4>, 4> squares{{{{{0, 0}, {4, 0}, {0, 12}, {4, depth}}},
                                                           {{{4, 0}, {8, 0}, {4, depth}, {8, depth}}},
                                                           {{{8, 0}, {12, 0}, {8, depth}, {12, 12}}},
                                                           {{{4, depth}, {8, depth}, {0, 12}, {12, 12}}}}};
    for (const auto& square : squares) {
        std::array<TemplatePoint, 8> corners;
        for (std::size_t i = 0; i < 8; ++i)
            corners[i] = hex(square[i % 4].u, square[i % 4].v, i < 4 ? 0 : 12);
        out.push_back(hex.made_of(corners));
    }
}

/// The edge at v = w = 0.
void cut_edge(const Hex& hex, std::vector<TemplateHex>& out) {
    const auto core = [&](std::int64_t u, bool v, bool w) { return hex(u, v ? depth : 0, w ? depth : 0); };
    const auto far = [&](std::int64_t u, bool v, bool w) { return hex(u, v ? 12 : 0, w ? 12 : 0); };
    // Before, in and after the middle piece.
    out.push_back(
        hex.made_of({far(0, false, false), core(4, false, false), far(0, true, false), core(4, true, false),
                     far(0, false, true), core(4, false, true), far(0, true, true), core(4, true, true)}));
    out.push_back(
        hex.made_of({core(4, false, false), core(8, false, false), core(4, true, false), core(8, true, false),
                     core(4, false, true), core(8, false, true), core(4, true, true), core(8, true, true)}));
    out.push_back(
        hex.made_of({core(8, false, false), far(12, false, false), core(8, true, false), far(12, true, false),
                     core(8, false, true), far(12, false, true), core(8, true, true), far(12, true, true)}));
    // Behind it along v, and along w.
    out.push_back(
        hex.made_of({core(4, true, false), core(8, true, false), far(0, true, false), far(12, true, false),
                     core(4, true, true), core(8, true, true), far(0, true, true), far(12, true, true)}));
    out.push_back(
        hex.made_of({core(4, false, true), core(8, false, true), core(4, true, true), core(8, true, true),
                     far(0, false, true), far(12, false, true), far(0, true, true), far(12, true, true)}));
}

/// The edges at w = 0, or 12: the roles of the other two axes are exchanged.
void cut_side_across(const TemplateHex& corners, std::size_t axis, unsigned flips,
                     std::vector<TemplateHex>& out) {
    // Exchange the axes that follow `axis`, cut, and exchange them back.
    const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
    const auto exchanged = [&](unsigned corner) {
        const unsigned kept = corner & (1U << axis);
        return kept | (corner >> b & 1) << c | (corner >> c & 1) << b;
    };
    TemplateHex turned;
    for (unsigned corner = 0; corner < 8; ++corner) turned[exchanged(corner)] = corners[corner];
    std::vector<TemplateHex> pieces;
    cut_side(Hex(turned, axis, flips), pieces);
    for (const TemplateHex& piece : pieces) {
        TemplateHex back;
        for (unsigned corner = 0; corner < 8; ++corner) back[exchanged(corner)] = piece[corner];
        out.push_back(back);
    }
}

/// Cuts a piece whose edges along `axis` are cut as the bits of `pattern` say: bit b + 2 * c. False without a template.
bool cut_piece(const TemplateHex& corners, std::size_t axis, unsigned pattern,
               std::vector<TemplateHex>& out) {
    // Mirrored so that the cut edges are those at v = 0 and, when there is one only, w = 0.
    switch (pattern) {
        case 1:
            cut_edge(Hex(corners, axis, 0), out);
            return true;
        case 2:
            cut_edge(Hex(corners, axis, 2), out);
            return true;
        case 4:
            cut_edge(Hex(corners, axis, 4), out);
            return true;
        case 8:
            cut_edge(Hex(corners, axis, 6), out);
            return true;
        case 3:
            cut_side_across(corners, axis, 0, out);
            return true;
        case 12:
            cut_side_across(corners, axis, 2, out);
            return true;
        case 5:
            cut_side(Hex(corners, axis, 0), out);
            return true;
        case 10:
            cut_side(Hex(corners, axis, 2), out);
            return true;
        case 15:
            cut_slabs(Hex(corners, axis, 0), out);
            return true;
        default:
            return false;
    }
}

unsigned corner_of_edge(std::size_t axis, unsigned place) {
    return (place & 1) << (axis + 1) % 3 | (place >> 1) << (axis + 2) % 3;
}

bool is_cut(const std::vector<Segment>& cut, const TemplatePoint& a, const TemplatePoint& b) {
    for (const Segment& segment : cut)
        if ((segment[0] == a && segment[1] == b) || (segment[0] == b && segment[1] == a)) return true;
    return false;
}

/// Cuts every piece that has an edge in `cut`; nothing when one has no template.
std::vector<TemplateHex> pass(const std::vector<TemplateHex>& pieces, const std::vector<Segment>& cut) {
    std::vector<TemplateHex> result;
    for (const TemplateHex& piece : pieces) {
        std::array<unsigned, 3> pattern{};
        int axes = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (unsigned place = 0; place < 4; ++place) {
                const unsigned low = corner_of_edge(axis, place);
                if (is_cut(cut, piece[low], piece[low | 1U << axis])) pattern[axis] |= 1U << place;
            }
            axes += pattern[axis] != 0;
        }
        if (axes > 1) return {};
        if (axes == 0) result.push_back(piece);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (pattern[axis] != 0 && !cut_piece(piece, axis, pattern[axis], result)) return {};
    }
    return result;
}

/// The segments of a pass: cut edges of the cube, and at the thirds of faces all of whose edges are cut, as far as
/// passes before this one have made them.
std::vector<Segment> segments_of_pass(const TemplateHex& cube, EdgeSet cut, std::size_t axis) {
    const auto is_edge_cut = [&](std::size_t along, unsigned place) {
        return cut >> (4 * along + place) & 1;
    };
    std::vector<Segment> segments;
    for (unsigned place = 0; place < 4; ++place) {
        const unsigned low = corner_of_edge(axis, place);
        if (is_edge_cut(axis, place)) segments.push_back({cube[low], cube[low | 1U << axis]});
    }
    for (std::size_t across = 0; across < axis; ++across) {
        // Faces that `axis` and `across` span, at either end of the third axis.
        const std::size_t normal = 3 - axis - across;
        for (const unsigned end : {0U, 1U}) {
            bool full = true;
            for (const std::size_t along : {axis, across})
                for (unsigned place = 0; place < 4; ++place) {
                    const unsigned on_normal = (along + 1) % 3 == normal ? place & 1 : place >> 1;
                    full = full && (on_normal != end || is_edge_cut(along, place));
                }
            if (!full) continue;
            for (const std::int64_t third : {template_side / 3, 2 * template_side / 3}) {
                TemplatePoint from{};
                from[normal] = end * template_side;
                from[across] = third;
                TemplatePoint to = from;
                to[axis] = template_side;
                segments.push_back({from, to});
            }
        }
    }
    return segments;
}

}  // namespace

std::vector<TemplateHex> cut_cell(EdgeSet cut) {
    TemplateHex cube;
    for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned axis = 0; axis < 3; ++axis) cube[corner][axis] = corner >> axis & 1 ? template_side : 0;
    std::vector<TemplateHex> pieces{cube};
    for (std::size_t axis = 0; axis < 3 && !pieces.empty(); ++axis)
        pieces = pass(pieces, segments_of_pass(cube, cut, axis));
    return pieces;
}

}  // namespace octavo::hexmesh
