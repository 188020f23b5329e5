// SPDX-License-Identifier: Apache-2.0
// Signs of sums of products of doubles, without rounding.
//
// A sum is held as doubles that do not overlap (Shewchuk, "Adaptive precision floating-point arithmetic", 1997): each
// term passes all components, two-sum after two-sum, and leaves what did not fit behind. Costs one pass a term, so it
// is for the few decisions that a filter leaves open. Exact unless a product underflows: callers scale first.
#pragma once

#include <array>
#include <cmath>

namespace octavo {

/// A sum of at most `capacity` doubles, without loss.
template <int capacity>
class Expansion {
  public:
    /// Adds p · q: two terms.
    void add_product(double p, double q) {
        const double product = p * q;
        add(std::fma(p, q, -product));
        add(product);
    }

    /// Adds p · q · r: four terms.
    void add_product(double p, double q, double r) {
        const double product = p * q;
        add_product(std::fma(p, q, -product), r);
        add_product(product, r);
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

    std::array<double, capacity> components_{};
    int size_ = 0;
};

}  // namespace octavo
