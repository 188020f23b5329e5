// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/exact/counters.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

#include "../peers/peak_memory.hpp"

// One set operation on mesh files, timed from arrays in memory to an indexed mesh in memory, as a line of JSON.
//   octavo_boolean_scene [--repeat N] [--threads N] [--simplify none] [--output FILE]
//                        union|intersection|difference|xor FILE...
// User CPU and wall seconds are the least of the repetitions; phases are wall seconds of the last one.

namespace {

double user_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double volume_of(const octavo::mesh::Mesh& mesh) {
    double volume = 0;
    for (const auto& t : mesh.triangles)
        volume += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    return volume;
}

}  // namespace

int main(int argc, char** argv) {
    int repeat = 5, at = 1;
    const char* output = nullptr;
    octavo::Context context;
    context.threads = 1;
    octavo::boolean::Options options;
    for (; at + 1 < argc && std::strncmp(argv[at], "--", 2) == 0; at += 2) {
        if (std::strcmp(argv[at], "--repeat") == 0) repeat = std::max(1, std::atoi(argv[at + 1]));
        if (std::strcmp(argv[at], "--threads") == 0) context.threads = std::atoi(argv[at + 1]);
        if (std::strcmp(argv[at], "--output") == 0) output = argv[at + 1];
        if (std::strcmp(argv[at], "--simplify") == 0 && std::strcmp(argv[at + 1], "none") == 0)
            options.simplify = octavo::boolean::Simplify::none;
    }
    if (at + 1 >= argc) {
        std::fprintf(stderr,
                     "usage: %s [--repeat N] [--threads N] union|intersection|difference|xor FILE...\n",
                     argv[0]);
        return 2;
    }
    const std::string operation = argv[at++];
    std::vector<octavo::mesh::Mesh> operands;
    for (; at < argc; ++at) {
        octavo::Result<octavo::io::ReadMesh> read = octavo::io::read_mesh(argv[at]);
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().describe().c_str());
            return 3;
        }
        operands.push_back(std::move(read->mesh));
    }
    const octavo::bench::PeakMemory memory;
    double seconds = 1e300, wall = 1e300, peak = 0;
    octavo::boolean::Report report;
    octavo::exact::PredicateCounts decided;
    std::size_t triangles = 0, vertices = 0;
    double volume = 0;
    for (int run = 0; run < repeat; ++run) {
        const double start = user_seconds(), wall_start = wall_seconds();
        const octavo::exact::PredicateCounts counts = octavo::exact::predicate_counts();
        const auto result =
            operation == "union"          ? octavo::boolean::unite(operands, options, context)
            : operation == "intersection" ? octavo::boolean::intersect(operands, options, context)
            : operation == "difference"   ? octavo::boolean::subtract(operands, options, context)
                                          : octavo::boolean::symmetric_difference(operands, options, context);
        seconds = std::min(seconds, user_seconds() - start);
        wall = std::min(wall, wall_seconds() - wall_start);
        if (run == 0) peak = memory.megabytes();
        decided = octavo::exact::predicate_counts() - counts;
        if (!result) {
            std::printf("{\"error\": \"%s\"}\n", result.error().describe().c_str());
            return 1;
        }
        report = result->report;
        triangles = result->mesh.triangles.size();
        vertices = result->mesh.vertices.size();
        volume = volume_of(result->mesh);
        if (output && run + 1 == repeat && !octavo::io::write_mesh(output, result->mesh)) return 3;
    }
    std::printf(
        "{\"cpu\": %.6f, \"wall\": %.6f, \"triangles\": %zu, \"vertices\": %zu, \"volume\": %.15g, "
        "\"input\": %zu, "
        "\"peak_mb\": %.1f, \"pairs\": %zu, \"cut\": %zu, \"pieces\": %zu, "
        "\"patches\": %zu, \"components\": %zu, \"exact\": %llu, \"decisions\": %llu, \"inverted\": %zu, "
        "\"phases\": {",
        seconds, wall, triangles, vertices, volume, report.input_triangles, peak, report.pairs_tested,
        report.cut_facets, report.pieces, report.patches, report.components,
        static_cast<unsigned long long>(decided.exact()),
        static_cast<unsigned long long>(decided.exact() + decided.filtered()), report.inverted_facets);
    for (std::size_t i = 0; i < report.phases.size(); ++i)
        std::printf("%s\"%s\": %.4f", i ? ", " : "", report.phases[i].name, report.phases[i].seconds);
    std::printf("}}\n");
    return 0;
}
