/// @file host_texture.h
/// Checks whether a frame can read and write a texture of the host. Messages state the fault and the remedy.
///
/// Threads: [GL thread]. The check changes no GL state.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace fx::render {

class GlDevice;

/// Use of a host texture in a frame.
enum class HostUse : uint8_t
{
    Nothing,
    ReadColor, ///< the opaque picture is read from this texture
    DrawColor, ///< the picture is read from this texture and drawn into it
    ReadDepth,
    ReadShadow, ///< depth of a shadow map; one sample only
};

/// True if depth is read.
constexpr bool isDepth(HostUse use)
{
    return use == HostUse::ReadDepth || use == HostUse::ReadShadow;
}

/// Target of a texture, such as GL_TEXTURE_2D. Mesa answers the query GL_TEXTURE_TARGET in core profiles
/// only; in other contexts the texture is bound on trial, and the host's texture is bound again. A texture of
/// the kinds that frames use causes no OpenGL error thereby. A debug callback of the host receives the errors
/// of other textures, which the frame refuses anyway.
/// @param name an existing texture
/// @return GL_NONE if the texture has none of the targets that a frame can use or name
GLint textureTargetOf(const GlDevice& device, uint32_t name);

/// Properties of a texture that can be queried from OpenGL in a few calls. The result of the check depends
/// only on these properties. So the result is still valid if the host has replaced the texture by a new
/// texture with equal name and properties.
struct HostTexture
{
    uint32_t name = 0;
    HostUse use = HostUse::Nothing;
    GLint target = 0;
    GLint format = 0; ///< internal format of level 0
    GLint width = 0;  ///< [texel]
    GLint height = 0; ///< [texel]
    GLint baseLevel = 0;
    GLint stencilMode = 0; ///< used only for depth
    std::array<GLint, 4> swizzle{};

    bool hasSamples() const { return target == GL_TEXTURE_2D_MULTISAMPLE; }
    /// True if OpenGL decodes the codes of this texture when it is read.
    bool isSrgb() const { return format == GL_SRGB8 || format == GL_SRGB8_ALPHA8; }

    bool operator==(const HostTexture&) const = default;
};

/// Caches the properties of accepted textures. If a frame has the same textures as the previous frame, only
/// their properties are queried.
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
    /// The most recently accepted textures. Several textures are stored, because hosts may alternate between
    /// textures.
    std::array<HostTexture, 16> good_{};
    size_t next_ = 0; ///< index in good_ of the entry that is replaced next
};

// Names of OpenGL enumerants for messages, implemented in host_format_names.cpp.

/// Returns the name of the format, such as "GL_RGBA8UI". For unknown formats, returns the number as text.
std::string glFormatName(GLenum internalFormat);
/// Returns the name of the target, such as "GL_TEXTURE_2D_MULTISAMPLE". For unknown targets, returns the
/// number as text.
std::string glTargetName(GLenum target);

} // namespace fx::render
