// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <octavo/csg/expression.hpp>

// Random scenes that fill space: `count` balls, boxes and cylinders in the unit cube, each turned at random and
// about as large as its share of the cube. Sixteen at a time are joined by a random tree of unions, intersections
// and differences (6 : 1 : 3), and those parts are united. The same seed gives the same scene everywhere.

namespace octavo::bench {

class RandomScene {
  public:
    explicit RandomScene(std::uint64_t seed) : engine_(seed) {}

    csg::Expr tree(int count) {
        // Sizes shrink with the count, so that a point lies in about one primitive.
        size_ = 0.55 / std::cbrt(static_cast<double>(count));
        std::vector<csg::Expr> parts;
        for (int i = 0; i < count; ++i) parts.push_back(primitive());
        int in_part = 1;
        while (parts.size() > 1) {
            std::vector<csg::Expr> joined;
            for (std::size_t i = 0; i + 1 < parts.size(); i += 2)
                joined.push_back(in_part < 16 ? join(parts[i], parts[i + 1])
                                              : csg::unite({parts[i], parts[i + 1]}));
            if (parts.size() % 2 == 1) joined.push_back(parts.back());
            parts = std::move(joined);
            in_part *= 2;
        }
        return parts.front();
    }

    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  private:
    csg::Expr join(const csg::Expr& a, const csg::Expr& b) {
        const double pick = uniform();
        if (pick < 0.6) return csg::unite({a, b});
        return pick < 0.7 ? csg::intersect({a, b}) : csg::subtract({a, b});
    }

    csg::Expr primitive() {
        const double pick = uniform();
        const double r = size_ * (0.5 + uniform());
        csg::Expr shape = pick < 1.0 / 3 ? csg::Expr(csg::Ball{r})
                          : pick < 2.0 / 3
                              ? csg::Expr(csg::Cuboid{{-r, -0.7 * r, -0.8 * r}, {r, 0.7 * r, 0.8 * r}})
                              : csg::Expr(csg::Frustum{-r, r, 0.6 * r, 0.6 * r});
        return csg::transform(place(), std::move(shape));
    }

    Affine place() {
        // A random unit quaternion.
        double q[4], norm = 0;
        for (double& c : q) {
            c = uniform() - 0.5;
            norm += c * c;
        }
        norm = std::sqrt(norm);
        const double w = q[0] / norm, x = q[1] / norm, y = q[2] / norm, z = q[3] / norm;
        Affine m;
        m.m = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), uniform()},
                {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), uniform()},
                {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), uniform()}}};
        return m;
    }

    std::mt19937_64 engine_;
    double size_ = 1;
};

}  // namespace octavo::bench
