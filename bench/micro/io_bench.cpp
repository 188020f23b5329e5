// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <benchmark/benchmark.h>

#include <octavo/io/read.hpp>
#include <octavo/io/stl.hpp>
#include <octavo/io/vertex_welder.hpp>
#include <octavo/io/write.hpp>

// Reading and writing, from memory to memory, in bytes of file a second of one core. The bars: text ≥ 100 MB/s,
// binary ≥ 500 MB/s. The mesh is a bumpy torus of 320 000 facets in row order, coordinates rounded to floats
// (as exporters write them, about 9 digits) or full doubles (17 digits).

namespace {

using namespace octavo;
using namespace octavo::io;

enum class Digits { of_float, of_double };

mesh::Mesh bumpy_torus(Digits digits) {
    constexpr int rows = 400, columns = 400;
    mesh::Mesh mesh;
    const auto rounded = [&](double x) {
        return digits == Digits::of_float ? double{static_cast<float>(x)} : x;
    };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
            const double r = 10 + std::sin(7 * u) * std::cos(5 * v);
            mesh.vertices.push_back({rounded((30 + r * std::cos(v)) * std::cos(u)),
                                     rounded((30 + r * std::cos(v)) * std::sin(u)),
                                     rounded(r * std::sin(v))});
        }
    const auto vertex = [&](int i, int j) {
        return static_cast<mesh::VertexIndex>((i % rows) * columns + j % columns);
    };
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
            mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
        }
    return mesh;
}

/// The facets in an order that has nothing to do with their places.
mesh::Mesh shuffled(mesh::Mesh mesh) {
    std::uint64_t state = 1;
    for (std::size_t i = mesh.triangles.size(); i > 1; --i) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        std::swap(mesh.triangles[i - 1], mesh.triangles[(state >> 33) % i]);
    }
    return mesh;
}

void read(benchmark::State& state, const mesh::Mesh& mesh, const char* format, Encoding encoding) {
    const Result<WrittenBytes> file = write_mesh(mesh, {.format = format, .encoding = encoding});
    for (auto _ : state) {
        Result<ReadMesh> result = read_mesh(file->bytes, {.format = format});
        benchmark::DoNotOptimize(result->mesh.triangles.data());
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * file->bytes.size()));
}

void write(benchmark::State& state, const mesh::Mesh& mesh, const char* format, Encoding encoding) {
    std::size_t size = 0;
    for (auto _ : state) {
        const Result<WrittenBytes> file = write_mesh(mesh, {.format = format, .encoding = encoding});
        size = file->bytes.size();
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * size));
}

/// What reading binary STL would cost without welding: the corners as vertices, three a facet.
void read_binary_stl_unwelded(benchmark::State& state) {
    const Result<WrittenBytes> file = write_mesh(bumpy_torus(Digits::of_float), {.format = "stl"});
    const Bytes bytes = file->bytes;
    for (auto _ : state) {
        const std::size_t facets = load<std::uint32_t>(bytes.data() + 80);
        std::vector<Vec3> corners(3 * facets);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::byte* const from = bytes.data() + 84 + i / 3 * 50 + 12 + i % 3 * 12;
            corners[i] = {load<float>(from), load<float>(from + 4), load<float>(from + 8)};
            if (!is_finite(corners[i])) state.SkipWithError("not finite");
        }
        benchmark::DoNotOptimize(corners.data());
    }
    state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes.size()));
}

const mesh::Mesh floats = bumpy_torus(Digits::of_float);
const mesh::Mesh doubles = bumpy_torus(Digits::of_double);
const mesh::Mesh scattered = shuffled(floats);

BENCHMARK_CAPTURE(read, stl_binary, floats, "stl", Encoding::binary);
BENCHMARK_CAPTURE(read, stl_binary_shuffled, scattered, "stl", Encoding::binary);
BENCHMARK(read_binary_stl_unwelded);
BENCHMARK_CAPTURE(read, stl_text, floats, "stl", Encoding::ascii);
BENCHMARK_CAPTURE(read, stl_text_doubles, doubles, "stl", Encoding::ascii);
BENCHMARK_CAPTURE(read, obj, floats, "obj", Encoding::ascii);
BENCHMARK_CAPTURE(read, obj_doubles, doubles, "obj", Encoding::ascii);
BENCHMARK_CAPTURE(read, off, floats, "off", Encoding::ascii);
BENCHMARK_CAPTURE(read, ply_binary_floats, floats, "ply", Encoding::binary);
BENCHMARK_CAPTURE(read, ply_binary_doubles, doubles, "ply", Encoding::binary);
BENCHMARK_CAPTURE(read, ply_text, floats, "ply", Encoding::ascii);
BENCHMARK_CAPTURE(write, stl_binary, floats, "stl", Encoding::binary);
BENCHMARK_CAPTURE(write, obj_doubles, doubles, "obj", Encoding::ascii);
BENCHMARK_CAPTURE(write, ply_binary_doubles, doubles, "ply", Encoding::binary);

}  // namespace
