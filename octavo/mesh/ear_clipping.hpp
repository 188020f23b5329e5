// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/corner_ring.hpp>
#include <octavo/mesh/mesh.hpp>

// Cuts the triangles off a ring of corners.
//
// An ear is a strictly convex corner whose triangle no other part of the ring enters. A ring that does not
// cross itself always has one, also when it touches itself (bridges to holes, pinched outlines); all tests
// are exact, so the search does not get lost. Cutting an ear changes the status of its two neighbours only
// (H. Meisters, "Polygons have ears", 1975; M. Held, "FIST: fast industrial-strength triangulation of
// polygons", 2001, is the source of treating touching corners), so each corner is tested a few times in
// total. A test looks only at corners that are not convex, through a uniform grid that is built anew whenever
// half of them have gone: near-linear on real outlines, quadratic in the worst case.
//
// Ears wait in a queue, so the cuts go round the outline evenly and a convex disc becomes a balanced
// triangulation and not one fan of slivers.
//
// When no ear is left but corners are, either what remains has no area (triangles of no area use up its
// corners) or the outline crosses itself (corners are cut by force). Both are told; either way every corner
// is used and every edge of the outline is an edge of exactly one triangle.

namespace octavo::mesh {

struct EarClippingResult {
    std::uint32_t flat_triangles = 0;    ///< triangles without area
    std::uint32_t forced_triangles = 0;  ///< triangles that are turned over or overlap others
};

class EarClipping {
  public:
    /// Triangulates the ring; the triangles name corners of the input. They are valid until the next call.
    EarClippingResult clip(CornerRing& ring);
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    using Node = std::uint32_t;

    Point2 position(Node node) const { return (*nodes_)[node].position; }
    Node previous(Node node) const { return (*nodes_)[node].previous; }
    Node next(Node node) const { return (*nodes_)[node].next; }
    int turn_at(Node node) const {
        return orient2d(position(previous(node)), position(node), position(next(node)));
    }

    void start(CornerRing& ring);
    void build_grid();
    void update(Node node);
    bool is_ear(Node node) const;
    bool blocks(Node other, Node ear) const;
    void cut(Node node);
    bool requeue_all();
    void cut_without_ear();

    std::vector<RingCorner>* nodes_ = nullptr;
    Node any_ = 0;  ///< a node that is still on the ring
    std::uint32_t remaining_ = 0;
    std::vector<std::uint8_t> convex_, gone_;
    std::vector<Node> queue_, spikes_;
    std::size_t queue_head_ = 0;
    EarClippingResult result_;
    std::vector<Triangle> triangles_;

    // The corners that were not convex when the grid was built, by cell.
    Point2 grid_low_;
    double columns_per_x_ = 0, rows_per_y_ = 0;
    std::uint32_t columns_ = 1, rows_ = 1;
    std::uint32_t gridded_ = 0, not_convex_ = 0;
    std::vector<std::uint32_t> cell_begin_;
    std::vector<Node> cell_nodes_;

    std::uint32_t column(double x) const;
    std::uint32_t row(double y) const;
};

}  // namespace octavo::mesh
