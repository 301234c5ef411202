#include "rendering/image/image.h"

#include <gtest/gtest.h>

#include <string>

using namespace fx::image;
using fx::base::Code;

namespace {

fx::base::Result<Image> read(const std::string& bytes)
{
    return readHdr(std::as_bytes(std::span<const char>(bytes.data(), bytes.size())));
}

std::string header(int width, int height)
{
    return "#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n";
}

std::string bytes(std::initializer_list<int> values)
{
    std::string text;
    for (const int value : values)
        text += char(value);
    return text;
}

/// A run-length encoded row of 10 pixels: red 1, green rising, blue 0, exponent 2^0.
std::string encodedRow()
{
    return bytes({2,  2,  0,  10, 128 + 10, 128,     10, 0,       10, 20,       30, 40,
                  50, 60, 70, 80, 90,       128 + 4, 0,  128 + 6, 0,  128 + 10, 129});
}

} // namespace

TEST(Hdr, decodesFlatPixels)
{
    const auto image = read(header(2, 1) + bytes({128, 64, 0, 129, 255, 255, 255, 0}));
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_FLOAT_EQ(image->at(0, 0)[0], 1.0f); // 128 / 256 * 2^(129 - 128)
    EXPECT_FLOAT_EQ(image->at(0, 0)[1], 0.5f);
    EXPECT_FLOAT_EQ(image->at(0, 0)[2], 0.0f);
    EXPECT_FLOAT_EQ(image->at(1, 0)[0], 0.0f) << "exponent 0 is black";
}

TEST(Hdr, decodesRunsAndLiterals)
{
    const auto image = read(header(10, 2) + encodedRow() + encodedRow());
    ASSERT_TRUE(image.ok()) << image.status().message();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 10; ++x) {
            EXPECT_FLOAT_EQ(image->at(x, y)[0], 1.0f);
            EXPECT_FLOAT_EQ(image->at(x, y)[1], float(10 * x) / 128.0f);
            EXPECT_FLOAT_EQ(image->at(x, y)[2], 0.0f);
        }
}

TEST(Hdr, everyTruncationIsRefused)
{
    const std::string whole = header(10, 2) + encodedRow() + encodedRow();
    for (size_t length = 0; length < whole.size(); ++length)
        EXPECT_EQ(int(read(whole.substr(0, length)).status().code()), int(Code::Parse)) << length;
}

TEST(Hdr, runsThatLeaveTheRowAreRefused)
{
    std::string row = encodedRow();
    row[4] = char(128 + 11);
    EXPECT_FALSE(read(header(10, 1) + row + row).ok());
    row[4] = char(0);
    EXPECT_FALSE(read(header(10, 1) + row + row).ok());
}

TEST(Hdr, sizesAreCheckedBeforeMemoryIsTaken)
{
    EXPECT_EQ(int(read(header(100'000, 10)).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(read(header(16'384, 16'384)).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(read(header(4'000, 4'000) + "abc").status().code()), int(Code::Parse))
        << "too short for its size";
}

TEST(Hdr, otherHeadersAreRefused)
{
    for (const char* text : {"", "P6\n", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd",
                             "#?RADIANCE\n\n+X 1 -Y 1\nabcd", "#?RADIANCE\n\n-Y 0 +X 1\nabcd",
                             "#?RADIANCE\n\n-Y -1 +X 1\nabcd", "#?RADIANCE\n\n-Y 99999999999 +X 1\nabcd"})
        EXPECT_FALSE(read(text).ok()) << text;
}
