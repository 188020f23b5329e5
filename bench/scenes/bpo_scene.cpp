// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

#include <octavo/bp_octree/bpo_file.hpp>
#include <octavo/bp_octree/bpo_view.hpp>
#include <octavo/query/stored_inside.hpp>

#include "../peers/peer_clock.hpp"

// A .bpo file where it lies: the time to open it and to answer one question at its surface, read and mapped, and the
// bytes that questions, levels and views need of it.
//   octavo_bpo_scene FILE.bpo [POINTS=200]

namespace octavo::bench {
namespace {

using Open = Result<std::unique_ptr<io::ByteSource>> (*)(const std::string&);

struct First {
    std::vector<double> milliseconds;  ///< CPU time, ascending
    double bytes = 0;                  ///< read a question, on average
};

/// Opens the file anew for each point.
First first_answers(const std::string& path, Open open, const std::vector<Vec3>& points) {
    First first;
    for (const Vec3& point : points) {
        const double start = cpu_seconds();
        auto stored = query::StoredInside::open(std::move(*open(path)));
        if (!stored || !(*stored)(point)) {
            std::fprintf(stderr, "%s cannot be asked\n", path.c_str());
            std::exit(1);
        }
        first.milliseconds.push_back(1000 * (cpu_seconds() - start));
        first.bytes += static_cast<double>(stored->bytes_read()) / static_cast<double>(points.size());
    }
    std::sort(first.milliseconds.begin(), first.milliseconds.end());
    return first;
}

void tell(const char* how, const First& first) {
    std::printf("%s,%.3f,%.3f,%.3f,%.0f\n", how, first.milliseconds.front(),
                first.milliseconds[first.milliseconds.size() / 2], first.milliseconds.back(), first.bytes);
}

/// Cells at most a tenth of their distance from the eye wide.
std::uint64_t bytes_of_view(const std::string& path, Vec3 eye) {
    auto reader = bp_octree::open_bpo(path);
    const auto view = bp_octree::read_view(*reader, [&](const octree::Cell&, const Box3& box) {
        Vec3 away;
        for (int axis = 0; axis < 3; ++axis)
            away[axis] = std::max({box.low[axis] - eye[axis], eye[axis] - box.high[axis], 0.0});
        return length(box.extents()) > 0.1 * length(away);
    });
    return view ? reader->bytes_read() : 0;
}

int measure(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: %s FILE.bpo [POINTS=200]\n", argv[0]);
        return 2;
    }
    const std::string path = argv[1];
    const auto file = bp_octree::read_bpo(path);
    if (!file) {
        std::fprintf(stderr, "%s\n", file.error().describe().c_str());
        return 1;
    }
    const mesh::LatticeMesh& mesh = file->tree.mesh;
    std::mt19937_64 random(3);
    std::vector<Vec3> points;
    for (int i = 0; i < (argc > 2 ? std::atoi(argv[2]) : 200); ++i)
        points.push_back(mesh.lattice.to_world(mesh.points[random() % mesh.points.size()]));
    std::printf("# %s: %llu bytes, %zu triangles\n", path.c_str(),
                static_cast<unsigned long long>(file->bytes), mesh.triangles.size());
    std::printf("source,least_ms,median_ms,most_ms,bytes_a_question\n");
    tell("read", first_answers(path, io::open_file, points));
    tell("mapped", first_answers(path, io::map_file, points));
    for (int level = 0; level <= file->tree.deepest(); ++level) {
        const auto part = bp_octree::read_bpo(path, {.levels = level});
        std::printf("# level %d: %llu bytes read\n", level,
                    static_cast<unsigned long long>(part->bytes_read));
    }
    std::printf("# a view from the surface: %llu bytes read\n",
                static_cast<unsigned long long>(bytes_of_view(path, points[0])));
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int argc, char** argv) { return octavo::bench::measure(argc, argv); }
