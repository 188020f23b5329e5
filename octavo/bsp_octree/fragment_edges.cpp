// SPDX-License-Identifier: Apache-2.0
#include <span>

#include <octavo/bsp_octree/faces.hpp>
#include <octavo/bsp_octree/fragment_edges.hpp>
#include <octavo/bsp_octree/shared_lines.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::no_index;
using boolean::PointId;
using boolean::PointTable;

/// What one task finds in some leaves: ends of edges are numbers of points of its own.
struct Batch {
    std::vector<exact::TriplePoint> points;
    std::vector<BoundedSegment> edges;
    std::size_t fragments = 0;
};

class EdgeTaker {
  public:
    void operator()(const bsp::FragmentPool& pool, std::span<const bsp::Fragment> fragments, Batch& batch) {
        number_.assign(pool.mark().vertices, no_index);
        lines_.begin(pool.planes(), fragments);
        for (const bsp::Fragment& fragment : fragments) {
            const std::span<const bsp::Corner> ring = pool.corners(fragment);
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const bsp::Corner& next = ring[i + 1 == ring.size() ? 0 : i + 1];
                const PointId from = number_of(pool, ring[i].vertex, batch),
                              to = number_of(pool, next.vertex, batch);
                batch.edges.push_back({{fragment.facing, from, to},
                                       ring[i].edge,
                                       lines_.may_be_shared(fragment.facing.plane(), ring[i].edge,
                                                            pool.approximation(ring[i].vertex))});
            }
        }
        batch.fragments += fragments.size();
    }

  private:
    PointId number_of(const bsp::FragmentPool& pool, bsp::VertexId vertex, Batch& batch) {
        PointId& number = number_[vertex & ~bsp::FragmentPool::constructed_bit];
        if (number == no_index) {
            number = static_cast<PointId>(batch.points.size());
            batch.points.push_back(pool.constructed(vertex));
        }
        return number;
    }

    SharedLines lines_;
    std::vector<PointId> number_;  ///< of each vertex of the leaf in the batch
};

}  // namespace

FragmentEdges fragment_edges(const BspOctree& octree, PointTable& points, const Context& context) {
    FragmentEdges found;
    std::vector<PointId> ids;
    for_each_boundary(octree, context, Batch{}, EdgeTaker{}, [&](std::span<const Batch> batches) {
        std::vector<std::span<const exact::TriplePoint>> lists;
        for (const Batch& batch : batches) lists.emplace_back(batch.points);
        const auto places = points.places<exact::TriplePoint>(lists, context);
        if (context.cancelled()) return;
        for (std::size_t b = 0; b < batches.size(); ++b) {
            const Batch& batch = batches[b];
            ids.clear();
            for (std::size_t i = 0; i < batch.points.size(); ++i)
                ids.push_back(points.add(batch.points[i], places[b][i]));
            for (BoundedSegment edge : batch.edges) {
                edge.segment.from = ids[edge.segment.from], edge.segment.to = ids[edge.segment.to];
                found.edges.push_back(edge);
            }
            found.fragments += batch.fragments;
        }
    });
    return found;
}

}  // namespace octavo::bsp_octree
