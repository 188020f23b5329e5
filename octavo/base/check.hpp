// SPDX-License-Identifier: Apache-2.0
#pragma once

// OCTAVO_CHECK(condition, sentence): a caller's bug or a broken invariant of ours; always on. OCTAVO_DCHECK:
// the same in debug builds only, for the textbook oracles that stand beside fast code. Failing calls the
// handler, which by default prints and aborts; a host program may install its own, which must not return.

namespace octavo {

using CheckHandler = void (*)(const char* file, int line, const char* condition, const char* sentence);

/// Installs `handler` and returns the one before. Not thread-safe: call it at start-up.
CheckHandler set_check_handler(CheckHandler handler);

[[noreturn]] void check_failed(const char* file, int line, const char* condition, const char* sentence);

}  // namespace octavo

#define OCTAVO_CHECK(condition, sentence)   \
    (static_cast<bool>(condition) ? void(0) \
                                  : ::octavo::check_failed(__FILE__, __LINE__, #condition, sentence))

#ifdef NDEBUG
#define OCTAVO_DCHECK(condition, sentence) void(0)
#else
#define OCTAVO_DCHECK(condition, sentence) OCTAVO_CHECK(condition, sentence)
#endif
