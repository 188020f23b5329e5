// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <octavo/render/outline.hpp>
#include <octavo/render/strokes.hpp>

namespace octavo::render {
namespace {

/// Visible or hidden parts shorter than this are not drawn: rounding at the ends of lines, in steps.
constexpr double least_length = 0.03 * steps_of_pixel;

using Segment = std::pair<DrawingPoint, DrawingPoint>;

/// The segments of one colour, which are made strokes of.
class Chains {
  public:
    explicit Chains(std::vector<Segment> segments) {
        for (Segment& s : segments)
            if (s.second < s.first) std::swap(s.first, s.second);
        std::sort(segments.begin(), segments.end());
        segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
        for (std::uint32_t i = 0; i < segments.size(); ++i) {
            halves_.push_back({segments[i].first, segments[i].second, i});
            halves_.push_back({segments[i].second, segments[i].first, i});
        }
        std::sort(halves_.begin(), halves_.end(), [](const Half& a, const Half& b) {
            return std::tie(a.from, a.to) < std::tie(b.from, b.to);
        });
        used_.resize(segments.size());
    }

    std::vector<Polyline> take() {
        std::vector<Polyline> lines;
        // From where lines end or branch first; what is left then are closed lines.
        for (const bool closed : {false, true})
            for (std::size_t i = 0; i < halves_.size(); ++i)
                if (!used_[halves_[i].segment] && (closed || degree(halves_[i].from) != 2))
                    lines.push_back(line_without_needless_points(follow(i)));
        return lines;
    }

  private:
    struct Half {
        DrawingPoint from, to;
        std::uint32_t segment;
    };

    std::pair<std::size_t, std::size_t> around(DrawingPoint p) const {
        const auto begin = std::lower_bound(halves_.begin(), halves_.end(), p,
                                            [](const Half& half, DrawingPoint at) { return half.from < at; });
        auto end = begin;
        while (end != halves_.end() && end->from == p) ++end;
        return {static_cast<std::size_t>(begin - halves_.begin()),
                static_cast<std::size_t>(end - halves_.begin())};
    }
    std::size_t degree(DrawingPoint p) const {
        const auto [begin, end] = around(p);
        return end - begin;
    }

    Polyline follow(std::size_t half) {
        Polyline line{halves_[half].from};
        while (true) {
            used_[halves_[half].segment] = 1;
            const DrawingPoint at = halves_[half].to;
            line.push_back(at);
            const auto [begin, end] = around(at);
            if (end - begin != 2) return line;
            half = used_[halves_[begin].segment] ? begin + 1 : begin;
            if (used_[halves_[half].segment]) return line;
        }
    }

    std::vector<Half> halves_;
    std::vector<char> used_;
};

/// Segments by colour, in the order in which colours first come.
class SegmentsByColor {
  public:
    void add(Color color, DrawingPoint from, DrawingPoint to) {
        if (std::hypot(to.x - from.x, to.y - from.y) < least_length) return;
        auto at =
            std::find_if(groups_.begin(), groups_.end(), [&](const auto& g) { return g.first == color; });
        if (at == groups_.end()) at = groups_.insert(at, {color, {}});
        at->second.emplace_back(from, to);
    }
    std::vector<Strokes> strokes() && {
        std::vector<Strokes> result;
        for (auto& [color, segments] : groups_) result.push_back({color, Chains(std::move(segments)).take()});
        return result;
    }

  private:
    std::vector<std::pair<Color, std::vector<Segment>>> groups_;
};

}  // namespace

LineStrokes strokes_of(std::span<const Line> lines, std::span<const LinePart> hidden, const Camera& camera) {
    SegmentsByColor seen, unseen;
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
        const Vec3 start = camera.project(lines[i].from), end = camera.project(lines[i].to);
        const auto at = [&](double t) -> DrawingPoint {
            const auto step = [&](double from, double to) {
                return static_cast<std::int32_t>(std::lround((from + t * (to - from)) * steps_of_pixel));
            };
            return {step(start.x, end.x), step(start.y, end.y)};
        };
        double done = 0;
        for (; next < hidden.size() && hidden[next].line == i; ++next) {
            seen.add(lines[i].color, at(done), at(hidden[next].from));
            unseen.add(lines[i].color, at(hidden[next].from), at(hidden[next].to));
            done = hidden[next].to;
        }
        seen.add(lines[i].color, at(done), at(1));
    }
    return {std::move(seen).strokes(), std::move(unseen).strokes()};
}

}  // namespace octavo::render
