// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include <tbb/global_control.h>

#include <octavo/io/read.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/closest.hpp>
#include <octavo/query/inside.hpp>

#include "../wavy_sphere.hpp"
#include "query_peer.hpp"

// Inside and distance on one thread: Octavo against Embree and CGAL, on the same points in the same process. Prints
// CPU nanoseconds a point, build times and memory as CSV, and how many answers differ from Octavo's.
//
//     octavo_query_peers MODEL|sphere:LEVEL [uniform|near][-sorted] [POINTS=1000000] [RUNS=5] [FOLDER|inside]
//
// FOLDER gets the arrays and Octavo's answers, for query.py, which adds peers from PyPI. `inside` leaves distances out.
//
// Points: uniform in the bounding box, or near the surface (uniform by area, moved along the normal by up to 1 % of
// the diagonal either way). `sphere:8` makes a concave star-shaped solid of 20 · 4^8 = 1.3 million triangles.

namespace octavo::bench {

double time_a_point(int runs, std::size_t points, const std::function<void()>& work) {
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run) {
        const double start = cpu_seconds();
        work();
        seconds.push_back(cpu_seconds() - start);
    }
    std::sort(seconds.begin(), seconds.end());
    return 1e9 * seconds[seconds.size() / 2] / static_cast<double>(points);
}

namespace {

/// The model with float coordinates and diagonal 1.
mesh::Mesh model(const std::string& name) {
    mesh::Mesh mesh;
    if (name.rfind("sphere:", 0) == 0) {
        mesh = wavy_sphere(std::atoi(name.c_str() + 7));
    } else {
        auto read = io::read_mesh(name);
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().describe().c_str());
            std::exit(1);
        }
        mesh = std::move(read->mesh);
    }
    const double scale = 1 / length(mesh.bounds().extents());
    for (Vec3& v : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) v[axis] = static_cast<float>(scale * v[axis]);
    return mesh;
}

std::vector<std::array<float, 3>> points_for(const mesh::Mesh& mesh, bool near, std::size_t count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<std::array<float, 3>> points(count);
    std::vector<double> areas{0};
    const auto normal = [&](const mesh::Triangle& t) {
        return cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    };
    for (const mesh::Triangle& t : mesh.triangles) areas.push_back(areas.back() + length(normal(t)));
    const Box3 box = mesh.bounds();
    for (auto& point : points) {
        Vec3 p;
        if (near) {
            const double at = unit(random) * areas.back();
            const auto found = std::upper_bound(areas.begin() + 1, areas.end() - 1, at) - areas.begin() - 1;
            const mesh::Triangle& t = mesh.triangles[static_cast<std::size_t>(found)];
            double s = unit(random), u = unit(random);
            if (s + u > 1) s = 1 - s, u = 1 - u;
            const Vec3 n = normal(t);
            p = mesh.vertices[t[0]] + s * (mesh.vertices[t[1]] - mesh.vertices[t[0]]) +
                u * (mesh.vertices[t[2]] - mesh.vertices[t[0]]);
            if (length(n) > 0) p = p + (0.02 * (unit(random) - 0.5) / length(n)) * n;
        } else {
            for (int axis = 0; axis < 3; ++axis) p[axis] = box.low[axis] + unit(random) * box.extents()[axis];
        }
        point = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    }
    return points;
}

/// In Morton order, as neighbours in a grid would be asked.
void sort(std::vector<std::array<float, 3>>& points) {
    const auto key = [](const std::array<float, 3>& p) {
        // The model has diagonal 1 about the origin or beside it.
        const auto cell = [](float x) {
            return static_cast<std::uint32_t>(std::clamp(0.25 * (x + 2.0), 0.0, 0.999999) * 0x1p21);
        };
        return octree::interleave(cell(p[0]), cell(p[1]), cell(p[2]));
    };
    std::sort(points.begin(), points.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
}

std::vector<QueryAnswer> run_octavo(const mesh::Mesh& mesh, const QueryJob& job, bool only_inside) {
    std::vector<Vec3> points;
    for (const auto& p : job.points) points.push_back({p[0], p[1], p[2]});
    Context one_thread;
    one_thread.threads = 1;
    std::vector<QueryAnswer> answers;
    {
        const Stopwatch watch;
        auto query = query::InsideQuery::build(mesh, {}, one_thread);
        const Usage build = watch.stop();
        if (!query) {
            std::fprintf(stderr, "%s\n", query.error().describe().c_str());
            std::exit(1);
        }
        QueryAnswer single{"Octavo inside", build, 0, std::vector<std::int8_t>(points.size()), {}};
        single.nanoseconds = time_a_point(job.runs, points.size(), [&] {
            for (std::size_t i = 0; i < points.size(); ++i)
                single.inside[i] = static_cast<std::int8_t>((*query)(points[i]));
        });
        QueryAnswer batch{"Octavo inside, batch", build, 0, {}, {}};
        batch.nanoseconds =
            time_a_point(job.runs, points.size(), [&] { (void)(*query)(points, one_thread); });
        std::printf("# inside: %.1f bytes a triangle\n",
                    static_cast<double>(query->memory_bytes()) / static_cast<double>(mesh.triangles.size()));
        answers.push_back(std::move(single));
        answers.push_back(std::move(batch));
    }
    if (only_inside) return answers;
    for (const auto sign :
         {query::ClosestOptions::Sign::inside_negative, query::ClosestOptions::Sign::none}) {
        const bool is_signed = sign == query::ClosestOptions::Sign::inside_negative;
        const Stopwatch watch;
        query::ClosestOptions options;
        options.sign = sign;
        auto query = query::ClosestQuery::build(mesh, options, one_thread);
        const Usage build = watch.stop();
        QueryAnswer single{is_signed ? "Octavo signed distance" : "Octavo distance",
                           build,
                           0,
                           {},
                           std::vector<double>(points.size())};
        single.nanoseconds = time_a_point(job.runs, points.size(), [&] {
            for (std::size_t i = 0; i < points.size(); ++i)
                single.distance[i] = std::fabs((*query)(points[i]).distance);
        });
        QueryAnswer batch{single.system + ", batch", build, 0, {}, {}};
        batch.nanoseconds =
            time_a_point(job.runs, points.size(), [&] { (void)(*query)(points, one_thread); });
        std::printf("# %s: %.1f bytes a triangle\n", single.system.c_str(),
                    static_cast<double>(query->memory_bytes()) / static_cast<double>(mesh.triangles.size()));
        answers.push_back(std::move(single));
        answers.push_back(std::move(batch));
    }
    return answers;
}

void print(const std::vector<QueryAnswer>& answers) {
    const QueryAnswer *inside = nullptr, *distance = nullptr;
    std::printf("system,build_s,build_mb,ns_per_point,disagreements,largest_difference\n");
    for (const QueryAnswer& answer : answers) {
        if (!inside && !answer.inside.empty()) inside = &answer;
        if (!distance && !answer.distance.empty()) distance = &answer;
        std::size_t different = 0;
        double largest = 0;
        for (std::size_t i = 0; i < answer.inside.size(); ++i)
            different += answer.inside[i] * inside->inside[i] < 0 ||
                         (answer.inside[i] == 0) != (inside->inside[i] == 0);
        for (std::size_t i = 0; i < answer.distance.size(); ++i)
            largest = std::max(largest, std::fabs(answer.distance[i] - distance->distance[i]));
        std::printf("%s,%.3f,%.1f,%.1f,%zu,%.2g\n", answer.system.c_str(), answer.build.seconds,
                    answer.build.megabytes, answer.nanoseconds, different, largest);
    }
}

template <class T>
void dump(const std::string& path, const std::vector<T>& array) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(array.data()),
               static_cast<std::streamsize>(array.size() * sizeof(T)));
}

void dump_job(const std::string& folder, const QueryJob& job, const std::vector<QueryAnswer>& answers) {
    dump(folder + "/vertices.f32", job.vertices);
    dump(folder + "/triangles.u32", job.triangles);
    dump(folder + "/points.f32", job.points);
    for (const QueryAnswer& answer : answers) {
        if (answer.system == "Octavo inside") dump(folder + "/inside.i8", answer.inside);
        if (answer.system == "Octavo signed distance") dump(folder + "/distance.f64", answer.distance);
    }
}

int compare(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr,
                     "usage: %s MODEL|sphere:LEVEL [uniform|near][-sorted] [POINTS] [RUNS] [FOLDER|inside]\n",
                     argv[0]);
        return 2;
    }
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const mesh::Mesh mesh = model(argv[1]);
    QueryJob job;
    for (const Vec3& v : mesh.vertices)
        job.vertices.push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
    job.triangles = mesh.triangles;
    const std::string kind = argc > 2 ? argv[2] : "uniform";
    const bool only_inside = argc > 5 && std::string(argv[5]) == "inside";
    job.points = points_for(mesh, kind.rfind("near", 0) == 0,
                            argc > 3 ? static_cast<std::size_t>(std::atoll(argv[3])) : 1000000);
    if (kind.size() > 7 && kind.substr(kind.size() - 7) == "-sorted") sort(job.points);
    if (argc > 4) job.runs = std::atoi(argv[4]);
    std::printf("# %s, %zu triangles, %zu points %s\n", argv[1], mesh.triangles.size(), job.points.size(),
                kind.c_str());
    std::vector<QueryAnswer> answers = run_octavo(mesh, job, only_inside);
    const auto add = [&](std::vector<QueryAnswer> more) {
        for (QueryAnswer& answer : more) answers.push_back(std::move(answer));
    };
#ifdef OCTAVO_WITH_EMBREE
    add(run_embree(job, only_inside));
#endif
#ifdef OCTAVO_WITH_CGAL
    if (!only_inside) add(run_cgal_queries(job));
#endif
    print(answers);
    if (argc > 5 && !only_inside) dump_job(argv[5], job, answers);
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int argc, char** argv) { return octavo::bench::compare(argc, argv); }
