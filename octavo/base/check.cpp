// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>

#include <octavo/base/check.hpp>

namespace octavo {
namespace {

void print(const char* file, int line, const char* condition, const char* sentence) {
    std::fprintf(stderr, "octavo: %s:%d: %s [%s]\n", file, line, sentence, condition);
}

CheckHandler current_handler = print;

}  // namespace

CheckHandler set_check_handler(CheckHandler handler) {
    const CheckHandler before = current_handler;
    current_handler = handler ? handler : print;
    return before;
}

void check_failed(const char* file, int line, const char* condition, const char* sentence) {
    current_handler(file, line, condition, sentence);
    std::abort();
}

}  // namespace octavo
