// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>

#include <octavo/bp_octree/bit_stream.hpp>
#include <octavo/bp_octree/geometry_codec.hpp>

namespace octavo::bp_octree {
namespace {

constexpr std::uint32_t none = 0xffffffff;

enum Corner : std::uint32_t { new_vertex = 0, after_gate = 1, before_gate = 2, by_number = 3 };

/// Directed edges as keys of an open-addressing table. Values are any numbers; a key may be stored many times.
class EdgeTable {
  public:
    explicit EdgeTable(std::size_t edges) : slots_(std::bit_ceil(2 * edges + 16)) {}

    void insert(std::uint32_t from, std::uint32_t to, std::uint32_t value) {
        std::size_t i = first_slot(from, to);
        while (slots_[i].value != none) i = (i + 1) & (slots_.size() - 1);
        slots_[i] = {from, to, value};
    }
    /// The first value of the edge for which `accept(value)`; none when there is none.
    template <class Accept>
    std::uint32_t find(std::uint32_t from, std::uint32_t to, const Accept& accept) const {
        for (std::size_t i = first_slot(from, to); slots_[i].value != none; i = (i + 1) & (slots_.size() - 1))
            if (slots_[i].from == from && slots_[i].to == to && accept(slots_[i].value))
                return slots_[i].value;
        return none;
    }

  private:
    struct Slot {
        std::uint32_t from = 0, to = 0, value = none;
    };
    std::size_t first_slot(std::uint32_t from, std::uint32_t to) const {
        const std::uint64_t key = (std::uint64_t{from} << 32 | to) * 0x9E3779B97F4A7C15ULL;
        return static_cast<std::size_t>(key >> 20) & (slots_.size() - 1);
    }
    std::vector<Slot> slots_;
};

/// What coder and decoder know in common: the border of the region, edge by edge.
class Border {
  public:
    explicit Border(std::size_t triangles) : gates_of_edge_(3 * triangles) { gates_.reserve(3 * triangles); }

    struct Gate {
        std::uint32_t from, to;  ///< the edge as the missing triangle runs along it
        std::uint32_t opposite;  ///< the third corner of the triangle on this side
        bool open;
    };

    /// The oldest open gate; null when there is none.
    const Gate* front() {
        while (next_ < gates_.size() && !gates_[next_].open) ++next_;
        return next_ < gates_.size() ? &gates_[next_] : nullptr;
    }
    void close_front() { close(next_); }

    /// The vertex after the end of the border edge that starts at `vertex`, and the one before it.
    std::uint32_t after(std::uint32_t vertex) const { return vertex < after_.size() ? after_[vertex] : none; }
    std::uint32_t before(std::uint32_t vertex) const {
        return vertex < before_.size() ? before_[vertex] : none;
    }

    /// Closes the gates that the triangle fills and opens one at each of its other edges.
    void add(const mesh::Triangle& t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k], to = t[(k + 1) % 3];
            const std::uint32_t gate =
                gates_of_edge_.find(from, to, [&](std::uint32_t g) { return gates_[g].open; });
            if (gate != none)
                close(gate);
            else
                open({to, from, t[(k + 2) % 3], true});
        }
    }

  private:
    void open(const Gate& gate) {
        const std::uint32_t most = std::max(gate.from, gate.to);
        if (most >= after_.size()) {
            after_.resize(most + 1, none);
            before_.resize(most + 1, none);
        }
        after_[gate.from] = gate.to;
        before_[gate.to] = gate.from;
        gates_of_edge_.insert(gate.from, gate.to, static_cast<std::uint32_t>(gates_.size()));
        gates_.push_back(gate);
    }
    void close(std::size_t index) {
        Gate& gate = gates_[index];
        gate.open = false;
        if (after_[gate.from] == gate.to) after_[gate.from] = none;
        if (before_[gate.to] == gate.from) before_[gate.to] = none;
    }

    std::vector<Gate> gates_;
    std::size_t next_ = 0;
    EdgeTable gates_of_edge_;
    std::vector<std::uint32_t> after_, before_;
};

/// Where a new vertex beyond a gate is expected; coordinates wrap, so any prediction is right to use.
std::array<std::uint32_t, 3> foretell(const exact::Point& from, const exact::Point& to,
                                      const exact::Point& opposite) {
    std::array<std::uint32_t, 3> point{};
    for (int axis = 0; axis < 3; ++axis)
        point[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(from[axis]) +
                                                static_cast<std::uint32_t>(to[axis]) -
                                                static_cast<std::uint32_t>(opposite[axis]);
    return point;
}

/// Bits of a vertex number below `count`.
int number_bits(std::size_t count) { return std::bit_width(count > 0 ? count - 1 : 0); }

class Encoder {
  public:
    Encoder(std::span<const exact::Point> points, std::span<const mesh::Triangle> triangles)
        : points_(points),
          triangles_(triangles),
          border_(triangles.size()),
          by_edge_(3 * triangles.size()),
          coded_(triangles.size(), false),
          number_(points.size(), none) {
        for (std::uint32_t i = 0; i < triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k)
                by_edge_.insert(triangles[i][k], triangles[i][(k + 1) % 3], i);
    }

    CodedGeometry run() {
        for (std::uint32_t start = 0; result_.order.size() < triangles_.size();) {
            if (const Border::Gate* gate = border_.front()) {
                pass(*gate);
                continue;
            }
            while (coded_[start]) ++start;
            begin_region(start);
        }
        result_.bytes = std::move(bits_).take();
        return std::move(result_);
    }

  private:
    void pass(const Border::Gate& gate) {
        const std::uint32_t a = vertices_[gate.from], b = vertices_[gate.to];
        const std::uint32_t next = by_edge_.find(a, b, [&](std::uint32_t i) { return !coded_[i]; });
        bits_.put(next != none, 1);
        if (next == none) {
            border_.close_front();
            return;
        }
        const mesh::Triangle& t = triangles_[next];
        std::size_t k = 0;
        while (t[k] != a || t[(k + 1) % 3] != b) ++k;
        const std::uint32_t third = t[(k + 2) % 3], number = number_[third];
        const std::uint32_t from = gate.from, to = gate.to;
        if (number == none) {
            bits_.put(new_vertex, 2);
            add_vertex(third, foretell(points_[a], points_[b], points_[vertices_[gate.opposite]]));
        } else if (number == border_.after(to)) {
            bits_.put(after_gate, 2);
        } else if (number == border_.before(from)) {
            bits_.put(before_gate, 2);
        } else {
            bits_.put(by_number, 2);
            bits_.put(number, number_bits(vertices_.size()));
        }
        finish(next, {from, to, number_[third]});
    }

    void begin_region(std::uint32_t index) {
        mesh::Triangle t{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t vertex = triangles_[index][k];
            bits_.put(number_[vertex] != none, 1);
            if (number_[vertex] == none)
                add_vertex(vertex, last_point());
            else
                bits_.put(number_[vertex], number_bits(vertices_.size()));
            t[k] = number_[vertex];
        }
        finish(index, t);
    }

    void finish(std::uint32_t index, const mesh::Triangle& t) {
        coded_[index] = true;
        result_.order.push_back(index);
        border_.add(t);
    }

    std::array<std::uint32_t, 3> last_point() const {
        if (vertices_.empty()) return {};
        const exact::Point p = points_[vertices_.back()];
        return {static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                static_cast<std::uint32_t>(p.z)};
    }

    void add_vertex(std::uint32_t vertex, const std::array<std::uint32_t, 3>& expected) {
        number_[vertex] = static_cast<std::uint32_t>(vertices_.size());
        vertices_.push_back(vertex);
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            const std::uint32_t error = zigzag(
                static_cast<std::int32_t>(static_cast<std::uint32_t>(points_[vertex][axis]) - expected[i]));
            bits_.put_rice(error, rice_[i].k());
            rice_[i].saw(error);
        }
    }

    std::span<const exact::Point> points_;
    std::span<const mesh::Triangle> triangles_;
    Border border_;
    EdgeTable by_edge_;
    std::vector<bool> coded_;
    std::vector<std::uint32_t> number_;    ///< of a vertex of the input
    std::vector<std::uint32_t> vertices_;  ///< the vertex of the input with that number
    std::array<RiceState, 3> rice_;
    BitWriter bits_;
    CodedGeometry result_;
};

class Decoder {
  public:
    Decoder(std::span<const std::uint8_t> bytes, std::size_t triangles)
        : bits_(bytes), count_(triangles), border_(triangles) {
        result_.triangles.reserve(triangles);
        result_.points.reserve(triangles / 2 + 16);
    }

    Result<DecodedGeometry> run() {
        while (result_.triangles.size() < count_ && !bits_.overrun() && sound_) {
            if (const Border::Gate* gate = border_.front())
                pass(*gate);
            else
                begin_region();
        }
        if (!sound_ || !bits_.finished())
            return Error{ErrorCode::bad_input, "a chunk of triangles is damaged", {}};
        return std::move(result_);
    }

  private:
    void pass(const Border::Gate& gate) {
        if (bits_.get(1) == 0) {
            border_.close_front();
            return;
        }
        const std::uint32_t from = gate.from, to = gate.to, opposite = gate.opposite;
        std::uint32_t third = none;
        switch (bits_.get(2)) {
            case new_vertex:
                third =
                    add_vertex(foretell(result_.points[from], result_.points[to], result_.points[opposite]));
                break;
            case after_gate:
                third = border_.after(to);
                break;
            case before_gate:
                third = border_.before(from);
                break;
            default:
                third = numbered_vertex();
                break;
        }
        add_triangle({from, to, third});
    }

    void begin_region() {
        mesh::Triangle t{};
        for (std::uint32_t& corner : t) {
            std::array<std::uint32_t, 3> last{};
            if (!result_.points.empty()) {
                const exact::Point p = result_.points.back();
                last = {static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y),
                        static_cast<std::uint32_t>(p.z)};
            }
            corner = bits_.get(1) == 1 ? numbered_vertex() : add_vertex(last);
        }
        add_triangle(t);
    }

    std::uint32_t numbered_vertex() { return bits_.get(number_bits(result_.points.size())); }

    void add_triangle(const mesh::Triangle& t) {
        for (const std::uint32_t corner : t)
            if (corner >= result_.points.size()) {
                sound_ = false;
                return;
            }
        result_.triangles.push_back(t);
        border_.add(t);
    }

    std::uint32_t add_vertex(const std::array<std::uint32_t, 3>& expected) {
        std::array<std::int32_t, 3> x{};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t error = bits_.get_rice(rice_[i].k());
            rice_[i].saw(error);
            const std::uint32_t value = expected[i] + static_cast<std::uint32_t>(unzigzag(error));
            if (value >= static_cast<std::uint32_t>(exact::universe_side)) sound_ = false;
            x[i] = sound_ ? static_cast<std::int32_t>(value) : 0;
        }
        result_.points.push_back({x[0], x[1], x[2]});
        return static_cast<std::uint32_t>(result_.points.size() - 1);
    }

    BitReader bits_;
    std::size_t count_;
    Border border_;
    std::array<RiceState, 3> rice_;
    bool sound_ = true;
    DecodedGeometry result_;
};

}  // namespace

CodedGeometry encode_geometry(std::span<const exact::Point> points,
                              std::span<const mesh::Triangle> triangles) {
    return Encoder(points, triangles).run();
}

Result<DecodedGeometry> decode_geometry(std::span<const std::uint8_t> bytes, std::size_t triangles) {
    // A triangle takes three bits at least, and tables are made for all of them: a count may not outgrow its bytes.
    if (3 * triangles > 8 * bytes.size())
        return Error{ErrorCode::bad_input, "a chunk claims more triangles than it has bits", {}};
    return Decoder(bytes, triangles).run();
}

}  // namespace octavo::bp_octree
