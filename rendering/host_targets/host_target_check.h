/// @file host_target_check.h
/// Checks the targets of a frame before drawing. A frame with unsuitable targets is refused.
///
/// Threads: [GL thread]. The check changes no GL state, not even on failure.
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame/view_types.h"
#include "rendering/host_targets/host_texture.h"

namespace fx::render {

class HostTargetCheck
{
public:
    explicit HostTargetCheck(GlDevice& device) : device_(device), textures_(device) {}

    /// Checks the targets of a request.
    /// @return InvalidArgument; the message states the member of FrameRequest, the fault and the remedy
    base::Status check(const FrameRequest& request);

private:
    /// [pixel] Size of the frame's target. The size is 0 if OpenGL cannot return it, as for a window.
    struct Size
    {
        GLint width = 0;
        GLint height = 0;
    };

    base::Status checkColor(const HostTargets& targets, Size& outSize);
    base::Status checkFramebuffer(const HostTargets& targets, Size& outSize);
    base::Status checkAttachment(const HostTargets& targets, Size& outSize);
    base::Status checkDepth(const HostTargets& targets, Size drawn);
    base::Status checkContext(const CameraView& camera);
    GLint drawBuffer(uint32_t framebuffer);

    GlDevice& device_;
    HostTextureCheck textures_;
};

} // namespace fx::render
