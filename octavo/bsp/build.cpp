// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp/build.hpp>

namespace octavo::bsp {
namespace {

constexpr std::int8_t unknown = 2;

/// More signs than this are not kept but asked again: trees of thousands of planes are rare and need no speed, but a
/// vertex with 10^5 faces must not ask for 10 GB.
constexpr std::size_t most_signs = std::size_t{1} << 22;

}  // namespace

void TreeBuilder::build(FragmentPool& pool, std::span<const Fragment> fragments, std::vector<Node>& nodes) {
    const FragmentPool::Mark mark = pool.mark();
    gather(pool, fragments);
    const auto base = static_cast<std::int32_t>(nodes.size());
    list_.clear();
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) list_.push_back(i);
    tasks_.clear();
    tasks_.push_back({0, -1, false});
    while (!tasks_.empty()) {
        const Task task = tasks_.back();
        tasks_.pop_back();
        const auto end = static_cast<std::uint32_t>(list_.size());
        const std::uint32_t plane = choose(task.begin, end);
        const auto index = static_cast<std::int32_t>(nodes.size()) - base;
        if (task.parent >= 0) {
            Node& parent = nodes[static_cast<std::size_t>(base + task.parent)];
            (task.is_front ? parent.front : parent.back) = Child{index};
        }

        front_.clear(), back_list_.clear();
        bool reversed = false;
        made_.clear();
        pool.begin_cut(Bound::plane(planes_[plane]));
        for (std::uint32_t i = task.begin; i < end; ++i) {
            const std::uint32_t piece = list_[i];
            if (pieces_[piece].plane == plane) {
                reversed = pieces_[piece].reversed;
                continue;
            }
            const Count side = sides(pieces_[piece], plane);
            std::uint32_t front = piece, back = piece;
            if (side.front && side.back) cut(piece, plane, front, back);
            if (side.front) front_.push_back(front);
            if (side.back) back_list_.push_back(back);
        }
        // A side without faces is on one side of the faces in the plane, all over.
        nodes.push_back({planes_[plane], Child::leaf(reversed ? Label::in : Label::out),
                         Child::leaf(reversed ? Label::out : Label::in)});
        list_.resize(task.begin);
        if (!back_list_.empty()) {
            tasks_.push_back({task.begin, index, false});
            list_.insert(list_.end(), back_list_.begin(), back_list_.end());
        }
        if (!front_.empty()) {
            tasks_.push_back({static_cast<std::uint32_t>(list_.size()), index, true});
            list_.insert(list_.end(), front_.begin(), front_.end());
        }
    }
    pool.release(mark);
}

void TreeBuilder::gather(FragmentPool& pool, std::span<const Fragment> fragments) {
    OCTAVO_CHECK(!fragments.empty(), "a BSP tree needs a face");
    pool_ = &pool;
    planes_.clear(), vertices_.clear(), corners_.clear(), pieces_.clear();
    for (const Fragment& f : fragments) {
        planes_.push_back(f.facing.plane());
        for (const Corner& corner : pool.corners(f)) vertices_.push_back(corner.vertex);
    }
    const auto make_unique = [](auto& numbers) {
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    };
    const auto number_of = [](const auto& numbers, std::uint32_t value) {
        return static_cast<std::uint32_t>(std::lower_bound(numbers.begin(), numbers.end(), value) -
                                          numbers.begin());
    };
    make_unique(planes_), make_unique(vertices_);
    for (const Fragment& f : fragments) {
        pieces_.push_back({static_cast<std::uint32_t>(corners_.size()), f.count,
                           number_of(planes_, f.facing.plane()), f.facing.reversed()});
        for (const Corner& corner : pool.corners(f))
            corners_.push_back({number_of(vertices_, corner.vertex), corner.edge});
    }
    keeps_signs_ = vertices_.size() * planes_.size() <= most_signs;
    signs_.clear();
    if (!keeps_signs_) return;
    signs_.resize(vertices_.size() * planes_.size(), unknown);
    // The corners of a face lie in its plane.
    for (const Piece& piece : pieces_)
        for (std::uint32_t i = 0; i < piece.count; ++i)
            signs_[corners_[piece.begin + i].vertex * planes_.size() + piece.plane] = 0;
}

std::uint32_t TreeBuilder::choose(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t count = end - begin;
    if (options_.partition == Partition::first || count == 1) return pieces_[list_[begin]].plane;
    if (options_.partition == Partition::random || !keeps_signs_) {
        random_ = random_ * 6364136223846793005ull + 1442695040888963407ull;
        return pieces_[list_[begin + static_cast<std::uint32_t>((random_ >> 33) % count)]].plane;
    }
    const std::uint32_t candidates = std::min(options_.candidates, count);
    std::uint32_t best = 0, least = ~std::uint32_t{0};
    for (std::uint32_t i = 0; i < candidates; ++i) {
        const std::uint32_t plane = pieces_[list_[begin + i * count / candidates]].plane;
        const std::uint32_t cost = score(plane, begin, end);
        if (cost < least) least = cost, best = plane;
    }
    return best;
}

std::uint32_t TreeBuilder::score(std::uint32_t plane, std::uint32_t begin, std::uint32_t end) {
    std::uint32_t front = 0, back = 0, both = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        const Piece& piece = pieces_[list_[i]];
        if (piece.plane == plane) continue;
        const Count side = sides(piece, plane);
        both += side.front && side.back;
        front += side.front && !side.back;
        back += side.back && !side.front;
    }
    // A cut makes one more face, and so at least one more node; a tree that leans costs depth only.
    return 4 * both + (front > back ? front - back : back - front);
}

TreeBuilder::Count TreeBuilder::sides(const Piece& piece, std::uint32_t plane) {
    Count count;
    for (std::uint32_t i = 0; i < piece.count; ++i) {
        const int side = sign(corners_[piece.begin + i].vertex, plane);
        count.front += side > 0;
        count.back += side < 0;
    }
    return count;
}

int TreeBuilder::sign(std::uint32_t vertex, std::uint32_t plane) {
    if (!keeps_signs_)
        return static_cast<int>(pool_->side_of(pool_->planes()[planes_[plane]], vertices_[vertex]));
    std::int8_t& kept = signs_[vertex * planes_.size() + plane];
    if (kept == unknown)
        kept = static_cast<std::int8_t>(pool_->side_of(pool_->planes()[planes_[plane]], vertices_[vertex]));
    return kept;
}

void TreeBuilder::cut(std::uint32_t index, std::uint32_t plane, std::uint32_t& front, std::uint32_t& back) {
    ++splits_;
    const Piece piece = pieces_[index];
    const std::size_t room = corners_.size() + 2 * piece.count + 4;
    if (room > corners_.capacity()) corners_.reserve(2 * room);
    const std::span<const Corner> ring{corners_.data() + piece.begin, piece.count};
    const auto begin = static_cast<std::uint32_t>(corners_.size());
    back_.clear();
    split_ring(
        ring, Bound::plane(planes_[plane]), [&](std::size_t i) { return sign(ring[i].vertex, plane); },
        [&](std::size_t i) { return make_vertex(piece, static_cast<std::uint32_t>(i), plane); }, corners_,
        back_);
    const auto middle = static_cast<std::uint32_t>(corners_.size());
    corners_.insert(corners_.end(), back_.begin(), back_.end());
    front = static_cast<std::uint32_t>(pieces_.size());
    back = front + 1;
    pieces_.push_back({begin, middle - begin, piece.plane, piece.reversed});
    pieces_.push_back(
        {middle, static_cast<std::uint32_t>(corners_.size()) - middle, piece.plane, piece.reversed});
}

std::uint32_t TreeBuilder::make_vertex(const Piece& piece, std::uint32_t i, std::uint32_t plane) {
    const Corner corner = corners_[piece.begin + i];
    const std::uint32_t next = corners_[piece.begin + (i + 1 == piece.count ? 0 : i + 1)].vertex;
    const VertexId made =
        pool_->cut_edge(planes_[piece.plane], {vertices_[corner.vertex], corner.edge}, vertices_[next]);
    for (const Made& before : made_)
        if (before.vertex == made) return before.number;
    const auto vertex = static_cast<std::uint32_t>(vertices_.size());
    made_.push_back({made, vertex});
    vertices_.push_back(made);
    if (!keeps_signs_) return vertex;
    // Between two points on one side of a plane, or one on it and one on a side, a point is on that side.
    const std::size_t count = planes_.size();
    signs_.resize(signs_.size() + count);
    const std::int8_t* const from = signs_.data() + corner.vertex * count;
    const std::int8_t* const to = signs_.data() + next * count;
    std::int8_t* const to_set = signs_.data() + vertex * count;
    for (std::size_t p = 0; p < count; ++p) {
        const int sum = from[p] + to[p];
        const bool known = from[p] != unknown && to[p] != unknown && (sum != 0 || from[p] == 0);
        to_set[p] = known ? static_cast<std::int8_t>((sum > 0) - (sum < 0)) : unknown;
    }
    to_set[plane] = to_set[piece.plane] = 0;
    return vertex;
}

}  // namespace octavo::bsp
