// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/base/check.hpp>
#include <octavo/bsp_octree/line_key.hpp>

namespace octavo::bsp_octree {
namespace {

using exact::int128;
__extension__ using Wide = unsigned __int128;

/// Arithmetic modulo a prime 2^bits − rest just below a power of two, where what is above the bits counts `rest` times.
class Field {
  public:
    Field(int bits, std::uint64_t rest)
        : bits_(bits), rest_(rest), prime_((std::uint64_t{1} << bits) - rest) {}

    std::uint64_t of(int128 number) const {
        const std::uint64_t residue = reduced(static_cast<Wide>(number < 0 ? -number : number));
        return number < 0 && residue != 0 ? prime_ - residue : residue;
    }
    std::uint64_t product(std::uint64_t a, std::uint64_t b) const { return reduced(Wide{a} * b); }
    std::uint64_t difference(std::uint64_t a, std::uint64_t b) const {
        return a >= b ? a - b : a + prime_ - b;
    }
    std::uint64_t inverse(std::uint64_t a) const {
        // Fermat: a^(p − 2).
        std::uint64_t result = 1;
        for (std::uint64_t power = prime_ - 2; power; power >>= 1, a = product(a, a))
            if (power & 1) result = product(result, a);
        return result;
    }

  private:
    /// Below 2^127: the first fold leaves less than 2^73, the second less than 2^62 + 2^17.
    std::uint64_t reduced(Wide number) const {
        const Wide low = (Wide{1} << bits_) - 1;
        number = (number >> bits_) * rest_ + (number & low);
        auto folded = static_cast<std::uint64_t>((number >> bits_) * rest_ + (number & low));
        while (folded >= prime_) folded -= prime_;
        return folded;
    }

    int bits_;
    std::uint64_t rest_, prime_;
};

using Coordinates = std::array<std::uint64_t, 6>;

Coordinates pluecker(const Field& field, const PlanePair& line) {
    std::array<std::uint64_t, 4> f, g;
    for (int axis = 0; axis < 3; ++axis) {
        f[static_cast<std::size_t>(axis)] = field.of(line.first.normal(axis));
        g[static_cast<std::size_t>(axis)] = field.of(line.second.normal(axis));
    }
    f[3] = field.of(line.first.d()), g[3] = field.of(line.second.d());
    const auto minor = [&](std::size_t i, std::size_t j) {
        return field.difference(field.product(f[i], g[j]), field.product(f[j], g[i]));
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1), minor(3, 0), minor(3, 1), minor(3, 2)};
}

std::uint64_t first_of(const Coordinates& c) {
    for (const std::uint64_t coordinate : c)
        if (coordinate != 0) return coordinate;
    return 1;
}

}  // namespace

std::vector<std::uint64_t> line_keys(std::span<const PlanePair> lines, int attempt) {
    OCTAVO_CHECK(attempt == 0 || attempt == 1, "there are two primes");
    const Field field = attempt == 0 ? Field(61, 1) : Field(62, 57);
    std::vector<Coordinates> coordinates;
    coordinates.reserve(lines.size());
    std::vector<std::uint64_t> products{1};  // of the divisors so far
    products.reserve(lines.size() + 1);
    for (const PlanePair& line : lines) {
        coordinates.push_back(pluecker(field, line));
        products.push_back(field.product(products.back(), first_of(coordinates.back())));
    }
    std::vector<std::uint64_t> keys(lines.size());
    std::uint64_t inverse = field.inverse(products.back());
    for (std::size_t i = lines.size(); i-- > 0;) {
        const std::uint64_t divided = field.product(inverse, products[i]);
        inverse = field.product(inverse, first_of(coordinates[i]));
        std::uint64_t key = 0;
        for (const std::uint64_t coordinate : coordinates[i])
            key = (key ^ field.product(coordinate, divided)) * 0x9E3779B97F4A7C15ull, key ^= key >> 29;
        keys[i] = key;
    }
    return keys;
}

}  // namespace octavo::bsp_octree
