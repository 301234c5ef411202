#include "fxsdk/assets/stb_png.h"

#include "foundation/assets/asset_table.h"

#include <cstdlib>
#include <memory>
#include <string>

namespace {

/// stb_image allocates without a context argument, so the limit of a call is thread-local.
thread_local size_t mostBlockBytes = 0;

void* limitedRealloc(void* block, size_t bytes)
{
    return bytes <= mostBlockBytes ? std::realloc(block, bytes) : nullptr;
}

} // namespace

#define STBI_MALLOC(bytes) limitedRealloc(nullptr, bytes)
#define STBI_REALLOC(block, bytes) limitedRealloc(block, bytes)
#define STBI_FREE(block) std::free(block)
#define STBI_MAX_DIMENSIONS 8192
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

namespace fx::asset {

namespace {

constexpr int kChannels = 4;
static_assert(base::AssetTable::kLargestSide <= STBI_MAX_DIMENSIONS);

struct FreePicture
{
    void operator()(void* texels) const { stbi_image_free(texels); }
};

} // namespace

base::Result<std::vector<uint8_t>> unpackPng(std::span<const uint8_t> file, bool isDeep, int width,
                                             int height, size_t mostBytes)
{
    mostBlockBytes = mostBytes;
    stbi__g_failure_reason = nullptr; // some failures set none, and that of another file would be named
    const auto size = int(file.size());
    int w = 0, h = 0, channels = 0;
    const std::unique_ptr<void, FreePicture> picture(
        isDeep ? static_cast<void*>(stbi_load_16_from_memory(file.data(), size, &w, &h, &channels, kChannels))
               : static_cast<void*>(stbi_load_from_memory(file.data(), size, &w, &h, &channels, kChannels)));
    if (!picture || w != width || h != height) {
        const char* why = picture ? "its size has changed" : stbi_failure_reason();
        if (!why)
            why = "its data are damaged";
        return base::Status(base::Code::Parse, std::string("PNG: it cannot be unpacked: ") + why);
    }
    const size_t count = size_t(width) * size_t(height) * kChannels;
    if (!isDeep) {
        const auto* texels = static_cast<const uint8_t*>(picture.get());
        return std::vector<uint8_t>(texels, texels + count);
    }
    const auto* texels = static_cast<const uint16_t*>(picture.get());
    std::vector<uint8_t> rgba(count);
    for (size_t i = 0; i < count; ++i)
        rgba[i] = uint8_t((uint32_t(texels[i]) * 255 + 32767) / 65535);
    return rgba;
}

} // namespace fx::asset
