// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

#ifdef __AVX__
#include <immintrin.h>
#endif

// Eight numbers that are computed with at once. GCC and Clang make AVX of it, or pairs of SSE or WebAssembly vectors;
// where they do not find the one instruction that does it, it is named.

namespace octavo::query {

using Float8 = float __attribute__((vector_size(32)));
using Int8 = std::int32_t __attribute__((vector_size(32)));
using Short8 = std::int16_t __attribute__((vector_size(16)));

inline Float8 all(float x) { return Float8{x, x, x, x, x, x, x, x}; }
inline Float8 greater(Float8 a, Float8 b) { return a > b ? a : b; }
inline Float8 smaller(Float8 a, Float8 b) { return a < b ? a : b; }
inline Float8 floats(Short8 x) {
#ifdef __AVX2__
    // GCC converts four at a time.
    return _mm256_cvtepi32_ps(_mm256_cvtepi16_epi32(reinterpret_cast<__m128i>(x)));
#else
    return __builtin_convertvector(x, Float8);
#endif
}
inline Float8 floats(Int8 x) { return __builtin_convertvector(x, Float8); }
inline Float8 magnitude(Float8 x) { return greater(x, -x); }

inline Float8 root(Float8 x) {
#ifdef __AVX__
    // GCC keeps eight scalar roots, because each might have to set errno.
    return _mm256_sqrt_ps(x);
#else
    Float8 result;
    for (int i = 0; i < 8; ++i) result[i] = std::sqrt(x[i]);
    return result;
#endif
}

/// Bit i is set where flag i is.
inline unsigned bits_of(Int8 flags) {
#ifdef __AVX__
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(flags)));
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; ++i) bits |= flags[i] ? 1U << i : 0U;
    return bits;
#endif
}

inline float least(Float8 x) {
    const Float8 four = smaller(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
    const Float8 two = smaller(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
    return two[0] < two[1] ? two[0] : two[1];
}

inline std::int32_t least(Int8 x) {
    const auto smaller_of = [](Int8 a, Int8 b) { return a < b ? a : b; };
    const Int8 four = smaller_of(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
    const Int8 two = smaller_of(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
    const Int8 one = smaller_of(two, __builtin_shufflevector(two, two, 1, 0, 3, 2, 5, 4, 7, 6));
    return one[0];
}

struct Float8x3 {
    Float8 x, y, z;
};
inline Float8x3 operator-(const Float8x3& a, const Float8x3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Float8x3 operator*(Float8 s, const Float8x3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline Float8 dot(const Float8x3& a, const Float8x3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float8x3 cross(const Float8x3& a, const Float8x3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace octavo::query
