// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/weld.hpp>

namespace octavo::boolean {
namespace {

struct Record {
    exact::Point point;
    std::uint32_t position;
};

constexpr std::size_t part_size = 8192, most_parts = 256;

/// The records of each part, positions ascending.
struct Parts {
    UninitialisedVector<Record> records;
    std::vector<std::uint32_t> begin;
};

Parts deal_out(const UninitialisedVector<exact::Point>& positions, const Context& context) {
    const std::size_t count = positions.size(),
                      parts = std::min(most_parts, std::bit_ceil(count / part_size + 1)),
                      chunk = std::max<std::size_t>(1 << 12, (count + 15) / 16),
                      chunks = (count + chunk - 1) / chunk;
    const int shift = 64 - std::countr_zero(parts);
    const auto part_of = [&](exact::Point point) { return parts == 1 ? 0 : hash(point) >> shift; };
    std::vector<std::uint32_t> place(chunks * parts, 0);
    parallel_chunks(context, count, chunk, [&](std::size_t first, std::size_t last) {
        std::uint32_t* const counts = place.data() + first / chunk * parts;
        for (std::size_t i = first; i < last; ++i) ++counts[part_of(positions[i])];
    });
    Parts result{UninitialisedVector<Record>(count), {}};
    std::uint32_t sum = 0;
    for (std::size_t part = 0; part < parts; ++part) {
        result.begin.push_back(sum);
        for (std::size_t c = 0; c < chunks; ++c) {
            const std::uint32_t size = place[c * parts + part];
            place[c * parts + part] = sum;
            sum += size;
        }
    }
    result.begin.push_back(sum);
    parallel_chunks(context, count, chunk, [&](std::size_t first, std::size_t last) {
        std::uint32_t* const next = place.data() + first / chunk * parts;
        for (std::size_t i = first; i < last; ++i)
            result.records[next[part_of(positions[i])]++] = {positions[i], static_cast<std::uint32_t>(i)};
    });
    return result;
}

/// Numbers the points in the order of the positions at which they appear first.
Welded number_points(const UninitialisedVector<exact::Point>& positions,
                     const UninitialisedVector<std::uint32_t>& first_of, const Context& context) {
    constexpr std::size_t grain = 1 << 12;
    const std::vector<std::size_t> offset =
        chunk_offsets(context, positions.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::size_t count = 0;
            for (std::size_t i = begin; i < end; ++i) count += first_of[i] == i;
            return count;
        });
    Welded result;
    result.points.resize(offset.back());
    result.point_of.resize(positions.size());
    parallel_chunks(context, positions.size(), grain, [&](std::size_t begin, std::size_t end) {
        auto point = static_cast<std::uint32_t>(offset[begin / grain]);
        for (std::size_t i = begin; i < end; ++i) {
            if (first_of[i] != i) continue;
            result.points[point] = positions[i];
            result.point_of[i] = point++;
        }
    });
    parallel_chunks(context, positions.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (first_of[i] != i) result.point_of[i] = result.point_of[first_of[i]];
    });
    return result;
}

}  // namespace

Welded weld(const UninitialisedVector<exact::Point>& positions, const Context& context) {
    const Parts parts = deal_out(positions, context);
    UninitialisedVector<std::uint32_t> first_of(positions.size());
    parallel_chunks(context, parts.begin.size() - 1, 1, [&](std::size_t part, std::size_t) {
        const std::uint32_t begin = parts.begin[part], end = parts.begin[part + 1];
        constexpr std::uint32_t empty = ~std::uint32_t{0};
        std::vector<std::uint32_t> slots(std::bit_ceil(2 * std::size_t{end - begin} + 1), empty);
        const std::size_t mask = slots.size() - 1;
        for (std::uint32_t i = begin; i < end; ++i) {
            const Record& record = parts.records[i];
            std::size_t slot = hash(record.point) & mask;
            while (slots[slot] != empty && parts.records[slots[slot]].point != record.point)
                slot = (slot + 1) & mask;
            if (slots[slot] == empty) slots[slot] = i;
            first_of[record.position] = parts.records[slots[slot]].position;
        }
    });
    if (context.cancelled()) return {};
    return number_points(positions, first_of, context);
}

}  // namespace octavo::boolean
