// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/zip.hpp>

#include "from_text.hpp"

namespace octavo::io {
namespace {

std::string archive_of(std::initializer_list<std::pair<const char*, std::string>> entries) {
    Output output = Output::to_memory();
    ZipWriter writer(output);
    for (const auto& [name, content] : entries) EXPECT_TRUE(writer.add(name, content));
    EXPECT_TRUE(writer.finish());
    return std::string(text_of(std::move(output).take_memory()));
}

/// An archive of one stored entry "a" as a streaming writer makes it: the sizes stand behind the data.
std::string streamed_archive(const std::string& content, std::uint32_t checksum) {
    std::string file;
    const auto put = [&](auto value) { file.append(reinterpret_cast<const char*>(&value), sizeof value); };
    const auto size = static_cast<std::uint32_t>(content.size());
    put(std::uint32_t{0x04034b50}), put(std::uint16_t{20}), put(std::uint16_t{8}), put(std::uint16_t{0});
    put(std::uint32_t{0}), put(std::uint32_t{0}), put(std::uint32_t{0}), put(std::uint32_t{0});
    put(std::uint16_t{1}), put(std::uint16_t{3});
    file += "a...";  // a name and an extra field
    file += content;
    put(std::uint32_t{0x08074b50}), put(checksum), put(size), put(size);
    const auto directory = static_cast<std::uint32_t>(file.size());
    put(std::uint32_t{0x02014b50}), put(std::uint16_t{20}), put(std::uint16_t{20}), put(std::uint16_t{8});
    put(std::uint16_t{0}), put(std::uint32_t{0}), put(checksum), put(size), put(size), put(std::uint16_t{1});
    put(std::uint16_t{2}), put(std::uint16_t{3}), put(std::uint16_t{0}), put(std::uint16_t{0});
    put(std::uint32_t{0}), put(std::uint32_t{0});
    file += "a..xyz";  // a name, an extra field and a comment
    const auto end = static_cast<std::uint32_t>(file.size());
    put(std::uint32_t{0x06054b50}), put(std::uint32_t{0}), put(std::uint16_t{1}), put(std::uint16_t{1});
    put(end - directory), put(directory), put(std::uint16_t{7});
    return file + "comment";
}

void set_long(std::string& file, std::size_t at, std::uint32_t value) {
    file.replace(at, 4, reinterpret_cast<const char*>(&value), 4);
}
void set_word(std::string& file, std::size_t at, std::uint16_t value) {
    file.replace(at, 2, reinterpret_cast<const char*>(&value), 2);
}

TEST(Zip, ReadsWhatItWrote) {
    std::string large;
    for (int i = 0; i < 300000; ++i) large += static_cast<char>('a' + i % 23 * (i % 7) % 23);
    const std::string file = archive_of({{"empty", ""}, {"Folder/text", "hello"}, {"large", large}});
    const Result<ZipReader> zip = ZipReader::open(bytes_of(file));
    ASSERT_TRUE(zip);
    ASSERT_EQ(zip->entries().size(), 3u);
    EXPECT_EQ(text_of(*zip->read(zip->entries()[0], 0)), "");
    EXPECT_EQ(text_of(*zip->read(*zip->find("/folder/TEXT"), 100)), "hello");
    EXPECT_EQ(text_of(*zip->read(*zip->find("large"), 300000)), large);
    EXPECT_LT(file.size(), 100000u);
    EXPECT_EQ(zip->find("nothing"), nullptr);
    EXPECT_EQ(file, archive_of({{"empty", ""}, {"Folder/text", "hello"}, {"large", large}}));
}

TEST(Zip, ReadsStoredEntriesWithDataDescriptors) {
    const std::string file = streamed_archive("123456789", 0xcbf43926);
    const Result<ZipReader> zip = ZipReader::open(bytes_of(file));
    ASSERT_TRUE(zip) << zip.error().describe();
    EXPECT_EQ(text_of(*zip->read(zip->entries()[0], 9)), "123456789");
    EXPECT_EQ(zip->read(zip->entries()[0], 8).error().code, ErrorCode::limit);
    const std::string wrong = streamed_archive("123456789", 0xcbf43927);
    const Result<ZipReader> bad = ZipReader::open(bytes_of(wrong));
    EXPECT_THAT(bad->read(bad->entries()[0], 9).error().sentence, testing::HasSubstr("damaged"));
}

TEST(Zip, RefusesBombsThatLieAboutTheirSize) {
    const std::string file = archive_of({{"bomb", std::string(3'000'000, '\0')}});
    const std::size_t directory = file.rfind("PK\x01\x02");
    for (const std::uint32_t claimed : {0u, 10u, 2'999'999u, 3'000'001u, 0x7fffffffu}) {
        std::string lying = file;
        set_long(lying, directory + 24, claimed);
        const Result<ZipReader> zip = ZipReader::open(bytes_of(lying));
        const Result<std::vector<std::byte>> content = zip->read(zip->entries()[0], 1'000'000'000'000);
        ASSERT_FALSE(content) << claimed;
        EXPECT_EQ(content.error().code, ErrorCode::bad_input);
    }
    const Result<ZipReader> zip = ZipReader::open(bytes_of(file));
    EXPECT_EQ(zip->read(zip->entries()[0], 1'000'000).error().code, ErrorCode::limit);
}

TEST(Zip, RefusesWhatItDoesNotReadByName) {
    const std::string file = archive_of({{"a", "hello"}});
    const std::size_t directory = file.rfind("PK\x01\x02"), end = file.rfind("PK\x05\x06");
    const auto sentence = [&](const std::string& changed) {
        const Result<ZipReader> zip = ZipReader::open(bytes_of(changed));
        if (!zip) return zip.error().sentence;
        const auto content = zip->read(zip->entries()[0], 100);
        return content ? std::string() : content.error().sentence;
    };
    std::string changed = file;
    set_word(changed, directory + 8, 1);
    EXPECT_THAT(sentence(changed), testing::HasSubstr("encrypted"));
    changed = file;
    set_word(changed, directory + 10, 93);
    EXPECT_THAT(sentence(changed), testing::HasSubstr("method 93"));
    changed = file;
    set_long(changed, directory + 24, 0xffffffffu);
    EXPECT_THAT(sentence(changed), testing::HasSubstr("Zip64"));
    changed = file;
    set_long(changed, end + 16, 0xffffffffu);
    EXPECT_THAT(sentence(changed), testing::HasSubstr("Zip64"));
    changed = file;
    set_word(changed, end + 4, 1);
    EXPECT_THAT(sentence(changed), testing::HasSubstr("split"));
    EXPECT_THAT(sentence("PK\x03\x04 and no more"), testing::HasSubstr("no ZIP archive"));
}

TEST(Zip, SurvivesEveryTruncationAndEveryChangedByte) {
    const std::string file = archive_of({{"a", "hello"}, {"b", "hello again, hello again"}});
    const auto try_all = [](const std::string& changed) {
        const Result<ZipReader> zip = ZipReader::open(bytes_of(changed));
        if (!zip) return false;
        bool all = true;
        for (const ZipEntry& entry : zip->entries()) all &= zip->read(entry, 1000).has_value();
        return all;
    };
    EXPECT_TRUE(try_all(file));
    for (std::size_t size = 0; size < file.size(); ++size) EXPECT_FALSE(try_all(file.substr(0, size)));
    for (std::size_t at = 0; at < file.size(); ++at)
        for (const char bits : {'\x01', '\x80', '\xff'}) {
            std::string changed = file;
            changed[at] = static_cast<char>(changed[at] ^ bits);
            try_all(changed);
        }
}

}  // namespace
}  // namespace octavo::io
