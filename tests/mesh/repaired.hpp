// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <gtest/gtest.h>

#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/validate.hpp>

// Repair and validate where they are expected to succeed, for tests of either.

namespace octavo::mesh {

inline Repaired repaired(const Mesh& mesh) {
    auto result = repair(mesh);
    EXPECT_TRUE(result.has_value()) << result.error().describe();
    return *result;
}

inline Report report_of(const Mesh& mesh) {
    auto report = validate(mesh);
    EXPECT_TRUE(report.has_value()) << report.error().describe();
    return *report;
}

inline Mesh both(const Mesh& a, const Mesh& b) { return join(std::array{a, b}); }

}  // namespace octavo::mesh
