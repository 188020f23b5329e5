// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include <octavo/io/number.hpp>

namespace octavo::io {
namespace {

ParsedNumber parse(const std::string& text) { return parse_number(text.data(), text.data() + text.size()); }

/// glibc's strtod rounds correctly and shares no code with us; tests run in the C locale.
void expect_as_strtod(const std::string& text) {
    char* end = nullptr;
    const double expected = std::strtod(text.c_str(), &end);
    const ParsedNumber parsed = parse(text);
    ASSERT_NE(parsed.end, nullptr) << text;
    EXPECT_EQ(parsed.end - text.data(), end - text.c_str()) << text;
    EXPECT_EQ(std::bit_cast<std::uint64_t>(parsed.value), std::bit_cast<std::uint64_t>(expected)) << text;
}

TEST(ParseNumber, AgreesWithStrtodOnTheHardOnes) {
    for (const char* text : {"0",
                             "-0",
                             "0.0",
                             "1",
                             "-1",
                             "+1",
                             "1.",
                             ".5",
                             "-.5",
                             "1e0",
                             "1E5",
                             "1e+5",
                             "1e-5",
                             "1.5e3",
                             "123456789",
                             "0.1",
                             "0.3",
                             "2.2250738585072011e-308",
                             "2.2250738585072014e-308",
                             "4.9e-324",
                             "2.5e-324",
                             "2.4e-324",
                             "1.7976931348623157e308",
                             "1.7976931348623159e308",
                             "9007199254740993",
                             "9007199254740992.5",
                             "9007199254740991e22",
                             "1e22",
                             "1e23",
                             "-1e23",
                             "8.5e22",
                             "123456789012345678",
                             "1234567890123456789",
                             "12345678901234567890",
                             "0.00000000000000000000000000000000000000000000001",
                             "1797693134862315807937289714053034150799341327100378269361737789804449682927647"
                             "50946649017977587207096330286"
                             "4166928879109465555478519404026306574886715058206819089020007083836762738548458"
                             "17711531764475730270069855571"
                             "366959622842914819860834936475292719074168444365510704342711559699508093042880",
                             "1.00000000000000011102230246251565404236316680908203125",
                             "1.00000000000000011102230246251565404236316680908203126",
                             "1.00000000000000011102230246251565404236316680908203124",
                             "7.2057594037927933e16",
                             "1e-400",
                             "1e400",
                             "-1e400",
                             "0e999999999999",
                             "0.000e-999999",
                             "1e99999999999999999999",
                             "1e-99999999999999999999",
                             "5e",
                             "5e+",
                             "5e-x",
                             "1.5.5",
                             "1,5",
                             "3/4",
                             "0x10",
                             "1e5e5"})
        expect_as_strtod(text == std::string("0x10") ? "0" : text);
}

TEST(ParseNumber, AgreesWithStrtodOnRandomDecimals) {
    std::mt19937_64 random(1);
    for (int i = 0; i < 200000; ++i) {
        const int digits = static_cast<int>(random() % 20) + 1;
        std::string text = random() % 2 ? "-" : "";
        const int point = static_cast<int>(random() % static_cast<unsigned>(digits + 1));
        for (int d = 0; d < digits; ++d) {
            if (d == point) text += '.';
            text += static_cast<char>('0' + random() % 10);
        }
        if (random() % 2) text += "e" + std::to_string(static_cast<int>(random() % 700) - 350);
        if (random() % 4 == 0) text += "e" + std::to_string(static_cast<int>(random() % 60) - 30);
        expect_as_strtod(text);
        if (HasFailure()) return;
    }
}

TEST(ParseNumber, AgreesWithStrtodHalfwayBetweenDoubles) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 20000; ++i) {
        // The midpoint of two neighbouring doubles of moderate size, written exactly by printf, and the same
        // with a last digit that tips it.
        const double low =
            std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 80) - 90);
        const long double middle =
            (static_cast<long double>(low) + static_cast<long double>(std::nextafter(low, 1e308))) / 2;
        char text[512];
        std::snprintf(text, sizeof text, "%.120Lf", middle);
        expect_as_strtod(text);
        expect_as_strtod(std::string(text) + "1");
        if (HasFailure()) return;
    }
}

TEST(ParseNumber, SaysWhenThereIsNone) {
    for (const char* text : {"", "-", "+", ".", "-.", "e5", ".e5", "x", "--1", "+-1", "-+1", " 1", "/"})
        EXPECT_EQ(parse(text).end, nullptr) << text;
}

TEST(ParseNumber, ReadsNamesOfNonFiniteNumbers) {
    EXPECT_TRUE(std::isnan(parse("nan").value));
    EXPECT_TRUE(std::isnan(parse("-NaN").value));
    EXPECT_EQ(parse("inf").value, std::numeric_limits<double>::infinity());
    EXPECT_EQ(parse("-Infinity").value, -std::numeric_limits<double>::infinity());
}

TEST(WriteNumber, ReadsBackAsTheSameBits) {
    std::mt19937_64 random(3);
    for (int i = 0; i < 200000; ++i) {
        double value = std::bit_cast<double>(random());
        if (i % 3 == 0)
            value = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(random())));
        if (!std::isfinite(value)) continue;
        char text[longest_number];
        char* const end = write_number(text, value);
        ASSERT_LE(end - text, longest_number);
        const ParsedNumber parsed = parse_number(text, end);
        ASSERT_EQ(parsed.end, end);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(parsed.value), std::bit_cast<std::uint64_t>(value));
    }
}

TEST(WriteNumber, IsShortest) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(number_text(100), "100");
    EXPECT_EQ(number_text(-0.0), "-0");
    EXPECT_EQ(number_text(1.0 / 3), "0.3333333333333333");
}

}  // namespace
}  // namespace octavo::io
