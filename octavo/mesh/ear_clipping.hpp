// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/mesh/corner_grid.hpp>
#include <octavo/mesh/corner_ring.hpp>
#include <octavo/mesh/mesh.hpp>

// Cuts the triangles off a ring of corners.
//
// An ear is a strictly convex corner whose triangle no other part of the ring enters. A ring that does not
// cross itself always has one, also when it touches itself (bridges to holes, pinched outlines); all tests
// are exact, so the search does not get lost. Cutting an ear changes the status of its two neighbours only
// (H. Meisters, "Polygons have ears", 1975; M. Held, "FIST: fast industrial-strength triangulation of
// polygons", 2001, is the source of treating touching corners). A test looks only at corners that are not convex,
// through a uniform grid that is built anew whenever half of them have gone. A corner that fails waits for the one that
// is in its way and is not tested again before that one has gone, has become convex or (where it only touches) has
// other neighbours. Near-linear in practice: 10^6 corners take 0.2 to 18 s (docs/formats/meshes.md). Going round for
// ears whenever the queue ran dry instead, and looking at whole boxes round triangles, was quadratic.
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
    /// Once the context is cancelled they mean nothing.
    EarClippingResult clip(CornerRing& ring, const Context& context);
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    using Node = std::uint32_t;

    Point2 position(Node node) const { return (*nodes_)[node].position; }
    Node previous(Node node) const { return (*nodes_)[node].previous; }
    Node next(Node node) const { return (*nodes_)[node].next; }
    int turn_at(Node node) const {
        return orient2d(position(previous(node)), position(node), position(next(node)));
    }

    /// How a corner is in the way of an ear: until it goes or becomes convex, or only with the neighbours it has.
    enum class Block : std::uint8_t { inside, touching, none };
    struct Watch {
        Node ear, blocker;
        Block block;
        std::uint32_t next;  ///< of the same blocker
    };

    void start(CornerRing& ring);
    template <class Visit>
    void for_each_node(const Visit& visit) const;
    void queue_convex();
    void build_grid();
    void update(Node node);
    bool is_ear(Node node);
    Block block(Node other, Node ear) const;
    void watch(Node ear, Node blocker, Block block);
    void release(Node blocker, Block block);
    bool is_double(Node node) const;
    void cut(Node node);
    void cut_without_ear();

    std::vector<RingCorner>* nodes_ = nullptr;
    Node any_ = 0;  ///< a node that is still on the ring
    std::uint32_t remaining_ = 0;
    std::vector<std::uint8_t> convex_, gone_;
    std::vector<Node> queue_, spikes_;
    std::vector<Node> doubles_, flats_;  ///< for when no ear is left
    bool looked_for_flats_ = false;
    std::size_t queue_head_ = 0;
    EarClippingResult result_;
    std::vector<Triangle> triangles_;

    std::vector<Watch> watches_;
    std::vector<std::uint32_t> watch_of_;  ///< per node, in watches_
    std::vector<std::array<std::uint32_t, 2>>
        watchers_;  ///< per node and kind of block, the latest in watches_

    CornerGrid grid_;  ///< of the corners that were not convex when it was built
    std::vector<CornerGrid::Entry> to_grid_;
    std::uint32_t gridded_ = 0, not_convex_ = 0;
};

}  // namespace octavo::mesh
