#include "rendering/image/image.h"

#include <spng.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>

namespace fx::image {

namespace {

/// Deflate cannot shrink more than 1032 to 1; a header that promises more lies.
constexpr uint64_t kLargestRatio = 1032;

struct FreeContext
{
    void operator()(spng_ctx* context) const { spng_ctx_free(context); }
};
using Context = std::unique_ptr<spng_ctx, FreeContext>;

base::Status failure(base::Code code, const std::string& why)
{
    return {code, "PNG: " + why};
}

base::Status checkSize(const spng_ihdr& header, uint64_t fileBytes)
{
    const uint64_t pixels = uint64_t(header.width) * header.height;
    if (header.width > uint32_t(kLargestSide) || header.height > uint32_t(kLargestSide) ||
        pixels > kMaxPixels)
        return failure(base::Code::TooLarge,
                       std::to_string(header.width) + " x " + std::to_string(header.height) +
                           " pixels; at most 16384 a side and 33554432 in all are read");
    if (pixels * header.bit_depth / 8 > kLargestRatio * fileBytes) // at least one channel
        return failure(base::Code::TooLarge, "the header promises more pixels than the file can hold");
    return {};
}

/// Interleaved RGBA of 8 or 16 bits to linear floats of `channels`.
template <class T>
void toLinear(const std::vector<std::byte>& raw, Image& image)
{
    constexpr size_t kLevels = size_t(1) << (8 * sizeof(T));
    std::vector<float> table(kLevels);
    for (size_t i = 0; i < kLevels; ++i)
        table[i] = srgbToLinear(float(i) / float(kLevels - 1));
    const T* source = reinterpret_cast<const T*>(raw.data());
    const size_t channels = size_t(image.channels);
    for (size_t i = 0; i < image.pixels.size(); i += channels, source += 4) {
        for (size_t k = 0; k < 3; ++k)
            image.pixels[i + k] = table[source[k]];
        if (channels == 4)
            image.pixels[i + 3] = float(source[3]) / float(kLevels - 1);
    }
}

bool hasAlpha(spng_ctx* context, const spng_ihdr& header)
{
    spng_trns transparency{};
    return header.color_type == SPNG_COLOR_TYPE_TRUECOLOR_ALPHA ||
           header.color_type == SPNG_COLOR_TYPE_GRAYSCALE_ALPHA || spng_get_trns(context, &transparency) == 0;
}

} // namespace

base::Result<Image> readPng(std::span<const std::byte> bytes)
{
    const Context context(spng_ctx_new(0));
    if (!context)
        return failure(base::Code::OutOfMemory, "no memory for the decoder");
    spng_set_chunk_limits(context.get(), size_t(1) << 20, size_t(4) << 20);
    spng_ihdr header{};
    int error = spng_set_png_buffer(context.get(), bytes.data(), bytes.size());
    if (error == 0)
        error = spng_get_ihdr(context.get(), &header);
    if (error != 0)
        return failure(base::Code::Parse, spng_strerror(error));
    if (base::Status status = checkSize(header, bytes.size()); !status)
        return status;

    const bool isDeep = header.bit_depth == 16;
    const int format = isDeep ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
    Image image{int(header.width), int(header.height), hasAlpha(context.get(), header) ? 4 : 3, {}};
    const size_t pixels = size_t(header.width) * header.height;
    std::vector<std::byte> raw(pixels * (isDeep ? 8 : 4));
    error = spng_decode_image(context.get(), raw.data(), raw.size(), format, SPNG_DECODE_TRNS);
    if (error != 0)
        return failure(base::Code::Parse, spng_strerror(error));
    image.pixels.resize(pixels * size_t(image.channels));
    if (isDeep)
        toLinear<uint16_t>(raw, image);
    else
        toLinear<uint8_t>(raw, image);
    return image;
}

base::Result<std::vector<std::byte>> writePng(const Image& image)
{
    const bool isLegal =
        image.width > 0 && image.height > 0 && image.width <= kLargestSide && image.height <= kLargestSide &&
        (image.channels == 3 || image.channels == 4) &&
        image.pixels.size() == size_t(image.width) * size_t(image.height) * size_t(image.channels);
    if (!isLegal)
        return failure(base::Code::InvalidArgument,
                       "an image of 1 to 16384 pixels a side with 3 or 4 channels is needed");
    std::vector<uint8_t> raw(image.pixels.size());
    for (size_t i = 0; i < raw.size(); ++i) {
        const float value = image.pixels[i] > 0.0f ? (image.pixels[i] < 1.0f ? image.pixels[i] : 1.0f) : 0.0f;
        raw[i] = uint8_t(std::lround(value * 255.0f));
    }

    const Context context(spng_ctx_new(SPNG_CTX_ENCODER));
    if (!context)
        return failure(base::Code::OutOfMemory, "no memory for the encoder");
    spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
    spng_ihdr header{};
    header.width = uint32_t(image.width);
    header.height = uint32_t(image.height);
    header.bit_depth = 8;
    header.color_type = image.channels == 4 ? SPNG_COLOR_TYPE_TRUECOLOR_ALPHA : SPNG_COLOR_TYPE_TRUECOLOR;
    int error = spng_set_ihdr(context.get(), &header);
    if (error == 0)
        error = spng_encode_image(context.get(), raw.data(), raw.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
    size_t size = 0;
    const std::unique_ptr<void, decltype(&std::free)> buffer(
        error == 0 ? spng_get_png_buffer(context.get(), &size, &error) : nullptr, &std::free);
    if (!buffer)
        return failure(base::Code::Internal, spng_strerror(error));
    const std::byte* begin = static_cast<const std::byte*>(buffer.get());
    return std::vector<std::byte>(begin, begin + size);
}

} // namespace fx::image
