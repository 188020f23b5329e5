// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#ifdef __SSE2__
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

/// a b + c, of one rounding where the machine has that. Single precision only ever excludes, by bounds that hold for
/// fewer roundings as well.
inline Floats multiply_add(Floats a, Floats b, Floats c) {
#ifdef __FMA__
    return _mm256_fmadd_ps(a, b, c);
#else
    return a * b + c;
#endif
}
inline Floats multiply_add(Floats a, float b, Floats c) { return multiply_add(a, Floats{} + b, c); }

/// The sign bits of 32 numbers: bit n is that of lane n % 4 of quarter n / 4, where the quarters are the lower halves
/// of the four registers and then the upper ones. Of flags they are the flags.
inline std::uint32_t signs(Floats a, Floats b, Floats c, Floats d) {
#ifdef __AVX2__
    const auto integers = [](Floats v) { return std::bit_cast<__m256i>(v); };
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_packs_epi16(
        _mm256_packs_epi32(integers(a), integers(b)), _mm256_packs_epi32(integers(c), integers(d)))));
#else
    const auto of_quarters = [](Floats v, int quarter) {
#ifdef __SSE2__
        const auto signs_of = [](__m128 half) { return static_cast<std::uint32_t>(_mm_movemask_ps(half)); };
        return signs_of(__builtin_shufflevector(v, v, 0, 1, 2, 3)) << (4 * quarter) |
               signs_of(__builtin_shufflevector(v, v, 4, 5, 6, 7)) << (4 * quarter + 16);
#else
        const auto flags = std::bit_cast<Flags>(v) < 0;
        std::uint32_t bits = 0;
        for (int lane = 0; lane < 8; ++lane)
            bits |= (static_cast<std::uint32_t>(flags[lane]) & 1) << (4 * quarter + lane % 4 + lane / 4 * 16);
        return bits;
#endif
    };
    return of_quarters(a, 0) | of_quarters(b, 1) | of_quarters(c, 2) | of_quarters(d, 3);
#endif
}

}  // namespace octavo::csg

#pragma GCC diagnostic pop
