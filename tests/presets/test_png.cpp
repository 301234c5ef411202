#include "rendering/image/image.h"

#include <gtest/gtest.h>

#include <spng.h>

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace fx::image;
using fx::base::Code;

namespace {

Image ramp(int channels)
{
    Image image{256, 3, channels, {}};
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 256; ++x)
            for (int k = 0; k < channels; ++k)
                image.pixels.push_back(float((x + 7 * y + 31 * k) % 256) / 255.0f);
    return image;
}

/// A PNG of 16-bit gray values.
std::vector<std::byte> deepPng(const std::vector<uint16_t>& values)
{
    spng_ctx* context = spng_ctx_new(SPNG_CTX_ENCODER);
    spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
    spng_ihdr header{};
    header.width = uint32_t(values.size());
    header.height = 1;
    header.bit_depth = 16;
    header.color_type = SPNG_COLOR_TYPE_GRAYSCALE;
    spng_set_ihdr(context, &header);
    spng_encode_image(context, values.data(), values.size() * 2, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    size_t size = 0;
    int error = 0;
    void* buffer = spng_get_png_buffer(context, &size, &error);
    const std::byte* begin = static_cast<const std::byte*>(buffer);
    std::vector<std::byte> bytes(begin, begin + size);
    std::free(buffer);
    spng_ctx_free(context);
    return bytes;
}

/// Overwrites width and height in the header, leaving its checksum wrong.
std::vector<std::byte> withSize(std::vector<std::byte> png, uint32_t width, uint32_t height)
{
    for (size_t i = 0; i < 4; ++i) {
        png[16 + i] = std::byte(width >> (24 - 8 * i));
        png[20 + i] = std::byte(height >> (24 - 8 * i));
    }
    // CRC-32 of the chunk's type and data
    uint32_t crc = ~0u;
    for (size_t i = 12; i < 29; ++i) {
        crc ^= uint32_t(png[i]);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1) ? 0xEDB88320u : 0u);
    }
    for (size_t i = 0; i < 4; ++i)
        png[29 + i] = std::byte(~crc >> (24 - 8 * i));
    return png;
}

} // namespace

TEST(Srgb, bothDirectionsAreInverseAndJoinAtTheKnee)
{
    for (int i = 0; i <= 255; ++i) {
        const float value = float(i) / 255.0f;
        EXPECT_NEAR(linearToSrgb(srgbToLinear(value)), value, 2e-6f);
    }
    EXPECT_NEAR(srgbToLinear(0.5f), 0.2140411f, 1e-6f); // IEC 61966-2-1
    EXPECT_FLOAT_EQ(srgbToLinear(0.0f), 0.0f);
    EXPECT_NEAR(srgbToLinear(1.0f), 1.0f, 1e-6f);
}

TEST(Png, everyLevelSurvivesARoundTrip)
{
    for (const int channels : {3, 4}) {
        const Image image = ramp(channels);
        const auto bytes = writePng(image);
        ASSERT_TRUE(bytes.ok());
        const auto again = readPng(*bytes);
        ASSERT_TRUE(again.ok()) << again.status().message();
        ASSERT_EQ(again->channels, channels);
        ASSERT_EQ(again->width, 256);
        ASSERT_EQ(again->height, 3);
        for (size_t i = 0; i < image.pixels.size(); ++i) {
            const bool isAlpha = channels == 4 && i % 4 == 3;
            const float expected = isAlpha ? image.pixels[i] : srgbToLinear(image.pixels[i]);
            ASSERT_NEAR(again->pixels[i], expected, 1e-6f) << i;
        }
    }
}

TEST(Png, valuesOutsideOfTheRangeAreClampedAndNanIsBlack)
{
    const Image image{1,
                      2,
                      3,
                      {-1, 2, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                       0.5f / 255, 0.49f / 255}};
    const auto again = readPng(*writePng(image));
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->pixels[0], 0.0f);
    EXPECT_EQ(again->pixels[1], 1.0f);
    EXPECT_EQ(again->pixels[2], 0.0f);
    EXPECT_EQ(again->pixels[3], 1.0f);
    EXPECT_NEAR(linearToSrgb(again->pixels[4]) * 255, 1, 1e-4f) << "rounded to nearest";
    EXPECT_EQ(again->pixels[5], 0.0f);
}

TEST(Png, sixteenBitsKeepSixteenBits)
{
    const auto image = readPng(deepPng({0, 1, 32768, 65535}));
    ASSERT_TRUE(image.ok()) << image.status().message();
    EXPECT_EQ(image->channels, 3);
    EXPECT_EQ(image->at(0, 0)[0], 0.0f);
    EXPECT_NEAR(image->at(1, 0)[1], 1.0f / 65535 / 12.92f, 1e-10f);
    EXPECT_NEAR(image->at(2, 0)[2], srgbToLinear(32768.0f / 65535), 1e-7f);
    EXPECT_NEAR(image->at(3, 0)[0], 1.0f, 1e-6f);
}

TEST(Png, everyTruncationThatLosesPixelsIsRefused)
{
    constexpr size_t kTrailer = 12 + 4 + 4; // the end chunk, then checksums of the pixels
    const auto bytes = writePng(ramp(3));
    for (size_t length = 0; length + kTrailer < bytes->size(); ++length)
        EXPECT_FALSE(readPng(std::span(*bytes).first(length)).ok()) << length;
}

TEST(Png, sizesAreCheckedBeforeAnythingIsDecoded)
{
    const auto bytes = writePng(ramp(3));
    EXPECT_EQ(int(readPng(withSize(*bytes, 16385, 1)).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(readPng(withSize(*bytes, 1, 20000)).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(readPng(withSize(*bytes, 16384, 16384)).status().code()), int(Code::TooLarge));
    EXPECT_EQ(int(readPng(withSize(*bytes, 5000, 5000)).status().code()), int(Code::TooLarge))
        << "cannot be in the file";
    EXPECT_FALSE(readPng(withSize(*bytes, 0, 10)).ok());
}

TEST(Png, onlyPicturesThatAPngCanHoldAreWritten)
{
    EXPECT_FALSE(writePng(Image{}).ok());
    EXPECT_FALSE(writePng(Image{1, 1, 2, {0, 0}}).ok());
    EXPECT_FALSE(writePng(Image{2, 2, 3, {0, 0, 0}}).ok());
    EXPECT_FALSE(writePng(Image{20000, 1, 3, std::vector<float>(60000)}).ok());
}
