// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>

#include <octavo/bsp/build.hpp>

namespace octavo::bsp {
namespace {

/// More signs than this are not kept but asked again: trees of thousands of planes are rare and need no speed, but a
/// vertex with 10^5 faces must not ask for 10 GB.
constexpr std::size_t most_signs = std::size_t{1} << 22;

/// Faces have sets of their vertices up to this many words; longer ones are slower than going round the corners, and
/// many faces in few planes would have many.
constexpr std::size_t most_face_words = 4;

/// Whether it is worth while to look for a plane that is no face's: one that cuts `both` faces and leaves `more` on one
/// side is the best of those that are. Few faces lie in every other plane by chance.
bool separates_poorly(std::uint32_t both, std::uint32_t more, std::uint32_t count) {
    constexpr std::uint32_t few = 8, many = 256;
    return (count >= few && both > count / 8) || (count >= many && more > count - count / 8);
}

constexpr std::size_t word_bits = 64;
constexpr std::size_t words_for(std::size_t vertices) { return (vertices + word_bits - 1) / word_bits; }
constexpr std::uint64_t bit_of(std::uint32_t vertex) { return std::uint64_t{1} << vertex % word_bits; }

}  // namespace

void TreeBuilder::build(FragmentPool& pool, PlaneTable& planes, std::span<const Fragment> fragments,
                        std::vector<Node>& nodes) {
    OCTAVO_DCHECK(&pool.planes() == &planes, "separators must be added to the table of the pool");
    const FragmentPool::Mark mark = pool.mark();
    table_ = &planes;
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
            const Sides side = sides(piece, plane);
            std::uint32_t front = piece, back = piece;
            if (side.front && side.back) cut(piece, plane, front, back);
            if (side.front) front_.push_back(front);
            if (side.back) back_list_.push_back(back);
        }
        // A side without faces is on one side of the faces in the plane, all over; a separator has faces on both.
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
    plane_number_.clear(), vertex_number_.clear(), corners_.clear(), pieces_.clear();
    for (const Fragment& f : fragments) {
        pieces_.push_back({static_cast<std::uint32_t>(corners_.size()), f.count,
                           plane_number_(f.facing.plane()), f.facing.reversed()});
        for (const Corner& corner : pool.corners(f))
            corners_.push_back({vertex_number_(corner.vertex), corner.edge});
    }
    planes_.assign(plane_number_.values().begin(), plane_number_.values().end());
    vertices_.assign(vertex_number_.values().begin(), vertex_number_.values().end());
    coefficients_.clear(), places_.clear();
    for (const PlaneId id : planes_) coefficients_.push_back(coefficients_of(pool.planes()[id]));
    for (const VertexId vertex : vertices_) places_.push_back(pool.approximation(vertex));
    keeps_signs_ = vertices_.size() * planes_.size() <= most_signs;
    piece_sets_.clear();
    if (keeps_signs_) begin_sets();
}

/// Nothing is asked yet but that the corners of a face lie in its plane.
void TreeBuilder::begin_sets() {
    // Room for the vertices that cuts make, mostly.
    words_ = words_for(vertices_.size() + vertices_.size() / 4 + 8);
    sets_.assign(3 * planes_.size() * words_, 0);
    for (std::uint32_t plane = 0; plane < planes_.size(); ++plane)
        std::fill_n(unasked_set(plane), words_, ~Word{0});
    for (const Piece& piece : pieces_)
        for (std::uint32_t i = 0; i < piece.count; ++i) {
            const std::uint32_t vertex = corners_[piece.begin + i].vertex;
            unasked_set(piece.plane)[vertex / word_bits] &= ~bit_of(vertex);
        }
    piece_sets_.clear();
    if (words_ > most_face_words) return;
    piece_sets_.resize(pieces_.size() * words_);
    for (std::uint32_t piece = 0; piece < pieces_.size(); ++piece) fill_piece_set(piece);
}

void TreeBuilder::fill_piece_set(std::uint32_t number) {
    const Piece& piece = pieces_[number];
    Word* const vertices = vertices_of(number);
    for (std::uint32_t i = 0; i < piece.count; ++i) {
        const std::uint32_t vertex = corners_[piece.begin + i].vertex;
        vertices[vertex / word_bits] |= bit_of(vertex);
    }
}

/// Twice as many words a set.
void TreeBuilder::widen_sets() {
    const auto widened = [&](const std::vector<Word>& sets) {
        std::vector<Word> wide(2 * sets.size());
        for (std::size_t from = 0, to = 0; from < sets.size(); from += words_, to += 2 * words_)
            std::copy_n(sets.begin() + static_cast<std::ptrdiff_t>(from), words_,
                        wide.begin() + static_cast<std::ptrdiff_t>(to));
        return wide;
    };
    sets_ = widened(sets_);
    if (2 * words_ <= most_face_words)
        piece_sets_ = widened(piece_sets_);
    else
        piece_sets_.clear();
    words_ *= 2;
    for (std::uint32_t plane = 0; plane < planes_.size(); ++plane)
        std::fill_n(unasked_set(plane) + words_ / 2, words_ / 2, ~Word{0});
}

void TreeBuilder::add_piece(const Piece& piece) {
    pieces_.push_back(piece);
    if (!has_piece_sets()) return;
    piece_sets_.resize(pieces_.size() * words_);
    fill_piece_set(static_cast<std::uint32_t>(pieces_.size() - 1));
}

std::uint32_t TreeBuilder::choose(std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t count = end - begin;
    if (options_.partition == Partition::first || count == 1) return pieces_[list_[begin]].plane;
    if (options_.partition == Partition::random) return pieces_[list_[begin + random_below(count)]].plane;
    // Where signs are not kept, each candidate costs as much as the cut itself.
    const std::uint32_t candidates = std::min(keeps_signs_ ? options_.candidates : 1, count);
    std::uint32_t best = 0, least = ~std::uint32_t{0};
    Score found;
    for (std::uint32_t i = 0; i < candidates; ++i) {
        const std::uint32_t at = keeps_signs_ ? i * count / candidates : random_below(count);
        const std::uint32_t plane = pieces_[list_[begin + at]].plane;
        const Score score_here = score(plane, begin, end, least);
        if (score_here.cost() < least) least = score_here.cost(), best = plane, found = score_here;
    }
    if (!separates_poorly(found.both, std::max(found.front, found.back), count)) return best;
    return choose_separator(begin, end, least).value_or(best);
}

std::uint32_t TreeBuilder::random_below(std::uint32_t count) {
    random_ = random_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<std::uint32_t>((random_ >> 33) % count);
}

/// What a plane does to the pieces; when it costs no less than `enough`, something that does not either.
TreeBuilder::Score TreeBuilder::score(std::uint32_t plane, std::uint32_t begin, std::uint32_t end,
                                      std::uint32_t enough) {
    Score result;
    for (std::uint32_t i = begin; i < end; ++i) {
        if (pieces_[list_[i]].plane == plane) continue;
        const Sides side = sides(list_[i], plane);
        result.both += side.front && side.back;
        result.front += side.front && !side.back;
        result.back += side.back && !side.front;
        if (Score{0, 0, result.both}.cost() >= enough) return {0, 0, result.both};
    }
    return result;
}

/// As sides(), where some vertex was not asked about yet or sets are not kept.
TreeBuilder::Sides TreeBuilder::ask_sides(std::uint32_t number, std::uint32_t plane) {
    Sides result;
    const Piece& piece = pieces_[number];
    if (!has_piece_sets()) {
        for (std::uint32_t i = 0; i < piece.count; ++i) {
            const int side = sign(corners_[piece.begin + i].vertex, plane);
            result.front = result.front || side > 0;
            result.back = result.back || side < 0;
        }
        return result;
    }
    const Word* const vertices = vertices_of(number);
    Word *const front = front_set(plane), *const back = back_set(plane), *const unasked = unasked_set(plane);
    for (std::size_t w = 0; w < words_; ++w) {
        for (Word open = vertices[w] & unasked[w]; open; open &= open - 1) {
            const Word bit = open & (~open + 1);
            const auto vertex = static_cast<std::uint32_t>(word_bits * w) +
                                static_cast<std::uint32_t>(std::countr_zero(open));
            const int side = ask(vertex, plane);
            front[w] |= side > 0 ? bit : 0;
            back[w] |= side < 0 ? bit : 0;
            unasked[w] ^= bit;
        }
        result.front = result.front || (vertices[w] & front[w]);
        result.back = result.back || (vertices[w] & back[w]);
    }
    return result;
}

int TreeBuilder::ask(std::uint32_t vertex, const Coefficients& f, const exact::Plane& plane) const {
    // The filter of exact/side.hpp, with its proof, on copies that lie side by side.
    const Vec3& p = places_[vertex];
    const double ax = f.a * p.x, by = f.b * p.y, cz = f.c * p.z;
    const double sum = (ax + by) + (cz + f.d);
    const double magnitude = (std::fabs(ax) + std::fabs(by)) + (std::fabs(cz) + std::fabs(f.d));
    constexpr double eight_u = 0x1p-50;
    if (std::fabs(sum) > eight_u * magnitude) [[likely]]
        return sum > 0 ? 1 : -1;
    return static_cast<int>(pool_->side_of(plane, vertices_[vertex]));
}

int TreeBuilder::sign(std::uint32_t vertex, std::uint32_t plane) {
    if (!keeps_signs_) return ask(vertex, plane);
    const std::size_t word = vertex / word_bits;
    const Word bit = bit_of(vertex);
    Word &front = front_set(plane)[word], &back = back_set(plane)[word], &unasked = unasked_set(plane)[word];
    if (unasked & bit) {
        const int side = ask(vertex, plane);
        front |= side > 0 ? bit : 0;
        back |= side < 0 ? bit : 0;
        unasked ^= bit;
    }
    return front & bit ? 1 : back & bit ? -1 : 0;
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
    add_piece({begin, middle - begin, piece.plane, piece.reversed});
    add_piece({middle, static_cast<std::uint32_t>(corners_.size()) - middle, piece.plane, piece.reversed});
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
    places_.push_back(pool_->approximation(made));
    if (!keeps_signs_) return vertex;
    if (vertex == word_bits * words_) widen_sets();
    // Between two points on one side of a plane, or one on it and one on a side, a point is on that side; between two
    // points in it, in it. Only where the ends are on different sides it has to be asked.
    const std::size_t from = corner.vertex / word_bits, to = next / word_bits, at = vertex / word_bits;
    const Word from_bit = bit_of(corner.vertex), to_bit = bit_of(next), bit = bit_of(vertex);
    for (std::uint32_t p = 0; p < planes_.size(); ++p) {
        Word *const front = front_set(p), *const back = back_set(p), *const unasked = unasked_set(p);
        if ((unasked[from] & from_bit) || (unasked[to] & to_bit)) continue;
        const bool in_front = (front[from] & from_bit) || (front[to] & to_bit);
        const bool behind = (back[from] & from_bit) || (back[to] & to_bit);
        if (in_front && behind) continue;
        unasked[at] &= ~bit;
        if (in_front) front[at] |= bit;
        if (behind) back[at] |= bit;
    }
    for (const std::uint32_t p : {plane, piece.plane}) {
        unasked_set(p)[at] &= ~bit;
        front_set(p)[at] &= ~bit;
        back_set(p)[at] &= ~bit;
    }
    return vertex;
}

}  // namespace octavo::bsp
