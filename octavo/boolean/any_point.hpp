// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/exact/orient_in_plane.hpp>

// Exact predicates on points whose kinds are known only at run time. Two widths serve all combinations of kinds:
// these paths are rare, their code need not be large.

namespace octavo::boolean {

inline exact::EdgePoint as_edge_point(exact::Point p) { return exact::EdgePoint(p); }
inline exact::EdgePoint as_edge_point(const exact::EdgePoint& p) { return p; }
inline exact::EdgePoint as_edge_point(const exact::TriplePoint&) { return {}; }  // never asked for

inline exact::TriplePoint as_triple_point(exact::Point p) { return exact::TriplePoint(p); }
inline exact::TriplePoint as_triple_point(const exact::EdgePoint& p) {
    using Numerator = exact::TriplePoint::Numerator;
    using Weight = exact::TriplePoint::Weight;
    return {Numerator(p.numerator(0)), Numerator(p.numerator(1)), Numerator(p.numerator(2)),
            Weight(p.weight())};
}
inline exact::TriplePoint as_triple_point(const exact::TriplePoint& p) { return p; }

inline bool is_triple(exact::Point) { return false; }
inline bool is_triple(const exact::EdgePoint&) { return false; }
inline bool is_triple(const exact::TriplePoint&) { return true; }

/// The turn of three points seen from the far end of `axis`, without a filter. `visit(k, f)` calls f with the
/// point of corner k, whatever its kind.
template <class Visit>
exact::Sign exact_turn(int axis, const Visit& visit) {
    exact::count_exact(exact::Predicate::orient_in_plane);
    const auto triple = [&](int k) { return visit(k, [](const auto& p) { return is_triple(p); }); };
    if (!triple(0) && !triple(1) && !triple(2)) {
        const auto point = [&](int k) { return visit(k, [](const auto& p) { return as_edge_point(p); }); };
        return exact::exact_orient2d(axis, point(0), point(1), point(2));
    }
    const auto point = [&](int k) { return visit(k, [](const auto& p) { return as_triple_point(p); }); };
    return exact::exact_orient2d(axis, point(0), point(1), point(2));
}

}  // namespace octavo::boolean
