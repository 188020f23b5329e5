// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/result.hpp>

namespace octavo {

std::string Error::describe() const {
    std::string text = place.file;
    if (place.line != 0) text += (text.empty() ? "line " : ":") + std::to_string(place.line);
    if (place.column != 0) text += ":" + std::to_string(place.column);
    if (!text.empty()) text += ": ";
    if (place.operand) text += "operand " + std::to_string(*place.operand) + ": ";
    text += sentence;
    if (option) text += " (" + *option + ")";
    if (place.byte != Place::no_byte) text += " (byte " + std::to_string(place.byte) + ")";
    if (!place.faces.empty()) {
        constexpr std::size_t most = 8;
        text += place.faces.size() == 1 ? " (facet " : " (facets ";
        for (std::size_t i = 0; i < place.faces.size() && i < most; ++i)
            text += (i ? ", " : "") + std::to_string(place.faces[i]);
        if (place.faces.size() > most) text += ", …";
        text += ")";
    }
    return text;
}

}  // namespace octavo
