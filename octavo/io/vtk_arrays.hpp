// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/io/vtk_appended.hpp>

// The arrays of a VTK XML file together with the elements that name them.

namespace octavo::io {

class VtkArrays {
  public:
    /// Adds the array that `fill(put)` makes of calls put(value), and its element to `xml`. `type` is VTK's name of T,
    /// or "Bit" for bytes of eight; `more` are further attributes, each with a blank before it.
    template <class T, class Fill>
    void add(std::string& xml, const char* type, const std::string& name, const std::string& more,
             const Fill& fill) {
        const std::uint64_t offset = data_.begin_array();
        fill([&](T value) { data_.add(value); });
        data_.end_array();
        xml += std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\"" + more +
               " format=\"appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
    }
    const VtkAppendedData& data() const { return data_; }

  private:
    VtkAppendedData data_;
};

}  // namespace octavo::io
