#include "rendering/host_targets/host_texture.h"

#include <algorithm>
#include <cstdio>
#include <span>

namespace fx::render {

namespace {

struct Named
{
    GLenum value;
    const char* name;
};

#define FX_NAMED(name)                                                                                       \
    {                                                                                                        \
        name, #name                                                                                          \
    }

constexpr Named kFormats[] = {
    FX_NAMED(GL_RED),
    FX_NAMED(GL_RG),
    FX_NAMED(GL_RGB),
    FX_NAMED(GL_RGBA),
    FX_NAMED(GL_DEPTH_COMPONENT),
    FX_NAMED(GL_DEPTH_STENCIL),
    FX_NAMED(GL_STENCIL_INDEX8),
    FX_NAMED(GL_R8),
    FX_NAMED(GL_R8_SNORM),
    FX_NAMED(GL_R16),
    FX_NAMED(GL_R16_SNORM),
    FX_NAMED(GL_RG8),
    FX_NAMED(GL_RG8_SNORM),
    FX_NAMED(GL_RG16),
    FX_NAMED(GL_RG16_SNORM),
    FX_NAMED(GL_R3_G3_B2),
    FX_NAMED(GL_RGB4),
    FX_NAMED(GL_RGB5),
    FX_NAMED(GL_RGB565),
    FX_NAMED(GL_RGB8),
    FX_NAMED(GL_RGB8_SNORM),
    FX_NAMED(GL_RGB10),
    FX_NAMED(GL_RGB12),
    FX_NAMED(GL_RGB16),
    FX_NAMED(GL_RGB16_SNORM),
    FX_NAMED(GL_RGBA2),
    FX_NAMED(GL_RGBA4),
    FX_NAMED(GL_RGB5_A1),
    FX_NAMED(GL_RGBA8),
    FX_NAMED(GL_RGBA8_SNORM),
    FX_NAMED(GL_RGB10_A2),
    FX_NAMED(GL_RGB10_A2UI),
    FX_NAMED(GL_RGBA12),
    FX_NAMED(GL_RGBA16),
    FX_NAMED(GL_RGBA16_SNORM),
    FX_NAMED(GL_SRGB8),
    FX_NAMED(GL_SRGB8_ALPHA8),
    FX_NAMED(GL_SRGB),
    FX_NAMED(GL_SRGB_ALPHA),
    FX_NAMED(GL_R16F),
    FX_NAMED(GL_RG16F),
    FX_NAMED(GL_RGB16F),
    FX_NAMED(GL_RGBA16F),
    FX_NAMED(GL_R32F),
    FX_NAMED(GL_RG32F),
    FX_NAMED(GL_RGB32F),
    FX_NAMED(GL_RGBA32F),
    FX_NAMED(GL_R11F_G11F_B10F),
    FX_NAMED(GL_RGB9_E5),
    FX_NAMED(GL_R8I),
    FX_NAMED(GL_R8UI),
    FX_NAMED(GL_R16I),
    FX_NAMED(GL_R16UI),
    FX_NAMED(GL_R32I),
    FX_NAMED(GL_R32UI),
    FX_NAMED(GL_RG8I),
    FX_NAMED(GL_RG8UI),
    FX_NAMED(GL_RG16I),
    FX_NAMED(GL_RG16UI),
    FX_NAMED(GL_RG32I),
    FX_NAMED(GL_RG32UI),
    FX_NAMED(GL_RGB8I),
    FX_NAMED(GL_RGB8UI),
    FX_NAMED(GL_RGB16I),
    FX_NAMED(GL_RGB16UI),
    FX_NAMED(GL_RGB32I),
    FX_NAMED(GL_RGB32UI),
    FX_NAMED(GL_RGBA8I),
    FX_NAMED(GL_RGBA8UI),
    FX_NAMED(GL_RGBA16I),
    FX_NAMED(GL_RGBA16UI),
    FX_NAMED(GL_RGBA32I),
    FX_NAMED(GL_RGBA32UI),
    FX_NAMED(GL_DEPTH_COMPONENT16),
    FX_NAMED(GL_DEPTH_COMPONENT24),
    FX_NAMED(GL_DEPTH_COMPONENT32),
    FX_NAMED(GL_DEPTH_COMPONENT32F),
    FX_NAMED(GL_DEPTH24_STENCIL8),
    FX_NAMED(GL_DEPTH32F_STENCIL8),
    FX_NAMED(GL_COMPRESSED_RED),
    FX_NAMED(GL_COMPRESSED_RG),
    FX_NAMED(GL_COMPRESSED_RGB),
    FX_NAMED(GL_COMPRESSED_RGBA),
    FX_NAMED(GL_COMPRESSED_SRGB),
    FX_NAMED(GL_COMPRESSED_SRGB_ALPHA),
    FX_NAMED(GL_COMPRESSED_RED_RGTC1),
    FX_NAMED(GL_COMPRESSED_SIGNED_RED_RGTC1),
    FX_NAMED(GL_COMPRESSED_RG_RGTC2),
    FX_NAMED(GL_COMPRESSED_SIGNED_RG_RGTC2),
    FX_NAMED(GL_COMPRESSED_RGBA_BPTC_UNORM),
    FX_NAMED(GL_COMPRESSED_SRGB_ALPHA_BPTC_UNORM),
    FX_NAMED(GL_COMPRESSED_RGB_BPTC_SIGNED_FLOAT),
    FX_NAMED(GL_COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT),
    FX_NAMED(GL_COMPRESSED_RGB8_ETC2),
    FX_NAMED(GL_COMPRESSED_SRGB8_ETC2),
    FX_NAMED(GL_COMPRESSED_RGBA8_ETC2_EAC),
    FX_NAMED(GL_COMPRESSED_SRGB8_ALPHA8_ETC2_EAC),
};

constexpr Named kTargets[] = {
    FX_NAMED(GL_TEXTURE_1D),
    FX_NAMED(GL_TEXTURE_2D),
    FX_NAMED(GL_TEXTURE_3D),
    FX_NAMED(GL_TEXTURE_1D_ARRAY),
    FX_NAMED(GL_TEXTURE_2D_ARRAY),
    FX_NAMED(GL_TEXTURE_RECTANGLE),
    FX_NAMED(GL_TEXTURE_CUBE_MAP),
    FX_NAMED(GL_TEXTURE_CUBE_MAP_ARRAY),
    FX_NAMED(GL_TEXTURE_BUFFER),
    FX_NAMED(GL_TEXTURE_2D_MULTISAMPLE),
    FX_NAMED(GL_TEXTURE_2D_MULTISAMPLE_ARRAY),
};

#undef FX_NAMED

std::string nameOf(GLenum value, std::span<const Named> known)
{
    const auto found = std::find_if(known.begin(), known.end(),
                                    [value](const Named& named) { return named.value == value; });
    if (found != known.end())
        return found->name;
    char number[16];
    std::snprintf(number, sizeof number, "0x%04X", value);
    return number;
}

} // namespace

std::string glFormatName(GLenum internalFormat)
{
    return nameOf(internalFormat, kFormats);
}

std::string glTargetName(GLenum target)
{
    return nameOf(target, kTargets);
}

} // namespace fx::render
