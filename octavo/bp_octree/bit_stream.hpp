// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// Bits in bytes, the first in the lowest bit of the first byte. A reader that runs out of bits delivers zeros and
// remembers it, so that decoders test once at the end and loops stay simple.

namespace octavo::bp_octree {

class BitWriter {
  public:
    /// Appends the lowest `count` bits, 0 to 32.
    void put(std::uint32_t value, int count) {
        pending_ |= std::uint64_t{value} << used_;
        used_ += count;
        while (used_ >= 8) {
            bytes_.push_back(static_cast<std::uint8_t>(pending_));
            pending_ >>= 8;
            used_ -= 8;
        }
    }
    /// Rice code: the quotient by 2^k in unary (ones and a zero), then the k bits of the rest. From a quotient of 24
    /// on, 24 ones and the value's 32 bits.
    void put_rice(std::uint32_t value, int k) {
        const std::uint32_t quotient = value >> k;
        if (quotient >= 24) {
            put(0xffffff, 24);
            put(value, 32);
        } else {
            put((1U << quotient) - 1, static_cast<int>(quotient) + 1);
            put(value & ((std::uint64_t{1} << k) - 1), k);
        }
    }
    /// The bytes; the last one is filled up with zeros.
    std::vector<std::uint8_t> take() && {
        if (used_ > 0) bytes_.push_back(static_cast<std::uint8_t>(pending_));
        return std::move(bytes_);
    }

  private:
    std::vector<std::uint8_t> bytes_;
    std::uint64_t pending_ = 0;
    int used_ = 0;
};

class BitReader {
  public:
    explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t get(int count) {
        while (filled_ < count) {
            if (next_ < bytes_.size())
                pending_ |= std::uint64_t{bytes_[next_++]} << filled_;
            else
                ++missing_;
            filled_ += 8;
        }
        const auto value = static_cast<std::uint32_t>(pending_ & ((std::uint64_t{1} << count) - 1));
        pending_ >>= count;
        filled_ -= count;
        return value;
    }
    std::uint32_t get_rice(int k) {
        std::uint32_t quotient = 0;
        while (quotient < 24 && get(1) == 1) ++quotient;
        if (quotient == 24) return get(32);
        return static_cast<std::uint32_t>(std::uint64_t{quotient} << k | get(k));
    }
    /// True when exactly all bytes were used and the bits that fill up the last one are zero.
    bool finished() const { return missing_ == 0 && next_ == bytes_.size() && pending_ == 0; }
    bool overrun() const { return missing_ > 0; }
    std::uint64_t bits_left() const {
        return 8 * (bytes_.size() - next_) + static_cast<std::uint64_t>(filled_);
    }

  private:
    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
    std::uint64_t pending_ = 0;
    int filled_ = 0;
    std::size_t missing_ = 0;
};

/// Signed numbers as unsigned ones with small magnitudes first: 0, −1, 1, −2, 2 …
constexpr std::uint32_t zigzag(std::int32_t v) {
    return static_cast<std::uint32_t>(v) << 1 ^ static_cast<std::uint32_t>(v >> 31);
}
constexpr std::int32_t unzigzag(std::uint32_t v) { return static_cast<std::int32_t>(v >> 1 ^ (0 - (v & 1))); }

/// The parameter of a Rice code that follows what it has seen: log2 of a running mean.
class RiceState {
  public:
    int k() const { return std::bit_width(mean_ >> 4) > 0 ? std::bit_width(mean_ >> 4) - 1 : 0; }
    void saw(std::uint32_t value) { mean_ += value - (mean_ >> 4); }

  private:
    std::uint64_t mean_ = std::uint64_t{1} << 20;  ///< sixteen times the mean
};

}  // namespace octavo::bp_octree
