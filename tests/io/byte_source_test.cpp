// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include <octavo/io/byte_source.hpp>

#include "io/folder.hpp"

namespace octavo::io {
namespace {

using Open = Result<std::unique_ptr<ByteSource>> (*)(const std::string&);

std::string write(const Folder& folder, const std::string& text) {
    std::ofstream(folder / "file", std::ios::binary) << text;
    return folder / "file";
}

TEST(ByteSource, EverySourceGivesTheSameParts) {
    const Folder folder;
    std::string text;
    for (unsigned i = 0; i < 100000; ++i) text += static_cast<char>('a' + i * i % 23);
    const std::string path = write(folder, text);
    ByteBlock block(text.size());
    std::memcpy(block.data(), text.data(), text.size());
    std::vector<std::unique_ptr<ByteSource>> sources;
    sources.push_back(std::move(*open_file(path)));
    sources.push_back(std::move(*map_file(path)));
    sources.push_back(source_of(std::move(block), path));
    for (const auto& source : sources) {
        EXPECT_EQ(source->size(), text.size());
        EXPECT_EQ(source->name(), path);
        for (const auto& [offset, size] : {std::pair<std::size_t, std::size_t>{0, 10},
                                           {99990, 10},
                                           {4095, 5000},
                                           {0, 100000},
                                           {100000, 0},
                                           {17, 1}}) {
            const auto range = source->read(offset, size);
            ASSERT_TRUE(range.has_value());
            EXPECT_EQ(text_of(range->bytes()), std::string_view(text).substr(offset, size));
        }
        for (const auto& [offset, size] : {std::pair<std::uint64_t, std::size_t>{99990, 11},
                                           {100001, 0},
                                           {~0ULL, 2},
                                           {0, ~std::size_t{0}}}) {
            const auto range = source->read(offset, size);
            ASSERT_FALSE(range.has_value());
            EXPECT_EQ(range.error().code, ErrorCode::bad_input);
            EXPECT_EQ(range.error().place.file, path);
        }
        // After a refusal the source goes on.
        EXPECT_TRUE(source->read(1, 1).has_value());
    }
}

TEST(ByteSource, AnEmptyFileHasNothing) {
    const Folder folder;
    const std::string path = write(folder, "");
    for (const Open open : {Open{open_file}, Open{map_file}}) {
        const auto source = open(path);
        ASSERT_TRUE(source.has_value());
        EXPECT_EQ((*source)->size(), 0U);
        EXPECT_TRUE((*source)->read(0, 0).has_value());
        EXPECT_FALSE((*source)->read(0, 1).has_value());
    }
}

TEST(ByteSource, WhatCannotBeOpenedIsAnErrorOfTheSystem) {
    const Folder folder;
    for (const Open open : {Open{open_file}, Open{map_file}})
        EXPECT_EQ(open(folder / "missing").error().code, ErrorCode::io);
    EXPECT_EQ(map_file("/dev/null").error().code, ErrorCode::io);
    EXPECT_EQ(map_file(folder / ".").error().code, ErrorCode::io);
}

}  // namespace
}  // namespace octavo::io
