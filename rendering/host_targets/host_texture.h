/// @file host_texture.h
/// Checks whether a frame can read and write a texture of the host, and names fault and remedy.
///
/// Threads: [GL thread]. No GL state is changed.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace fx::render {

class GlDevice;

/// Use of a texture of the host by a frame.
enum class HostUse : uint8_t
{
    Nothing,
    ReadColor, ///< the opaque picture is read from this texture
    DrawColor, ///< and goes back into it
    ReadDepth,
};

/// Properties of a texture that OpenGL provides in a few calls. Textures with equal properties are equally
/// suitable; a texture that was recreated under the same name is detected by different ones.
struct HostTexture
{
    uint32_t name = 0;
    HostUse use = HostUse::Nothing;
    GLint target = 0;
    GLint format = 0; ///< internal format of level 0
    GLint width = 0;  ///< [texel]
    GLint height = 0; ///< [texel]
    GLint baseLevel = 0;
    GLint stencilMode = 0; ///< of ReadDepth
    std::array<GLint, 4> swizzle{};

    bool operator==(const HostTexture&) const = default;
};

/// Caches which textures were accepted, so that a frame like the one before only queries their properties.
class HostTextureCheck
{
public:
    explicit HostTextureCheck(GlDevice& device) : device_(device) {}

    /// @param member  of the frame, "frame.colorTexture", for the message
    /// @param outFacts untouched on failure
    /// @return InvalidArgument with the fault and the remedy
    base::Status check(uint32_t name, HostUse use, const char* member, HostTexture& outFacts);

private:
    HostTexture factsOf(uint32_t name, HostUse use) const;
    bool isDrawable(uint32_t name) const;
    std::string faultOf(const HostTexture& facts) const;
    std::string formatFault(const HostTexture& facts) const;

    GlDevice& device_;
    std::array<HostTexture, 16> good_{}; ///< the textures used last; hosts may alternate between several
    size_t next_ = 0;                    ///< of good_, to be replaced
};

// Names of OpenGL's enumerants, for messages: host_format_names.cpp.

std::string glFormatName(GLenum internalFormat); ///< such as "GL_RGBA8UI"; a number for unknown formats
std::string glTargetName(GLenum target);         ///< "GL_TEXTURE_2D_MULTISAMPLE"; a number otherwise

} // namespace fx::render
