// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <cstdint>
#include <cstring>

#include <octavo/boolean/facet_filter.hpp>

// Lanes of SIMD registers, for use inside a source file only: vector types have no stable ABI.
//
// Doubles come half a block at a time: g++ keeps vectors of 32 bytes in registers, but not those of 64.

namespace octavo::boolean {

inline constexpr int half_block = FacetBlock::width / 2;
using Reals = double __attribute__((vector_size(8 * half_block)));
using Flags = std::int64_t __attribute__((vector_size(8 * half_block)));  // all ones or zero a lane
using Words = std::int32_t __attribute__((vector_size(4 * half_block)));
using BlockWords = std::int32_t __attribute__((vector_size(4 * FacetBlock::width)));

inline Reals load_reals(const std::int32_t* from) {
    Words words;
    std::memcpy(&words, from, sizeof words);
    return __builtin_convertvector(words, Reals);
}
template <class Word>
BlockWords load_block(const Word* from) {
    BlockWords words;
    static_assert(sizeof words == FacetBlock::width * sizeof(Word));
    std::memcpy(&words, from, sizeof words);
    return words;
}

/// Bit k: lane k of a comparison is set. A template, since comparing doubles gives lanes of long with g++, of long
/// long with clang.
template <class Lanes>
unsigned bits(Lanes flags) {
    constexpr int width = sizeof flags / sizeof flags[0];
    static_assert(sizeof flags == 32 && (width == half_block || width == FacetBlock::width));
#if defined(__AVX2__)
    if constexpr (width == half_block)
        return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(flags)));
    else
        return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(flags)));
#else
    unsigned all = 0;
    for (int lane = 0; lane < width; ++lane) all |= static_cast<unsigned>(flags[lane] & 1) << lane;
    return all;
#endif
}

}  // namespace octavo::boolean
