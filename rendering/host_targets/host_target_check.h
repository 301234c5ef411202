/// @file host_target_check.h
/// Checks the targets of a frame before drawing. A frame with unsuitable targets is refused.
///
/// Threads: [GL thread]. The check changes no GL state, not even on failure.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame/view_types.h"
#include "rendering/host_targets/host_texture.h"

namespace fx::render {

/// What a frame has to know of its targets.
struct HostTargetFacts
{
    bool colorHasSamples = false; ///< the color texture has several samples
    bool colorIsSrgb = false;     ///< OpenGL decodes the color texture when it is read
    /// Draw buffer 0 of the framebuffer, or 0 without FX_TARGET_FRAMEBUFFER.
    GLenum drawBuffer = 0;
    /// Texture with one sample that holds the depth of the frame from (0, 0); 0: depth has to be copied, or
    /// there is none.
    uint32_t depth = 0;
    /// Texture with the depth that has to be copied; 0: the depth of the framebuffer has to be copied, if
    /// depthFormat is not 0.
    uint32_t copiedDepth = 0;
    GLenum depthFormat = 0; ///< sized internal format of the depth to copy
};

class HostTargetCheck
{
public:
    explicit HostTargetCheck(GlDevice& device) : device_(device), textures_(device) {}

    /// Checks the targets of a request.
    /// @param outFacts receives the facts; undefined on failure
    /// @return InvalidArgument; the message states the member of FrameRequest, the fault and the remedy
    base::Status check(const FrameRequest& request, HostTargetFacts& outFacts);

private:
    /// [pixel] Size of the frame's target. The size is 0 if OpenGL cannot return it, as for a window.
    struct Size
    {
        GLint width = 0;
        GLint height = 0;
    };

    base::Status checkColor(const HostTargets& targets, Size& outSize, HostTargetFacts& outFacts);
    base::Status checkName(uint32_t framebuffer);
    base::Status checkAttachment(const HostTargets& targets, Size& outSize, HostTargetFacts& outFacts);
    base::Status checkDepth(const HostTargets& targets, uint32_t texture, Size drawn,
                            HostTargetFacts& outFacts);
    base::Status checkFramebufferDepth(const HostTargets& targets, Size drawn, HostTargetFacts& outFacts);
    base::Status checkContext(const CameraView& camera);
    GLint drawBuffer(uint32_t framebuffer);

    GlDevice& device_;
    HostTextureCheck textures_;
};

} // namespace fx::render
