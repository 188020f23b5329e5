// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/bsp/fragment.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/render/eye.hpp>
#include <octavo/render/patches.hpp>

// From an exact fragment to a patch in the world.

namespace octavo::render {

/// The colours of a face: seen from outside, seen from inside, and where it was cut, unlit.
struct Paint {
    Color front, back;
    bool is_cap = false;
};

class PatchMaker {
  public:
    PatchMaker(const Camera& camera, const exact::Lattice& lattice)
        : camera_(camera), lattice_(lattice), eye_(camera, lattice) {
        patches_.unit = lattice.unit();
    }

    const Eye& eye() const { return eye_; }

    /// Appends the fragment, unless it is seen edge-on.
    void add(const bsp::FragmentPool& pool, const bsp::Fragment& fragment, const Paint& paint);

    Patches take() && { return std::move(patches_); }

  private:
    const Camera& camera_;
    exact::Lattice lattice_;
    Eye eye_;
    Patches patches_;
};

}  // namespace octavo::render
