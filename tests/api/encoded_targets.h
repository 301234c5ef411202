/// @file encoded_targets.h
/// Color and depth targets of all kinds that hosts have, filled and read back as the values that they store,
/// and the picture that they must show.
#pragma once

#include "tests/api/host_target_fixture.h"

#include <string>
#include <vector>

namespace fx::test {

/// A color target.
struct EncodedTarget
{
    std::string name;
    GLuint texture = 0;     ///< for FX_TARGET_TEXTURE; 0: FX_TARGET_FRAMEBUFFER
    GLuint framebuffer = 0; ///< has the color attached
};

/// Depth with a wall in the right half.
struct EncodedDepth
{
    std::string name;
    GLuint texture = 0;           ///< depthTexture, or 0
    GLuint renderbuffer = 0;      ///< attached to the framebuffer, with depthFromFramebuffer; or 0
    bool fromFramebuffer = false; ///< `texture` is attached to the framebuffer, with depthFromFramebuffer
    GLenum attachment = GL_DEPTH_ATTACHMENT;
    GLenum precision = GL_DEPTH_COMPONENT32F; ///< format of equal precision; 0: there is no wall
};

class EncodedTargetTest : public HostTargetTest
{
protected:
    EncodedTargetTest();
    ~EncodedTargetTest() override;

    /// Kinds of color targets: textures and framebuffers, of one and of four samples, and a renderbuffer.
    std::vector<EncodedTarget> targetsOf(GLenum format);
    /// Kinds of depth. @param samples of the color target, 1 or 4: attachments must have equal numbers
    std::vector<EncodedDepth> depthsOf(int samples);

    void store(const EncodedTarget& target, const std::vector<float>& codes); ///< to all samples of a pixel
    std::vector<float> stored(const EncodedTarget& target);                   ///< averages samples
    FxFrameDef frameOf(const EncodedTarget& target, const EncodedDepth& depth, uint32_t encoding);
    void attach(const EncodedTarget& target, const EncodedDepth& depth);

    /// What media do to a pixel: light + share * behind. Found from linear pictures over black and over
    /// white.
    struct Media
    {
        std::vector<float> light; ///< RGBA
        std::vector<float> share; ///< RGBA
        bool touches(size_t pixel) const;
    };
    /// @param precision format of the depth, with a wall; 0: no depth
    Media media(GLenum precision = 0);
    /// The values that a target must store, in double precision.
    std::vector<double> byHand(const Media& media, const std::vector<float>& codes, uint32_t encoding,
                               bool isSrgbFormat, double white) const;

    GLuint staging_ = 0;
    GLuint stagingFramebuffer_ = 0;
    std::vector<GLuint> renderbuffers_;
};

} // namespace fx::test
