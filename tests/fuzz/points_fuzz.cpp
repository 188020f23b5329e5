// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstdint>

#include <octavo/base/check.hpp>
#include <octavo/io/columns.hpp>
#include <octavo/io/points.hpp>

// Any bytes are refused with a sentence or give points, which survive being written as columns and read again.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace octavo;
    const auto bits = [](double value) { return value == value ? std::bit_cast<std::uint64_t>(value) : 0; };
    const octavo::Bytes bytes = octavo::bytes_of({reinterpret_cast<const char*>(data), size});
    const Result<io::ReadPoints> first = io::read_points(bytes);
    if (!first) {
        OCTAVO_CHECK(!first.error().sentence.empty(), "an error has a sentence");
        return 0;
    }
    std::vector<double> columns[3];
    for (const Vec3& point : first->points)
        for (int axis = 0; axis < 3; ++axis) columns[axis].push_back(point[axis]);
    const io::Column named[] = {{"x", columns[0]}, {"y", columns[1]}, {"z", columns[2]}};
    for (const char* format : {"csv", "ply"}) {
        const Result<io::WrittenBytes> written = io::write_columns(named, {.format = format});
        OCTAVO_CHECK(written.has_value(), "points can be written");
        const Result<io::ReadPoints> second = io::read_points(written->bytes, {.format = format});
        OCTAVO_CHECK(second.has_value(), "written points can be read");
        OCTAVO_CHECK(second->points.size() == first->points.size(), "no point is lost");
        for (std::size_t i = 0; i < first->points.size(); ++i)
            for (int axis = 0; axis < 3; ++axis)
                OCTAVO_CHECK(bits(second->points[i][axis]) == bits(first->points[i][axis]),
                             "coordinates survive");
    }
    return 0;
}
