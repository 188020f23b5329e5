// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/mill.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>

#include "../peers/peer_clock.hpp"

// Milling: an icosphere of 500 triangles subtracted along a spiral on a rough sphere, one pose after the other.
//   octavo_mill_scene FREQUENCY RADIUS STEPS [FOLDER] [check]
// The workpiece has 20 FREQUENCY² triangles: 71, 132 and 265 make 101 K, 348 K and 1.4 M. FOLDER gets work.off,
// tool.off and poses.csv, for peers to do the same. `check` subtracts all tools at once by boolean/, and compares.

namespace octavo::bench {
namespace {

/// Points of the surface, from pole to pole, `steps` of them at even distances along a spiral of 12 rounds.
std::vector<Vec3> spiral_on(const mesh::Mesh& work, int steps) {
    constexpr double pi = 3.141592653589793, rounds = 12;
    std::vector<Vec3> path;
    for (int i = 0; i < steps; ++i) {
        const double height = 1 - 2 * (i + 0.5) / steps, radius = std::sqrt(1 - height * height);
        const double angle = 2 * pi * rounds * (i + 0.5) / steps;
        const Vec3 direction{radius * std::cos(angle), radius * std::sin(angle), height};
        Vec3 nearest;
        double best = -2;
        for (const Vec3& vertex : work.vertices) {
            const double cosine = dot(vertex, direction) / length(vertex);
            if (cosine > best) best = cosine, nearest = vertex;
        }
        path.push_back(nearest);
    }
    return path;
}

double quantile(std::vector<double> values, double part) {
    std::sort(values.begin(), values.end());
    return values.empty()
               ? 0
               : values[std::min(values.size() - 1,
                                 static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}

bool write_files(const std::string& folder, const mesh::Mesh& work, const mesh::Mesh& tool,
                 const std::vector<Vec3>& path) {
    bool fine = io::write_mesh(folder + "/work.off", work).has_value() &&
                io::write_mesh(folder + "/tool.off", tool).has_value();
    if (std::FILE* file = std::fopen((folder + "/poses.csv").c_str(), "w")) {
        for (const Vec3& p : path) std::fprintf(file, "%.17g,%.17g,%.17g\n", p.x, p.y, p.z);
        fine = std::fclose(file) == 0 && fine;
    } else {
        fine = false;
    }
    return fine;
}

/// The volume of the workpiece without all tools, by one n-ary Boolean; negative when there is none.
double volume_at_once(const mesh::Mesh& work, const mesh::Mesh& tool, const std::vector<Vec3>& path) {
    std::vector<mesh::Mesh> operands{work};
    for (const Vec3& p : path) operands.push_back(mesh::transform(tool, mesh::translation(p)));
    const auto evaluated = boolean::subtract(operands);
    return evaluated ? mesh::moments(evaluated->mesh).volume : -1;
}

int measure(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: %s FREQUENCY RADIUS STEPS [FOLDER] [check]\n", argv[0]);
        return 2;
    }
    const mesh::Mesh work = mesh::displaced_sphere(static_cast<std::uint32_t>(std::atoi(argv[1])));
    const double radius = std::atof(argv[2]);
    const mesh::Mesh tool = mesh::icosphere(radius, 5);
    const std::vector<Vec3> path = spiral_on(work, std::atoi(argv[3]));
    bool checks = false;
    for (int i = 4; i < argc; ++i) {
        if (std::string(argv[i]) == "check") {
            checks = true;
        } else if (!write_files(argv[i], work, tool, path)) {
            std::fprintf(stderr, "cannot write into %s\n", argv[i]);
            return 1;
        }
    }
    std::vector<Affine> poses;
    for (const Vec3& p : path) poses.push_back(mesh::translation(p));
    const Stopwatch clock;
    const auto milled = bsp_octree::mill(work, tool, poses);
    const Usage usage = clock.stop();
    if (!milled) {
        std::fprintf(stderr, "%s\n", milled.error().describe().c_str());
        return 1;
    }
    const auto made = bsp_octree::to_mesh(milled->solid);
    const double volume = made ? mesh::moments(made->mesh).volume : -1;
    const double expected = checks ? volume_at_once(work, tool, path) : 0;
    const bsp_octree::MillReport& report = milled->report;
    std::printf(
        "engine,work_triangles,tool_triangles,radius,steps,prepare_s,median_ms,p90_ms,slowest_ms,"
        "peak_mb,triangles,volume,volume_at_once\n");
    std::printf("octavo,%zu,%zu,%g,%llu,%.3f,%.3f,%.3f,%.3f,%.0f,%zu,%.12g,", work.triangles.size(),
                tool.triangles.size(), radius, static_cast<unsigned long long>(report.steps),
                report.build_seconds, 1e3 * quantile(report.step_seconds, 0.5),
                1e3 * quantile(report.step_seconds, 0.9), 1e3 * quantile(report.step_seconds, 1),
                usage.megabytes, made ? made->mesh.triangles.size() : 0, volume);
    if (checks) std::printf("%.12g", expected);
    std::printf("\n");
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int argc, char** argv) { return octavo::bench::measure(argc, argv); }
