// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/numbering.hpp>
#include <octavo/bsp/tree.hpp>

// From faces to a BSP tree: choose the plane of a face, send the others to its sides, cut those on both, repeat.
//
// Which plane is what the size of a tree depends on. Candidates are the planes of faces spread evenly over the list;
// the one that cuts fewest, and among those halves best, wins. Signs of vertices are asked once for each plane and
// kept as bits: a plane has the set of vertices before it, that of those behind it, and that of those not asked about
// yet; a face has the set of its vertices; and where the face lies are three intersections of sets, a word or two each.
// A vertex that a cut makes on an edge inherits the signs on which the ends of the edge agree, and lies on the planes
// that it was made from. So faces round a common vertex, which touch one another's planes in that
// vertex and in shared edges, are never cut needlessly and hardly ever tested twice: what sorting them cyclically is
// for in the source, without having to sort.
//
// Slivers side by side, as in a fan across a cap that is not quite plane, lie across one another's planes, and n faces
// make n² pieces. So where the best plane cuts many, or leaves nearly all faces on one side of very many, planes
// through edges of faces and parallel to an axis are looked at too (separators): those between two of the slivers cut
// none, and n faces make 2 n nodes. A separator is a plane through lattice points, with coefficients shorter than those
// of faces.
//
// Coplanar faces are recognised by the number of their plane and make one node.
// Cost: 16 faces of a mesh in about 8 µs. Recursion uses a stack of its own: a chain of 10^5 nodes is fine.
// Source: Thibault and Naylor, Set operations on polyhedra using binary space partitioning trees, 1987; algorithm 3.2
// and its improvement in Argüelles, BSP-OctTree.

namespace octavo::bsp {

enum class Partition : std::uint8_t {
    fewest_splits,
    random,  ///< as Nehring-Wirxel, Trettner and Kobbelt do: no signs are compared to choose
    first,   ///< the face that comes first
};

struct BuildOptions {
    Partition partition = Partition::fewest_splits;
    /// Planes looked at for each node under `fewest_splits`. Twice as many make trees a hundredth smaller and take a
    /// tenth longer: measured in docs/methods/bsp_octree.md.
    std::uint32_t candidates = 4;
};

/// Builds one tree after the other and keeps its memory.
class TreeBuilder {
  public:
    explicit TreeBuilder(const BuildOptions& options = {}) : options_(options) {}

    /// Appends the tree of the solid whose boundary in a cell the fragments are; indices of children count from the
    /// first node appended. At least one fragment; all cut to the cell, none overlapping another with area.
    /// Vertices that it makes are released again.
    /// `planes` is the pool's table; separators are added to it.
    void build(FragmentPool& pool, PlaneTable& planes, std::span<const Fragment> fragments,
               std::vector<Node>& nodes);

    std::uint64_t splits() const { return splits_; }  ///< fragments that were cut, so far

  private:
    struct Piece {
        std::uint32_t begin, count;  ///< in corners_
        std::uint32_t plane;         ///< in planes_
        bool reversed;
    };
    struct Task {
        std::uint32_t begin;  ///< pieces from here to the end of the list
        std::int32_t parent;  ///< node to hang the tree on
        bool is_front;
    };
    using Word = std::uint64_t;
    /// On which sides of a plane a piece has something.
    struct Sides {
        bool front = false, back = false;
    };

    // Approximations of planes and vertices, side by side: most signs are told by them.
    struct Coefficients {
        double a, b, c, d;
    };
    static Coefficients coefficients_of(const exact::Plane& plane) {
        return {static_cast<double>(plane.a()), static_cast<double>(plane.b()),
                static_cast<double>(plane.c()), plane.d_approximation()};
    }
    /// Where pieces lie that are not in a plane.
    struct Score {
        std::uint32_t front = 0, back = 0, both = 0;
        std::uint32_t cost() const {
            // A cut makes one more face, and so at least one more node; a tree that leans costs depth only.
            constexpr std::uint32_t cost_of_cut = 4;
            return cost_of_cut * both + (front > back ? front - back : back - front);
        }
    };
    struct Separator {
        exact::Plane plane;
        PlaneTable::Points points;
    };

    void gather(FragmentPool& pool, std::span<const Fragment> fragments);
    std::uint32_t choose(std::uint32_t begin, std::uint32_t end);
    std::uint32_t random_below(std::uint32_t count);
    Score score(std::uint32_t plane, std::uint32_t begin, std::uint32_t end, std::uint32_t enough);
    std::optional<std::uint32_t> choose_separator(std::uint32_t begin, std::uint32_t end,
                                                  std::uint32_t enough);
    std::optional<Separator> separator_at(const Piece& piece, const Corner& corner) const;
    Score score(const Separator& separator, std::uint32_t begin, std::uint32_t end,
                std::uint32_t enough) const;
    std::uint32_t add_plane(PlaneId plane);
    Sides sides(std::uint32_t piece, std::uint32_t plane) {
        if (!has_piece_sets()) return ask_sides(piece, plane);
        if (words_ == 1) {
            const Word vertices = piece_sets_[piece], *const sets = &sets_[std::size_t{3} * plane];
            if (vertices & sets[2]) return ask_sides(piece, plane);
            return {(vertices & sets[0]) != 0, (vertices & sets[1]) != 0};
        }
        const Word *const vertices = vertices_of(piece), *const front = front_set(plane);
        const Word *const back = front + words_, *const unasked = back + words_;
        Word any_front = 0, any_back = 0, open = 0;
        for (std::size_t w = 0; w < words_; ++w) {
            any_front |= vertices[w] & front[w];
            any_back |= vertices[w] & back[w];
            open |= vertices[w] & unasked[w];
        }
        return open ? ask_sides(piece, plane) : Sides{any_front != 0, any_back != 0};
    }
    Sides ask_sides(std::uint32_t piece, std::uint32_t plane);
    int ask(std::uint32_t vertex, std::uint32_t plane) const {
        return ask(vertex, coefficients_[plane], pool_->planes()[planes_[plane]]);
    }
    int ask(std::uint32_t vertex, const Coefficients& approximation, const exact::Plane& plane) const;
    int sign(std::uint32_t vertex, std::uint32_t plane);
    void cut(std::uint32_t piece, std::uint32_t plane, std::uint32_t& front, std::uint32_t& back);
    std::uint32_t make_vertex(const Piece& piece, std::uint32_t corner, std::uint32_t plane);
    void begin_sets();
    void widen_sets();
    void add_piece(const Piece& piece);
    void fill_piece_set(std::uint32_t piece);
    bool has_piece_sets() const { return !piece_sets_.empty(); }

    Word* front_set(std::uint32_t plane) { return sets_.data() + 3 * plane * words_; }
    Word* back_set(std::uint32_t plane) { return front_set(plane) + words_; }
    Word* unasked_set(std::uint32_t plane) { return front_set(plane) + 2 * words_; }
    Word* vertices_of(std::uint32_t piece) { return piece_sets_.data() + piece * words_; }

    BuildOptions options_;
    std::uint64_t splits_ = 0, random_ = 1;

    // Everything below is of the tree at hand; vertices and planes have numbers of their own, from 0.
    FragmentPool* pool_ = nullptr;
    PlaneTable* table_ = nullptr;
    Numbering plane_number_, vertex_number_;
    std::vector<PlaneId> planes_;
    std::vector<VertexId> vertices_;
    std::vector<Coefficients> coefficients_;  ///< of planes_
    std::vector<Vec3> places_;                ///< of vertices_
    std::vector<Corner> corners_, back_;
    std::vector<Piece> pieces_;
    std::vector<std::uint32_t> list_, front_, back_list_;
    std::vector<Task> tasks_;
    // Sets of vertices, words_ words each: three of a plane, and one of a piece unless they would be long.
    std::size_t words_ = 1;
    std::vector<Word> sets_, piece_sets_;
    bool keeps_signs_ = true;
    struct Made {
        VertexId vertex;
        std::uint32_t number;
    };
    std::vector<Made> made_;  ///< by the cuts of the node at hand
};

}  // namespace octavo::bsp
