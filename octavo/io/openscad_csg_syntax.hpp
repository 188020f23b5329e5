// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/io/openscad_csg.hpp>

// The syntax tree of a .csg file, in flat arrays that point into the text.
//
//     file = { node }        node = { "%" | "#" | "*" | "!" } name "(" [ argument { "," argument } ] ")"
//                                   ( ";" | "{" { node } "}" [ ";" ] )
//     argument = [ name "=" ] value        value = number | string | true | false | undef | "[" values "]" | range
//
// Comments are // and /* */. text() is special: OpenSCAD dumps its strings as they are, quotes included, so its
// arguments are stepped over to the end of its line.

namespace octavo::io::openscad {

/// A value; the elements of a vector follow it directly, each with all of its own.
struct Value {
    enum class Kind : std::uint8_t { number, boolean, undefined, string, vector, range };
    double number = 0;        ///< of a number or a boolean (0, 1)
    std::uint32_t count = 0;  ///< elements of a vector
    std::uint32_t size : 29;  ///< values that it takes, itself included
    std::uint32_t kind_bits : 3;

    Kind kind() const { return static_cast<Kind>(kind_bits); }
};
static_assert(sizeof(Value) == 16);

struct Argument {
    std::string_view name;        ///< empty when given by position
    std::uint32_t value = 0;      ///< index into `values`
    std::uint64_t place = 0;      ///< offset in the text
    std::string_view raw_string;  ///< of a string: what stands between the quotes, escapes not resolved
};

inline constexpr std::uint32_t no_node = ~std::uint32_t{0};

struct Node {
    std::string_view name;
    std::uint64_t place = 0;  ///< offset in the text
    std::uint32_t first_argument = 0, argument_count = 0;
    std::uint32_t first_child = no_node, next_sibling = no_node;
    std::uint32_t parent = no_node;
    bool background = false, disabled = false, alone = false;  ///< %, *, !
};

struct Syntax {
    std::string_view text;
    std::vector<Node> nodes;  ///< parents before children
    std::vector<Argument> arguments;
    std::vector<Value> values;

    /// An error at an offset in the text.
    Error error_at(std::uint64_t place, std::string sentence, ErrorCode code = ErrorCode::bad_input) const;
    /// "line 3, column 7"
    std::string place_text(std::uint64_t place) const;
};

Result<Syntax> parse(std::string_view text, const CsgReadOptions& options, const Context& context);

/// A string's value, with \" \\ \n \t \r \xHH \uHHHH \UHHHHHH resolved.
std::string unescaped(std::string_view raw);

}  // namespace octavo::io::openscad
