// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_reader.hpp>
#include <octavo/io/write.hpp>

// .bpo files: the bytes of bpo_format.hpp on disk.

namespace octavo::bp_octree {

struct ReadBpo {
    BpOctree tree;
    std::uint64_t bytes = 0;                    ///< of the file as it is
    std::uint64_t bytes_read = 0;               ///< of them
    std::vector<std::uint64_t> bytes_to_level;  ///< of the file up to and with each level of the tree
    bool is_partial = false;  ///< the file ends early; the tree has the levels that arrived and no triangles
};

struct ReadBpoOptions {
    /// Read levels 0 to this one only, and no triangles; `bpo_format.hpp` says what else is missing then. By default
    /// all.
    std::optional<int> levels;
    /// What to do with the beginning of a file, such as a download that broke off.
    enum class Partial : std::uint8_t { reject, accept };
    Partial partial = Partial::reject;
};

/// Reads the file `path`, or standard input when it is "-". Of files on disk no more is read than the levels asked for.
/// Errors: those of `decode`; io when the system refuses.
Result<ReadBpo> read_bpo(const std::string& path, const ReadBpoOptions& options = {},
                         const Context& context = {});

/// Opens the same to be read in parts. What is no file on disk is read whole first.
Result<BpoReader> open_bpo(const std::string& path, const Context& context = {});

/// Writes the bytes that `encode` made to the file `path`, or to standard output when it is "-"; the file appears whole
/// or not at all.
Result<io::WriteReport> write_bpo(const std::string& path, std::span<const std::uint8_t> bytes,
                                  const Context& context = {});

}  // namespace octavo::bp_octree
