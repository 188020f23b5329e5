// SPDX-License-Identifier: Apache-2.0
#include <octavo/exact/side.hpp>

namespace octavo::exact {

template Sign exact_side_of(const Plane&, const EdgePoint&);
template Sign exact_side_of(const Plane&, const TriplePoint&);

}  // namespace octavo::exact
