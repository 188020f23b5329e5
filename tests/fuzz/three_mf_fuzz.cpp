// SPDX-License-Identifier: Apache-2.0
#include <string>

#include <octavo/io/output.hpp>
#include <octavo/io/zip.hpp>

#include "round_trip.hpp"

// The bytes are tried as the whole archive, and as the XML of the model inside a sound one: mutations that keep
// checksums right are too rare to reach the XML otherwise.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace octavo;
    if (size > 0 && data[0] == 'P') {
        fuzz::read_write_read(data, size, "3mf", io::Encoding::automatic);
        return 0;
    }
    io::Output output = io::Output::to_memory();
    io::ZipWriter archive(output);
    const Status added = archive.add("3D/a.model", {reinterpret_cast<const char*>(data), size});
    OCTAVO_CHECK(added && archive.finish(), "small archives are written");
    const std::vector<std::byte> bytes = std::move(output).take_memory();
    fuzz::read_write_read(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), "3mf",
                          io::Encoding::automatic);
    return 0;
}
