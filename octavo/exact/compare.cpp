// SPDX-License-Identifier: Apache-2.0
#include <octavo/exact/compare.hpp>

namespace octavo::exact {

template Sign exact_compare_coordinate(int, const EdgePoint&, const EdgePoint&);
template Sign exact_compare_coordinate(int, const EdgePoint&, const TriplePoint&);
template Sign exact_compare_coordinate(int, const TriplePoint&, const EdgePoint&);
template Sign exact_compare_coordinate(int, const TriplePoint&, const TriplePoint&);

}  // namespace octavo::exact
