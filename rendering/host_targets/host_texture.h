/// @file host_texture.h
/// Checks whether a frame can read and write a texture of the host. Messages state the fault and the remedy.
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

/// Use of a texture of the host in a frame.
enum class HostUse : uint8_t
{
    Nothing,
    ReadColor, ///< the opaque picture is read from this texture
    DrawColor, ///< the picture is read from this texture and drawn into it
    ReadDepth,
};

/// Properties of a texture that can be queried from OpenGL in a few calls. Equal properties mean that the
/// result of the check is equal, also if the host has deleted a texture and created another with the same
/// name.
struct HostTexture
{
    uint32_t name = 0;
    HostUse use = HostUse::Nothing;
    GLint target = 0;
    GLint format = 0; ///< internal format of level 0
    GLint width = 0;  ///< [texel]
    GLint height = 0; ///< [texel]
    GLint baseLevel = 0;
    GLint stencilMode = 0; ///< used only for ReadDepth
    std::array<GLint, 4> swizzle{};

    bool operator==(const HostTexture&) const = default;
};

/// Caches the properties of accepted textures, so that a frame with the same textures as the previous one
/// only queries their properties.
class HostTextureCheck
{
public:
    explicit HostTextureCheck(GlDevice& device) : device_(device) {}

    /// Checks a texture.
    /// @param member name of the frame's member for the message, such as "frame.colorTexture"
    /// @param outFacts receives the properties; not changed on failure
    /// @return InvalidArgument with the fault and the remedy
    base::Status check(uint32_t name, HostUse use, const char* member, HostTexture& outFacts);

private:
    HostTexture factsOf(uint32_t name, HostUse use) const;
    bool isDrawable(uint32_t name) const;
    std::string faultOf(const HostTexture& facts) const;
    std::string formatFault(const HostTexture& facts) const;

    GlDevice& device_;
    /// The textures that were accepted last; there are several, because hosts may alternate between them.
    std::array<HostTexture, 16> good_{};
    size_t next_ = 0; ///< index in good_ of the entry that is replaced next
};

// Names of OpenGL's enumerants, for messages: host_format_names.cpp.

/// Name of the format, such as "GL_RGBA8UI"; the number as text for unknown formats.
std::string glFormatName(GLenum internalFormat);
/// Name of the target, such as "GL_TEXTURE_2D_MULTISAMPLE"; the number as text for unknown targets.
std::string glTargetName(GLenum target);

} // namespace fx::render
