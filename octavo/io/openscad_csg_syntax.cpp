// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <optional>
#include <utility>

#include <octavo/io/number.hpp>
#include <octavo/io/openscad_csg_syntax.hpp>

namespace octavo::io::openscad {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

class Parser {
  public:
    Parser(std::string_view text, const CsgReadOptions& options, const Context& context)
        : options_(options), context_(context), at_(text.data()), end_(text.data() + text.size()) {
        syntax_.text = text;
    }

    Result<Syntax> run() {
        if (text_begins_with("\xEF\xBB\xBF")) at_ += 3;
        std::uint32_t open = no_node, last = no_node;
        // One turn is one node's head or one closing brace; nesting lives in `open` and in the nodes' parents.
        for (;;) {
            skip_space();
            if (error_) return std::move(*error_);
            if (at_ == end_) break;
            if (*at_ == '}') {
                if (open == no_node) return fail(at_, "a '}' closes nothing");
                ++at_;
                skip_space();
                if (at_ != end_ && *at_ == ';') ++at_;
                last = open;
                open = syntax_.nodes[open].parent;
                continue;
            }
            if (*at_ == ';') {  // an empty statement
                ++at_;
                continue;
            }
            const auto index = static_cast<std::uint32_t>(syntax_.nodes.size());
            if (!read_head(open)) return std::move(*error_);
            link(open, last, index);
            last = index;
            skip_space();
            if (error_) return std::move(*error_);
            if (at_ != end_ && *at_ == '{') {
                ++at_;
                open = index;
                last = no_node;
            } else if (at_ != end_ && *at_ == ';') {
                ++at_;
            } else {
                return fail(at_,
                            "expected ';' or '{' after " + std::string(syntax_.nodes[index].name) + "(…)");
            }
        }
        if (open != no_node)
            return syntax_.error_at(
                syntax_.nodes[open].place,
                "the '{' of " + std::string(syntax_.nodes[open].name) + "(…) is never closed");
        return std::move(syntax_);
    }

  private:
    std::uint64_t offset(const char* p) const { return static_cast<std::uint64_t>(p - syntax_.text.data()); }

    Error fail(const char* where, std::string sentence) {
        error_ = syntax_.error_at(offset(where), std::move(sentence));
        return *error_;
    }

    bool text_begins_with(std::string_view prefix) const {
        return static_cast<std::size_t>(end_ - at_) >= prefix.size() &&
               std::memcmp(at_, prefix.data(), prefix.size()) == 0;
    }

    void skip_space() {
        for (;;) {
            while (at_ != end_ && static_cast<unsigned char>(*at_) <= ' ') ++at_;
            if (text_begins_with("//")) {
                while (at_ != end_ && *at_ != '\n') ++at_;
            } else if (text_begins_with("/*")) {
                const std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
                const std::size_t close = rest.find("*/", 2);
                if (close == std::string_view::npos) {
                    fail(at_, "a comment is never closed");
                    at_ = end_;
                    return;
                }
                at_ += close + 2;
            } else {
                return;
            }
        }
    }

    void link(std::uint32_t parent, std::uint32_t last, std::uint32_t index) {
        syntax_.nodes[index].parent = parent;
        if (last != no_node)
            syntax_.nodes[last].next_sibling = index;
        else if (parent != no_node)
            syntax_.nodes[parent].first_child = index;
    }

    std::string_view name() {
        const char* const first = at_;
        while (at_ != end_ && (is_letter(*at_) || is_digit(*at_))) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }

    /// Modifiers, name and arguments.
    bool read_head(std::uint32_t) {
        if (syntax_.nodes.size() >= options_.most_nodes) {
            fail(at_, "the tree has more than " + std::to_string(options_.most_nodes) + " nodes");
            return false;
        }
        if (syntax_.nodes.size() % 4096 == 0 && context_.cancelled()) {
            error_ = Context::cancelled_error();
            return false;
        }
        Node node;
        for (;; ++at_) {
            skip_space();
            if (at_ == end_) break;
            if (*at_ == '%')
                node.background = true;
            else if (*at_ == '*')
                node.disabled = true;
            else if (*at_ == '!')
                node.alone = true;
            else if (*at_ != '#')
                break;
        }
        node.place = offset(at_);
        if (at_ == end_ || !is_letter(*at_)) {
            fail(at_,
                 at_ == end_ ? "the file ends where a node should follow" : "expected the name of a node");
            return false;
        }
        node.name = name();
        skip_space();
        if (at_ == end_ || *at_ != '(') {
            fail(at_, "expected '(' after " + std::string(node.name.substr(0, 60)));
            return false;
        }
        ++at_;
        node.first_argument = static_cast<std::uint32_t>(syntax_.arguments.size());
        const bool read = node.name == "text" ? skip_text() : read_arguments();
        node.argument_count = static_cast<std::uint32_t>(syntax_.arguments.size()) - node.first_argument;
        syntax_.nodes.push_back(node);
        return read;
    }

    /// The arguments of text(): to the last ')' of a line that a ';' or '{' follows.
    bool skip_text() {
        const char* const begin = at_;
        for (; at_ != end_; ++at_) {
            if (*at_ != ')') continue;
            const char* p = at_ + 1;
            while (p != end_ && (*p == ' ' || *p == '\t')) ++p;
            if (p == end_ || (*p != ';' && *p != '{')) continue;
            const char* after = p + 1;
            while (after != end_ && (*after == ' ' || *after == '\t' || *after == '\r')) ++after;
            if (after != end_ && *after != '\n' && *after != '}') continue;
            ++at_;
            return true;
        }
        fail(begin, "the arguments of text(…) never end");
        return false;
    }

    bool read_arguments() {
        skip_space();
        if (at_ != end_ && *at_ == ')') {
            ++at_;
            return true;
        }
        for (;;) {
            skip_space();
            Argument argument;
            argument.place = offset(at_);
            if (at_ != end_ && is_letter(*at_)) {
                const char* const before = at_;
                const std::string_view word = name();
                skip_space();
                if (at_ != end_ && *at_ == '=') {
                    ++at_;
                    argument.name = word;
                } else {
                    at_ = before;
                }
            }
            argument.value = static_cast<std::uint32_t>(syntax_.values.size());
            if (error_ || !read_value(argument)) return false;
            syntax_.arguments.push_back(argument);
            skip_space();
            if (error_) return false;
            if (at_ != end_ && *at_ == ',') {
                ++at_;
            } else if (at_ != end_ && *at_ == ')') {
                ++at_;
                return true;
            } else {
                fail(at_, at_ == end_ ? "the file ends inside arguments"
                                      : "expected ',' or ')' after an argument");
                return false;
            }
        }
    }

    bool push(Value::Kind kind, double number = 0) {
        if (syntax_.values.size() >= options_.most_values || syntax_.values.size() >= (1U << 29) - 2) {
            fail(at_, "the file holds more than " + std::to_string(options_.most_values) + " numbers");
            return false;
        }
        Value value{};
        value.number = number;
        value.size = 1;
        value.kind_bits = static_cast<unsigned>(kind) & 7U;
        syntax_.values.push_back(value);
        return true;
    }

    /// A value with all of its elements; open vectors are kept on a small stack.
    bool read_value(Argument& argument) {
        constexpr std::size_t deepest = 64;  // a matrix needs 2
        std::vector<std::uint32_t>& open = open_vectors_;
        open.clear();
        for (;;) {
            skip_space();
            if (error_) return false;
            if (at_ == end_) {
                fail(at_, "the file ends where a value should follow");
                return false;
            }
            if (*at_ == '[') {
                if (open.size() == deepest) {
                    fail(at_, "vectors are nested more than " + std::to_string(deepest) + " deep");
                    return false;
                }
                open.push_back(static_cast<std::uint32_t>(syntax_.values.size()));
                if (!push(Value::Kind::vector)) return false;
                ++at_;
                skip_space();
                if (at_ == end_ || *at_ != ']') continue;
            } else if (!read_scalar(argument)) {
                return false;
            }
            // After a value: close vectors, or go on to the next element.
            for (;;) {
                if (open.empty()) return true;
                skip_space();
                if (error_) return false;
                Value& vector = syntax_.values[open.back()];
                if (at_ != end_ && *at_ == ']') {
                    ++at_;
                    close_vector(open.back());
                    open.pop_back();
                    continue;
                }
                if (at_ != end_ && (*at_ == ',' || *at_ == ':')) {
                    if (*at_ == ':') vector.kind_bits = static_cast<unsigned>(Value::Kind::range) & 7U;
                    ++at_;
                    skip_space();
                    if (at_ != end_ && *at_ == ']') continue;  // a comma before the bracket
                    break;
                }
                fail(at_, at_ == end_ ? "the file ends inside a vector" : "expected ',' or ']' in a vector");
                return false;
            }
        }
    }

    void close_vector(std::uint32_t index) {
        const std::size_t end = syntax_.values.size();
        std::uint32_t count = 0;
        for (std::size_t i = index + 1; i < end; i += syntax_.values[i].size) ++count;
        syntax_.values[index].count = count;
        syntax_.values[index].size = static_cast<std::uint32_t>(end - index) & ((1U << 29) - 1);
    }

    bool read_scalar(Argument& argument) {
        if (*at_ == '"') return read_string(argument);
        if (is_letter(*at_)) {
            const char* const first = at_;
            const std::string_view word = name();
            if (word == "true" || word == "false") return push(Value::Kind::boolean, word == "true" ? 1 : 0);
            if (word == "undef") return push(Value::Kind::undefined);
            if (word != "inf" && word != "nan") {
                fail(first, "'" + std::string(word.substr(0, 60)) + "' is no value");
                return false;
            }
            at_ = first;
        }
        const ParsedNumber parsed = parse_number(at_, end_);
        if (!parsed.end) {
            fail(at_, "expected a value");
            return false;
        }
        at_ = parsed.end;
        return push(Value::Kind::number, parsed.value);
    }

    bool read_string(Argument& argument) {
        const char* const first = ++at_;
        while (at_ != end_ && *at_ != '"') at_ += *at_ == '\\' && at_ + 1 != end_ ? 2 : 1;
        if (at_ == end_) {
            fail(first - 1, "a string is never closed");
            return false;
        }
        argument.raw_string = {first, static_cast<std::size_t>(at_ - first)};
        ++at_;
        return push(Value::Kind::string);
    }

    const CsgReadOptions& options_;
    const Context& context_;
    const char* at_;
    const char* end_;
    Syntax syntax_;
    std::vector<std::uint32_t> open_vectors_;
    std::optional<Error> error_;
};

void append_utf8(std::string& to, std::uint32_t code) {
    if (code < 0x80) {
        to += static_cast<char>(code);
    } else if (code < 0x800) {
        to += static_cast<char>(0xC0 | code >> 6);
        to += static_cast<char>(0x80 | (code & 0x3F));
    } else if (code < 0x10000) {
        to += static_cast<char>(0xE0 | code >> 12);
        to += static_cast<char>(0x80 | (code >> 6 & 0x3F));
        to += static_cast<char>(0x80 | (code & 0x3F));
    } else {
        to += static_cast<char>(0xF0 | (code >> 18 & 7));
        to += static_cast<char>(0x80 | (code >> 12 & 0x3F));
        to += static_cast<char>(0x80 | (code >> 6 & 0x3F));
        to += static_cast<char>(0x80 | (code & 0x3F));
    }
}

}  // namespace

Error Syntax::error_at(std::uint64_t place, std::string sentence, ErrorCode code) const {
    Error error{code, std::move(sentence), {}};
    error.place.line = 1;
    error.place.column = 1;
    for (std::uint64_t i = 0; i < place && i < text.size(); ++i) {
        ++error.place.column;
        if (text[i] == '\n') ++error.place.line, error.place.column = 1;
    }
    error.place.byte = place;
    return error;
}

std::string Syntax::place_text(std::uint64_t place) const {
    const Error error = error_at(place, {});
    return "line " + std::to_string(error.place.line) + ", column " + std::to_string(error.place.column);
}

Result<Syntax> parse(std::string_view text, const CsgReadOptions& options, const Context& context) {
    return Parser(text, options, context).run();
}

std::string unescaped(std::string_view raw) {
    std::string result;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        if (raw[i] != '\\' || i + 1 == raw.size()) {
            result += raw[i];
            continue;
        }
        const char c = raw[++i];
        const std::size_t digits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 6 : 0;
        std::uint32_t code = 0;
        std::size_t read = 0;
        for (; read < digits && i + 1 + read < raw.size(); ++read) {
            const char h = raw[i + 1 + read];
            const int value = is_digit(h)              ? h - '0'
                              : h >= 'a' && h <= 'f'   ? h - 'a' + 10
                              : (h >= 'A' && h <= 'F') ? h - 'A' + 10
                                                       : -1;
            if (value < 0) break;
            code = code * 16 + static_cast<std::uint32_t>(value);
        }
        if (digits > 0 && read == digits) {
            append_utf8(result, code);
            i += digits;
        } else {
            result += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
        }
    }
    return result;
}

}  // namespace octavo::io::openscad
