// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#ifdef __AVX__
#include <immintrin.h>
#endif

// Eight numbers of single precision side by side, and as many flags (all bits or none) or integers.
// For use inside a source file only: vector types have no stable ABI.

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace octavo::csg {

using Floats = float __attribute__((vector_size(32)));
using Flags = std::int32_t __attribute__((vector_size(32)));

/// Without the sign bit: compilers make three instructions of a comparison.
inline Floats absolute(Floats v) { return std::bit_cast<Floats>(std::bit_cast<Flags>(v) & 0x7FFFFFFF); }

/// One instruction, which compilers seldom find in a comparison.
inline Floats larger(Floats a, Floats b) {
#ifdef __AVX__
    return _mm256_max_ps(a, b);
#else
    return a > b ? a : b;
#endif
}
inline Floats smaller(Floats a, Floats b) {
#ifdef __AVX__
    return _mm256_min_ps(a, b);
#else
    return a < b ? a : b;
#endif
}

}  // namespace octavo::csg

#pragma GCC diagnostic pop
