// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <octavo/base/check.hpp>

// Bad data is not a bug: it comes back as a value. A function that can meet bad data returns Result<T>, which
// holds either a T or an Error that says what is wrong, in one sentence, and where. A caller's mistake is a
// failed OCTAVO_CHECK instead. There are no exceptions in the interface and no empty solid ever stands for an
// error.

namespace octavo {

/// What kind of trouble; the command line maps each to one exit code.
enum class ErrorCode : std::uint8_t {
    bad_input,    ///< the data cannot be read or is not what it claims to be
    not_a_solid,  ///< readable, but it bounds no solid (open, inconsistently oriented) and the policy refuses
                  ///< it
    unsupported,  ///< legal, but Octavo does not do this
    limit,        ///< a size, depth or memory limit was reached
    io,           ///< the operating system refused to open, read or write
    cancelled,    ///< the caller asked to stop
    internal,     ///< a defect of Octavo
};

/// Where the trouble is. Every part is optional; `faces` are indices of input facets, at most a few for a
/// message.
struct Place {
    std::string file;
    std::uint64_t line = 0;                          ///< 1-based; 0 is unknown
    std::uint64_t column = 0;                        ///< 1-based; 0 is unknown
    std::uint64_t byte = no_byte;                    ///< 0-based offset in the file
    static constexpr std::uint64_t no_byte = ~0ULL;  ///< `byte` is unknown
    std::vector<std::uint32_t> faces;
    /// Which of several operands or solids, from 0; whoever knows them by a better name says that instead.
    std::optional<std::uint32_t> operand = {};
};

struct Error {
    ErrorCode code = ErrorCode::internal;
    std::string sentence;  ///< what is wrong, without the place, without a final full stop
    Place place;
    /// The option with another value of which the work would go on, by its name in the options of the function that
    /// failed ("max_nodes"); empty when there is none. A program tells it by the name under which its users know it.
    std::optional<std::string> option = {};

    /// One line for people: `FILE:LINE:COLUMN: SENTENCE (max_nodes) (facets 3, 17)`.
    std::string describe() const;
};

/// Holds a T or an Error. Test it before use: `if (!mesh) return mesh.error();`.
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

    bool has_value() const { return state_.index() == 0; }
    explicit operator bool() const { return has_value(); }

    T& value() & { return checked(), std::get<0>(state_); }
    const T& value() const& { return checked(), std::get<0>(state_); }
    T&& value() && { return checked(), std::get<0>(std::move(state_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Error& error() const& {
        OCTAVO_CHECK(!has_value(), "a Result with a value has no error");
        return std::get<1>(state_);
    }
    Error&& error() && {
        OCTAVO_CHECK(!has_value(), "a Result with a value has no error");
        return std::get<1>(std::move(state_));
    }

  private:
    void checked() const { OCTAVO_CHECK(has_value(), std::get<1>(state_).sentence.c_str()); }

    std::variant<T, Error> state_;
};

/// The Result of a function that only can fail.
struct Done {};
using Status = Result<Done>;

}  // namespace octavo
