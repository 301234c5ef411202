#include "rendering/host_targets/host_copies.h"

#include "rendering/gl/gl_device.h"

namespace fx::render {

namespace {

GLenum depthAttachment(GLenum format)
{
    const bool hasStencil = format == GL_DEPTH24_STENCIL8 || format == GL_DEPTH32F_STENCIL8;
    if (format == GL_R32F)
        return GL_COLOR_ATTACHMENT0;
    return hasStencil ? GL_DEPTH_STENCIL_ATTACHMENT : GL_DEPTH_ATTACHMENT;
}

/// Attaches one texture, or nothing where `texture` is 0, so that no texture of the host is held.
void attach(const GlFunctions& gl, GlFramebuffer& framebuffer, GLenum attachment, uint32_t texture)
{
    gl.NamedFramebufferTexture(framebuffer.name(), attachment, texture, 0);
}

} // namespace

void HostCopies::begin(const HostTargets& targets, const HostTargetFacts& facts)
{
    targets_ = &targets;
    facts_ = facts;
    status_ = {};
    wantsColor_ = wantsDepth_ = false;
}

bool HostCopies::prepare(GlTexture& texture, GLenum format, const char* label)
{
    if (source_.name() == 0) {
        source_ = createFramebuffer(device_);
        destination_ = createFramebuffer(device_);
    }
    const bool fits = texture.name() != 0 && texture.width() == targets_->width &&
                      texture.height() == targets_->height && texture.internalFormat() == format;
    if (fits)
        return true;
    texture = {};
    auto created = GlTexture::create(device_, targets_->width, targets_->height, format, label);
    if (!created) {
        status_ = created.status();
        return false;
    }
    texture = std::move(*created);
    return true;
}

uint32_t HostCopies::color()
{
    wantsColor_ = prepare(color_, GL_RGBA32F, "host color copy");
    return wantsColor_ ? color_.name() : 0;
}

uint32_t HostCopies::depth()
{
    wantsDepth_ = facts_.depthFormat != 0 && prepare(depth_, facts_.depthFormat, "host depth copy");
    return wantsDepth_ ? depth_.name() : 0;
}

void HostCopies::blit(uint32_t from, uint32_t to, GLbitfield what)
{
    const HostTargets& t = *targets_;
    device_.gl.BlitNamedFramebuffer(from, to, t.x, t.y, t.x + t.width, t.y + t.height, 0, 0, t.width,
                                    t.height, what, GL_NEAREST);
}

void HostCopies::copyColor()
{
    const GlFunctions& gl = device_.gl;
    // With the conversion, codes of sRGB formats become light; without it, they stay codes.
    targets_->isDisplay() ? gl.Disable(GL_FRAMEBUFFER_SRGB) : gl.Enable(GL_FRAMEBUFFER_SRGB);
    attach(gl, destination_, GL_COLOR_ATTACHMENT0, color_.name());
    if (targets_->color != 0) {
        attach(gl, source_, GL_COLOR_ATTACHMENT0, targets_->color);
        blit(source_.name(), destination_.name(), GL_COLOR_BUFFER_BIT);
        attach(gl, source_, GL_COLOR_ATTACHMENT0, 0);
    } else {
        const uint32_t from = targets_->framebuffer;
        GLint bound = 0;
        GLint buffer = GL_NONE;
        gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, from);
        gl.GetIntegerv(GL_READ_BUFFER, &buffer);
        gl.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
        const bool isOther = static_cast<GLenum>(buffer) != facts_.drawBuffer;
        if (isOther)
            gl.NamedFramebufferReadBuffer(from, facts_.drawBuffer);
        blit(from, destination_.name(), GL_COLOR_BUFFER_BIT);
        if (isOther)
            gl.NamedFramebufferReadBuffer(from, static_cast<GLenum>(buffer));
    }
    attach(gl, destination_, GL_COLOR_ATTACHMENT0, 0);
}

void HostCopies::copyDepth()
{
    const GlFunctions& gl = device_.gl;
    const GLenum attachment = depthAttachment(facts_.depthFormat);
    const GLbitfield what = attachment == GL_COLOR_ATTACHMENT0 ? GL_COLOR_BUFFER_BIT : GL_DEPTH_BUFFER_BIT;
    attach(gl, destination_, attachment, depth_.name());
    if (facts_.copiedDepth != 0) {
        attach(gl, source_, attachment, facts_.copiedDepth);
        blit(source_.name(), destination_.name(), what);
        attach(gl, source_, attachment, 0);
    } else {
        blit(targets_->framebuffer, destination_.name(), what);
    }
    attach(gl, destination_, attachment, 0);
}

base::Status HostCopies::copy()
{
    if (!status_ || (!wantsColor_ && !wantsDepth_))
        return status_;
    (void)device_.takeError("the host's own calls");
    const GlFunctions& gl = device_.gl;
    const bool hasScissor = gl.IsEnabledi(GL_SCISSOR_TEST, 0) != GL_FALSE;
    if (hasScissor)
        gl.Disablei(GL_SCISSOR_TEST, 0);
    if (wantsColor_)
        copyColor();
    if (wantsDepth_)
        copyDepth();
    if (hasScissor)
        gl.Enablei(GL_SCISSOR_TEST, 0);
    return device_.takeError("copying the host's targets");
}

void HostCopies::release()
{
    color_ = {};
    depth_ = {};
    source_ = {};
    destination_ = {};
}

uint64_t HostCopies::bytes() const
{
    return color_.bytes() + depth_.bytes();
}

} // namespace fx::render
