// Pictures that tools read: PNG by two decoders (fx_assets, fx_image) and Radiance files.
#include "fxsdk/assets/png_reader.h"
#include "rendering/image/image.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/png_repair.h"
#include "tests/presets/small_png.h"

#include <algorithm>

namespace fx::fuzz {

namespace {

void checkImage(const base::Result<image::Image>& image)
{
    if (!image) {
        require(!image.status().message().empty(), "a refused picture has a message");
        return;
    }
    require(image->width >= 1 && image->height >= 1, "a picture has pixels");
    require(image->pixels.size() == size_t(image->width) * size_t(image->height) * size_t(image->channels),
            "a picture has all its values");
}

void checkPng(std::span<const uint8_t> bytes)
{
    checkImage(image::readPng(std::as_bytes(bytes)));
    const auto picture = asset::readPng(bytes);
    if (!picture) {
        require(!picture.status().message().empty(), "a refused texture has a message");
        return;
    }
    require(picture->rgba.size() == size_t(picture->width) * size_t(picture->height) * 4,
            "a texture has all its texels");
}

std::string writtenPng(int width, int height, int channels)
{
    image::Image image{width, height, channels, {}};
    image.pixels.resize(size_t(width) * size_t(height) * size_t(channels));
    for (size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = float(i % 7) / 7.0f;
    const auto bytes = image::writePng(image);
    require(bytes.ok(), "a small picture can be written");
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

/// A PNG of one texel whose header says what the arguments say; its check sums are repaired by the target.
std::string crookedPng(char depth, char colorType, char interlace)
{
    std::string bytes = test::smallPng();
    bytes[24] = depth;
    bytes[25] = colorType;
    bytes[28] = interlace;
    return bytes;
}

} // namespace

/// The first byte chooses the format, and whether check sums are repaired.
void runInput(std::span<const uint8_t> input)
{
    InputReader reader(input);
    const uint8_t format = reader.byte();
    std::vector<uint8_t> bytes(reader.rest().begin(), reader.rest().end());
    if (format == 'r')
        repairPng(bytes);
    if (format == 'h')
        checkImage(image::readHdr(std::as_bytes(std::span<const uint8_t>(bytes))));
    else
        checkPng(bytes);
}

std::vector<std::string> seeds()
{
    std::vector<std::string> all{
        "p" + test::smallPng(),
        "r" + writtenPng(5, 3, 4),
        "r" + writtenPng(17, 2, 3),
        "h#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" +
            std::string("\x80\x40\x20\x81\x10\x10\x10\x80", 8),
        "h#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n" +
            std::string("\x02\x02\x00\x08\x88\x40\x88\x40\x88\x40\x88\x80", 12),
    };
    for (const char colorType : {'\0', '\2', '\3', '\4', '\6'})
        for (const char depth : {'\1', '\10', '\20'})
            all.push_back("r" + crookedPng(depth, colorType, char(colorType & 1)));
    return all;
}

} // namespace fx::fuzz
