#include "rendering/gl/gl_framebuffer_cache.h"

#include <algorithm>
#include <string>

namespace fx::render {

namespace {

constexpr uint64_t kFramesKept = 16;

const char* reason(GLenum framebufferStatus)
{
    switch (framebufferStatus) {
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
        return "an attachment is not a renderable texture";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "nothing is attached";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "attachments differ in sample count";
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "the driver does not support this combination of formats";
    default:
        return "incomplete";
    }
}

} // namespace

void GlFramebufferCache::beginFrame()
{
    ++frame_;
    std::erase_if(entries_, [this](const Entry& entry) { return frame_ - entry.usedFrame > kFramesKept; });
}

base::Result<uint32_t> GlFramebufferCache::find(const GlAttachments& attachments, bool foreign)
{
    auto entry = std::find_if(entries_.begin(), entries_.end(),
                              [&](const Entry& candidate) { return candidate.attachments == attachments; });
    if (entry == entries_.end()) {
        entries_.push_back({attachments, createFramebuffer(device_), 0, frame_});
        entry = entries_.end() - 1;
    }
    entry->usedFrame = frame_;
    const bool attached = entry->attachedFrame != 0 && (!foreign || entry->attachedFrame == frame_);
    if (!attached) {
        if (base::Status status = attach(*entry); !status) {
            entries_.erase(entry);
            return status;
        }
        entry->attachedFrame = frame_;
    }
    return entry->framebuffer.name();
}

base::Status GlFramebufferCache::attach(const Entry& entry)
{
    const GlFunctions& gl = device_.gl;
    const uint32_t framebuffer = entry.framebuffer.name();
    const GlAttachments& attachments = entry.attachments;
    std::array<GLenum, 8> drawBuffers{};
    for (uint32_t i = 0; i < attachments.colorCount; ++i) {
        drawBuffers[i] = attachments.colors[i] ? GL_COLOR_ATTACHMENT0 + i : GLenum(GL_NONE);
        if (!attachments.colors[i])
            continue;
        gl.NamedFramebufferTexture(framebuffer, drawBuffers[i], attachments.colors[i], 0);
    }
    if (attachments.depth)
        gl.NamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, attachments.depth, 0);
    gl.NamedFramebufferDrawBuffers(framebuffer, static_cast<GLsizei>(attachments.colorCount),
                                   drawBuffers.data());
    const GLenum state = gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER);
    if (state == GL_FRAMEBUFFER_COMPLETE)
        return {};
    return {base::Code::GlFailed, "framebuffer of " + std::to_string(attachments.colorCount) +
                                      " color targets: " + reason(state) + " (status " +
                                      std::to_string(state) + ")"};
}

void GlFramebufferCache::forget(uint32_t texture)
{
    std::erase_if(entries_, [&](const Entry& entry) {
        const auto& colors = entry.attachments.colors;
        return entry.attachments.depth == texture ||
               std::find(colors.begin(), colors.end(), texture) != colors.end();
    });
}

} // namespace fx::render
