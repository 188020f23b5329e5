// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <mutex>
#include <utility>

#include <octavo/base/parallel.hpp>
#include <octavo/render/flat_scene.hpp>
#include <octavo/render/visible.hpp>

namespace octavo::render {
namespace {

/// Squares are divided until no more patches than this touch them. Twice as many or half as many cost 10 to 20 % more
/// time; more also cut the area that is left into more pieces.
constexpr std::size_t patches_of_square = 12;

/// No square is divided below this, in pixels: where thousands of patches meet in one point, nothing is gained.
constexpr double least_side = 0.25;

constexpr double largest_side = 64;

/// Visible parts smaller than this are rounding, in square pixels.
constexpr double least_piece = 1e-7;

/// Convex polygons, one after the other.
struct Polygons {
    std::vector<Point2> corners;
    std::vector<std::uint32_t> ends;

    void clear() { corners.clear(), ends.clear(); }
    bool empty() const { return ends.empty(); }
    std::size_t size() const { return ends.size(); }
    void truncate(std::size_t count) {
        ends.resize(count);
        corners.resize(count ? ends.back() : 0);
    }
    void push(std::span<const Point2> polygon) {
        corners.insert(corners.end(), polygon.begin(), polygon.end());
        ends.push_back(static_cast<std::uint32_t>(corners.size()));
    }
    std::span<const Point2> operator[](std::size_t i) const {
        const std::uint32_t begin = i ? ends[i - 1] : 0;
        return {corners.data() + begin, ends[i] - begin};
    }
};

using Ids = std::vector<std::uint32_t>;

/// What touches a square.
struct Square {
    Rect rect;
    Ids patches;  ///< from the front to the back
    Ids lines;
};

/// Sorts parts of lines, and joins those that touch.
void join(std::vector<LinePart>& parts) {
    std::sort(parts.begin(), parts.end(), [](const LinePart& a, const LinePart& b) {
        return a.line != b.line ? a.line < b.line : a.from < b.from;
    });
    std::size_t kept = 0;
    for (const LinePart& part : parts) {
        constexpr double gap = 1e-9;
        if (kept && parts[kept - 1].line == part.line && part.from <= parts[kept - 1].to + gap)
            parts[kept - 1].to = std::max(parts[kept - 1].to, part.to);
        else
            parts[kept++] = part;
    }
    parts.resize(kept);
}

/// Removes what is hidden in one square after the other.
class SquareSolver {
  public:
    explicit SquareSolver(const FlatScene& scene) : scene_(scene) {}

    void solve(Square square) {
        const auto covering =
            std::find_if(square.patches.begin(), square.patches.end(),
                         [&](std::uint32_t id) { return scene_.covers(scene_.patches()[id], square.rect); });
        if (covering != square.patches.end()) square.patches.erase(covering + 1, square.patches.end());
        if (square.patches.empty()) return;
        const double side = square.rect.high.x - square.rect.low.x;
        if (square.patches.size() <= patches_of_square || side / 2 < least_side) {
            find_pieces(square);
            find_hidden(square);
            return;
        }
        for (int quarter = 0; quarter < 4; ++quarter) solve(quarter_of(square, quarter));
    }

    Visible take() && {
        join(visible_.hidden);
        return std::move(visible_);
    }

  private:
    Square quarter_of(const Square& square, int quarter) const {
        const Point2 low = square.rect.low, high = square.rect.high;
        const Point2 middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
        Square part;
        part.rect = {{quarter & 1 ? middle.x : low.x, quarter & 2 ? middle.y : low.y},
                     {quarter & 1 ? high.x : middle.x, quarter & 2 ? high.y : middle.y}};
        for (const std::uint32_t id : square.patches)
            if (scene_.touches(scene_.patches()[id], part.rect)) part.patches.push_back(id);
        for (const std::uint32_t id : square.lines)
            if (!scene_.within(scene_.lines()[id], part.rect).empty()) part.lines.push_back(id);
        return part;
    }

    void find_pieces(const Square& square) {
        free_.clear();
        free_.push(square.rect.corners());
        for (const std::uint32_t id : square.patches) {
            rest_.clear();
            for (std::size_t i = 0; i < free_.size(); ++i) take_from(free_[i], id);
            std::swap(free_, rest_);
            if (free_.empty()) break;
        }
    }

    /// What of a free polygon lies in the patch becomes a piece; the rest stays free.
    void take_from(std::span<const Point2> polygon, std::uint32_t id) {
        const std::size_t before = rest_.size();
        inside_.assign(polygon.begin(), polygon.end());
        for (const Line2& edge : scene_.edges(scene_.patches()[id])) {
            cut(inside_, edge, left_, right_);
            if (!right_.empty()) rest_.push(right_);
            std::swap(inside_, left_);
            if (inside_.empty()) break;
        }
        if (inside_.empty() || std::fabs(twice_area(inside_)) < 2 * least_piece) {
            rest_.truncate(before);
            rest_.push(polygon);
            return;
        }
        visible_.pieces.push_back({id, static_cast<std::uint32_t>(visible_.corners.size()),
                                   static_cast<std::uint32_t>(inside_.size())});
        visible_.corners.insert(visible_.corners.end(), inside_.begin(), inside_.end());
    }

    void find_hidden(const Square& square) {
        for (const std::uint32_t id : square.lines) {
            const FlatLine& line = scene_.lines()[id];
            const Stretch stretch = scene_.within(line, square.rect);
            parts_.clear();
            for (const std::uint32_t patch : square.patches) {
                const Stretch hidden = scene_.hidden(line, stretch, scene_.patches()[patch]);
                if (!hidden.empty()) parts_.push_back({id, hidden.from, hidden.to});
            }
            join(parts_);
            visible_.hidden.insert(visible_.hidden.end(), parts_.begin(), parts_.end());
        }
    }

    const FlatScene& scene_;
    Visible visible_;
    Polygons free_, rest_;
    std::vector<Point2> inside_, left_, right_;
    std::vector<LinePart> parts_;
};

/// The squares that the picture is divided into at first, row by row.
struct Grid {
    int columns, rows;
    std::vector<Square> squares;
};

Grid divide(const FlatScene& scene, int width, int height) {
    Grid grid{static_cast<int>(std::ceil(width / largest_side)),
              static_cast<int>(std::ceil(height / largest_side)),
              {}};
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
            grid.squares.push_back({{{column * largest_side, row * largest_side},
                                     {(column + 1) * largest_side, (row + 1) * largest_side}},
                                    {},
                                    {}});
    const auto visit = [&](const Rect& bounds, const auto& add) {
        const auto index = [](double at, int count) {
            return static_cast<int>(std::clamp(std::floor(at / largest_side), 0.0, count - 1.0));
        };
        // A patch on the wall between two squares belongs to both.
        for (int row = index(bounds.low.y - on_line, grid.rows);
             row <= index(bounds.high.y + on_line, grid.rows); ++row)
            for (int column = index(bounds.low.x - on_line, grid.columns);
                 column <= index(bounds.high.x + on_line, grid.columns); ++column)
                add(grid.squares[static_cast<std::size_t>(row) * grid.columns + column]);
    };
    for (std::uint32_t id = 0; id < scene.patches().size(); ++id) {
        const FlatPatch& patch = scene.patches()[id];
        if (patch.count == 0) continue;
        visit(patch.bounds, [&](Square& square) {
            if (scene.touches(patch, square.rect)) square.patches.push_back(id);
        });
    }
    for (std::uint32_t id = 0; id < scene.lines().size(); ++id) {
        const FlatLine& line = scene.lines()[id];
        const Rect bounds{{std::min(line.start.x, line.end.x), std::min(line.start.y, line.end.y)},
                          {std::max(line.start.x, line.end.x), std::max(line.start.y, line.end.y)}};
        visit(bounds, [&](Square& square) {
            if (!scene.within(line, square.rect).empty()) square.lines.push_back(id);
        });
    }
    return grid;
}

/// Tells how many of the squares are done, one thread at a time.
class SquareCounter {
  public:
    SquareCounter(std::size_t count, const Context& context) : count_(count), context_(context) {}
    void add_one() {
        const std::lock_guard lock(mutex_);
        context_.report("hidden parts", static_cast<double>(++done_) / static_cast<double>(count_));
    }

  private:
    std::size_t count_, done_ = 0;
    const Context& context_;
    std::mutex mutex_;
};

}  // namespace

Result<Visible> visible_parts(const Patches& patches, std::span<const WorldLine> lines, const Camera& camera,
                              int width, int height, const Context& context) {
    const FlatScene scene(patches, lines, camera);
    Grid grid = divide(scene, width, height);
    std::vector<Visible> parts(grid.squares.size());
    SquareCounter counter(parts.size(), context);
    parallel_chunks(context, parts.size(), 1, [&](std::size_t begin, std::size_t) {
        SquareSolver solver(scene);
        solver.solve(std::move(grid.squares[begin]));
        parts[begin] = std::move(solver).take();
        counter.add_one();
    });
    if (context.cancelled()) return Context::cancelled_error();

    Visible all;
    for (Visible& part : parts) {
        const auto shift = static_cast<std::uint32_t>(all.corners.size());
        for (Piece piece : part.pieces) {
            piece.begin += shift;
            all.pieces.push_back(piece);
        }
        all.corners.insert(all.corners.end(), part.corners.begin(), part.corners.end());
        all.hidden.insert(all.hidden.end(), part.hidden.begin(), part.hidden.end());
        part = {};
    }
    join(all.hidden);
    return all;
}

}  // namespace octavo::render
