// SPDX-License-Identifier: Apache-2.0
#include "boundary_round_trip.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    octavo::fuzz::read_write_read_boundary(data, size, "smesh");
    return 0;
}
