// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <span>

#include <octavo/base/parallel.hpp>
#include <octavo/base/shared_progress.hpp>
#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp_octree/fragment_edges.hpp>
#include <octavo/bsp_octree/shared_lines.hpp>

namespace octavo::bsp_octree {
namespace {

using boolean::no_index;
using boolean::PointId;
using boolean::PointTable;

struct Leaf {
    octree::Cell cell;
    NodeRef node;
};

/// What one task finds in some leaves: ends of edges are numbers of points of its own.
struct Batch {
    std::vector<exact::TriplePoint> points;
    std::vector<BoundedSegment> edges;
    std::size_t fragments = 0;
};

class BatchMaker {
  public:
    explicit BatchMaker(const Store& store) : store_(store), pool_(store.planes) {}

    void add(const Leaf& leaf, Batch& batch) {
        const bsp::FragmentPool::Mark empty = pool_.mark();
        fragments_.clear();
        extractor_.extract(pool_, leaf.cell, store_.tree(leaf.node), fragments_);
        number_.assign(pool_.mark().vertices, no_index);
        lines_.begin(store_.planes, fragments_);
        for (const bsp::Fragment& fragment : fragments_) {
            const std::span<const bsp::Corner> ring = pool_.corners(fragment);
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const bsp::Corner& next = ring[i + 1 == ring.size() ? 0 : i + 1];
                const PointId from = number_of(ring[i].vertex, batch);
                batch.edges.push_back({{fragment.facing, from, number_of(next.vertex, batch)},
                                       ring[i].edge,
                                       lines_.may_be_shared(fragment.facing.plane(), ring[i].edge,
                                                            pool_.approximation(ring[i].vertex))});
            }
        }
        batch.fragments += fragments_.size();
        pool_.release(empty);
    }

  private:
    PointId number_of(bsp::VertexId vertex, Batch& batch) {
        PointId& number = number_[vertex & ~bsp::FragmentPool::constructed_bit];
        if (number == no_index) {
            number = static_cast<PointId>(batch.points.size());
            batch.points.push_back(pool_.constructed(vertex));
        }
        return number;
    }

    const Store& store_;
    bsp::FragmentPool pool_;
    bsp::BoundaryExtractor extractor_;
    std::vector<bsp::Fragment> fragments_;
    SharedLines lines_;
    std::vector<PointId> number_;  ///< of each vertex of the leaf in the batch
};

}  // namespace

FragmentEdges fragment_edges(const BspOctree& octree, PointTable& points, const Context& context) {
    constexpr std::size_t batch_leaves = 64, most_batches = 128;
    std::vector<Leaf> leaves;
    octree.for_each_leaf([&](const octree::Cell& cell, NodeRef leaf) {
        if (leaf.is_bsp()) leaves.push_back({cell, leaf});
    });
    FragmentEdges found;
    std::vector<PointId> ids;
    for (std::size_t first = 0; first < leaves.size(); first += batch_leaves * most_batches) {
        const std::size_t count = std::min(leaves.size() - first, batch_leaves * most_batches);
        std::vector<Batch> batches((count + batch_leaves - 1) / batch_leaves);
        const auto share = [&](std::size_t done) {
            return static_cast<double>(done) / static_cast<double>(leaves.size());
        };
        SharedProgress progress(context, "faces", batches.size(), share(first), share(first + count));
        parallel_chunks(context, count, batch_leaves, [&](std::size_t begin, std::size_t end) {
            BatchMaker maker(octree.store());
            for (std::size_t i = begin; i < end; ++i)
                maker.add(leaves[first + i], batches[begin / batch_leaves]);
            progress.step();
        });
        if (context.cancelled()) return found;

        std::vector<std::span<const exact::TriplePoint>> lists;
        for (const Batch& batch : batches) lists.emplace_back(batch.points);
        const auto places = points.places<exact::TriplePoint>(lists, context);
        if (context.cancelled()) return found;
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
    }
    return found;
}

}  // namespace octavo::bsp_octree
