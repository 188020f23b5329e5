// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include <embree3/rtcore.h>

#include "query_peer.hpp"

// Embree 3, robust scenes of medium quality: inside by the first hit of a ray and which side of the facet it meets
// (its fastest way that is right on clean solids), and the distance by rtcPointQuery with a callback, as its tutorial
// does it.

namespace octavo::bench {
namespace {

struct Scene {
    RTCDevice device = rtcNewDevice("threads=1");
    RTCScene scene = rtcNewScene(device);
    explicit Scene(const QueryJob& job) {
        rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        float* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, job.vertices.size()));
        for (const auto& v : job.vertices)
            for (const float x : v) *vertices++ = x;
        std::uint32_t* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, job.triangles.size()));
        for (const auto& t : job.triangles)
            for (const std::uint32_t i : t) *indices++ = i;
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene);
    }
    ~Scene() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

struct Vector {
    double x, y, z;
    double dot(Vector b) const { return x * b.x + y * b.y + z * b.z; }
    Vector operator-(Vector b) const { return {x - b.x, y - b.y, z - b.z}; }
    Vector operator+(Vector b) const { return {x + b.x, y + b.y, z + b.z}; }
    Vector operator*(double s) const { return {x * s, y * s, z * s}; }
};

/// C. Ericson, Real-Time Collision Detection, 5.1.5.
Vector closest_point(Vector p, Vector a, Vector b, Vector c) {
    const Vector ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0 && d2 <= 0) return a;
    const Vector bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    const Vector cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double scale = 1 / (va + vb + vc);
    return a + ab * (vb * scale) + ac * (vc * scale);
}

bool visit(RTCPointQueryFunctionArguments* arguments) {
    const QueryJob& job = *static_cast<const QueryJob*>(arguments->userPtr);
    const auto& t = job.triangles[arguments->primID];
    const auto corner = [&](std::size_t k) {
        const auto& v = job.vertices[t[k]];
        return Vector{v[0], v[1], v[2]};
    };
    const Vector p{arguments->query->x, arguments->query->y, arguments->query->z};
    const Vector away = closest_point(p, corner(0), corner(1), corner(2)) - p;
    const float distance = static_cast<float>(std::sqrt(away.dot(away)));
    if (distance >= arguments->query->radius) return false;
    arguments->query->radius = distance;
    return true;
}

}  // namespace

std::vector<QueryAnswer> run_embree(const QueryJob& job, bool only_inside) {
    const Stopwatch watch;
    const Scene scene(job);
    const Usage build = watch.stop();
    QueryAnswer inside{"Embree first hit", build, 0, std::vector<std::int8_t>(job.points.size()), {}};
    inside.nanoseconds = time_a_point(job.runs, job.points.size(), [&] {
        for (std::size_t i = 0; i < job.points.size(); ++i) {
            RTCIntersectContext context;
            rtcInitIntersectContext(&context);
            RTCRayHit ray{};
            ray.ray.org_x = job.points[i][0], ray.ray.org_y = job.points[i][1],
            ray.ray.org_z = job.points[i][2];
            ray.ray.dir_x = 0.577F, ray.ray.dir_y = 0.590F, ray.ray.dir_z = 0.570F;
            ray.ray.tfar = std::numeric_limits<float>::infinity();
            ray.ray.mask = ~0U;
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene.scene, &context, &ray);
            const bool leaves =
                ray.hit.geomID != RTC_INVALID_GEOMETRY_ID &&
                ray.hit.Ng_x * ray.ray.dir_x + ray.hit.Ng_y * ray.ray.dir_y + ray.hit.Ng_z * ray.ray.dir_z >
                    0;
            inside.inside[i] = leaves ? -1 : 1;
        }
    });
    if (only_inside) return {inside};
    QueryAnswer distance{"Embree point query", build, 0, {}, std::vector<double>(job.points.size())};
    distance.nanoseconds = time_a_point(job.runs, job.points.size(), [&] {
        for (std::size_t i = 0; i < job.points.size(); ++i) {
            RTCPointQueryContext context;
            rtcInitPointQueryContext(&context);
            RTCPointQuery query{job.points[i][0], job.points[i][1], job.points[i][2], 0,
                                std::numeric_limits<float>::infinity()};
            rtcPointQuery(scene.scene, &query, &context, visit, const_cast<QueryJob*>(&job));
            distance.distance[i] = query.radius;
        }
    });
    return {inside, distance};
}

}  // namespace octavo::bench
