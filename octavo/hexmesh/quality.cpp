// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <octavo/hexmesh/quality.hpp>

namespace octavo::hexmesh {
namespace {

double determinant(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

/// The determinant of a cell's trilinear map in Bernstein form, index i + 3 j + 9 k.
struct JacobianOfCell {
    std::array<double, 27> coefficients{};
    double longest_edge = 0, shortest_edge = 0;
};

JacobianOfCell jacobian_of(const CellCorners& p) {
    // Derivatives along x at (y, z) ∈ {0, 1}², and so on: index = first + 2 * second of the other two axes.
    std::array<Vec3, 4> dx, dy, dz;
    double longest = 0, shortest = std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 4; ++i) {
        const unsigned low = i & 1, high = i >> 1;
        dx[i] = p[1 | low << 1 | high << 2] - p[low << 1 | high << 2];  // y, z
        dy[i] = p[low | 2 | high << 2] - p[low | high << 2];            // x, z
        dz[i] = p[low | high << 1 | 4] - p[low | high << 1];            // x, y
        for (const Vec3& edge : {dx[i], dy[i], dz[i]}) {
            longest = std::max(longest, dot(edge, edge));
            shortest = std::min(shortest, dot(edge, edge));
        }
    }
    JacobianOfCell jacobian{{}, std::sqrt(longest), std::sqrt(shortest)};
    // Products of linear Bernstein polynomials along each axis: indices add, weights are 1, ½ + ½, 1.
    for (unsigned a = 0; a < 4; ++a)
        for (unsigned b = 0; b < 4; ++b)
            for (unsigned c = 0; c < 4; ++c) {
                const unsigned i = (b & 1) + (c & 1), j = (a & 1) + (c >> 1), k = (a >> 1) + (b >> 1);
                const double weight = (i == 1 ? 0.5 : 1) * (j == 1 ? 0.5 : 1) * (k == 1 ? 0.5 : 1);
                jacobian.coefficients[i + 3 * j + 9 * k] += weight * determinant(dx[a], dy[b], dz[c]);
            }
    return jacobian;
}

bool is_positive(const JacobianOfCell& jacobian) {
    const double margin = 1e-9 * jacobian.longest_edge * jacobian.longest_edge * jacobian.longest_edge;
    return margin > 0 && std::all_of(jacobian.coefficients.begin(), jacobian.coefficients.end(),
                                     [&](double value) { return value > margin; });
}

/// Each Bernstein polynomial of degree 2 has the integral 1/3.
double volume_under(const JacobianOfCell& jacobian) {
    return std::accumulate(jacobian.coefficients.begin(), jacobian.coefficients.end(), 0.0) / 27;
}

}  // namespace

double scaled_jacobian(const CellCorners& p) {
    double least = 1;
    for (unsigned corner = 0; corner < 8; ++corner) {
        // Edges in the direction of growing coordinates, so that the determinant has one sign at all corners.
        std::array<Vec3, 3> edge;
        for (unsigned axis = 0; axis < 3; ++axis)
            edge[axis] = p[corner | 1U << axis] - p[corner & ~(1U << axis)];
        const double lengths = length(edge[0]) * length(edge[1]) * length(edge[2]);
        least = std::min(least, lengths > 0 ? determinant(edge[0], edge[1], edge[2]) / lengths : 0.0);
    }
    return least;
}

bool is_positive_everywhere(const CellCorners& corners) { return is_positive(jacobian_of(corners)); }

double volume_of(const CellCorners& corners) { return volume_under(jacobian_of(corners)); }

Status check_size(const Box3& bounds) {
    constexpr double least = 1e-90, most = 1e90;
    const Vec3 extents = bounds.extents();
    const double longest = std::max({extents.x, extents.y, extents.z});
    if (longest >= least && longest <= most) return Done{};
    return Error{ErrorCode::limit,
                 "cells that fit the surface or each other are proved valid in double numbers, for models of "
                 "1e-90 to 1e90; scale it",
                 {}};
}

CellCorners corners_of(const mesh::HexMesh& mesh, mesh::CellIndex cell) {
    CellCorners corners;
    for (std::size_t i = 0; i < 8; ++i) corners[i] = mesh.position(mesh.corners[cell][i]);
    return corners;
}

std::vector<double> scaled_jacobians(const mesh::HexMesh& mesh) {
    std::vector<double> values;
    values.reserve(mesh.cell_count());
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        values.push_back(scaled_jacobian(corners_of(mesh, cell)));
    return values;
}

Quality measure_quality(const mesh::HexMesh& mesh) {
    Quality quality;
    double sum = 0, shortest = std::numeric_limits<double>::infinity();
    for (mesh::CellIndex cell = 0; cell < mesh.cell_count(); ++cell) {
        const CellCorners corners = corners_of(mesh, cell);
        const double value = scaled_jacobian(corners);
        quality.least = std::min(quality.least, value);
        sum += value;
        ++quality.histogram[static_cast<std::size_t>(std::clamp(std::floor(value * 10), 0.0, 9.0))];
        const JacobianOfCell jacobian = jacobian_of(corners);
        quality.not_proved_positive += !is_positive(jacobian);
        quality.volume += volume_under(jacobian);
        shortest = std::min(shortest, jacobian.shortest_edge);
        quality.largest_edge_ratio =
            std::max(quality.largest_edge_ratio, jacobian.longest_edge / jacobian.shortest_edge);
    }
    if (mesh.cell_count() > 0) quality.shortest_edge = shortest;
    if (mesh.cell_count() > 0) quality.mean = sum / static_cast<double>(mesh.cell_count());
    return quality;
}

}  // namespace octavo::hexmesh
