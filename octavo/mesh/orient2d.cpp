// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/mesh/orient2d.hpp>

namespace octavo::mesh {
namespace {

/// A sum of doubles held without loss as a sum of non-overlapping doubles of increasing magnitude.
class Expansion {
  public:
    /// Adds p · q exactly.
    void add_product(double p, double q) {
        const double product = p * q;
        add(std::fma(p, q, -product));
        add(product);
    }

    int sign() const {
        // The components do not overlap, so the last that is not zero outweighs the rest.
        for (int i = size_ - 1; i >= 0; --i)
            if (components_[i] != 0) return components_[i] > 0 ? 1 : -1;
        return 0;
    }

  private:
    void add(double term) {
        for (int i = 0; i < size_; ++i) {
            const double component = components_[i];
            const double sum = term + component;
            const double part = sum - term;
            components_[i] = (term - (sum - part)) + (component - part);
            term = sum;
        }
        components_[size_++] = term;
    }

    std::array<double, 12> components_{};
    int size_ = 0;
};

}  // namespace

int orient2d_exact(Point2 a, Point2 b, Point2 c) {
    // (a − c) × (b − c) multiplied out; the two products c.x c.y cancel.
    Expansion determinant;
    determinant.add_product(a.x, b.y);
    determinant.add_product(-a.x, c.y);
    determinant.add_product(-c.x, b.y);
    determinant.add_product(-a.y, b.x);
    determinant.add_product(a.y, c.x);
    determinant.add_product(c.y, b.x);
    return determinant.sign();
}

}  // namespace octavo::mesh
