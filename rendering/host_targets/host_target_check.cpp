#include "rendering/host_targets/host_target_check.h"

#include "rendering/gl/gl_device.h"

#include <cstdlib>
#include <string>

namespace fx::render {

namespace {

base::Status refuse(std::string message)
{
    return {base::Code::InvalidArgument, std::move(message)};
}

std::string sizeText(GLint width, GLint height)
{
    return std::to_string(width) + "x" + std::to_string(height);
}

/// Whether the frame lies within what it is drawn to or read from.
base::Status checkRoom(const HostTargets& targets, const char* member, GLint width, GLint height)
{
    const bool isWide = targets.width > width;
    if (!isWide && targets.height <= height)
        return {};
    return refuse(std::string(isWide ? "frame.width" : "frame.height") + " is " +
                  std::to_string(isWide ? targets.width : targets.height) + ", but " + member + " has " +
                  sizeText(width, height) + " pixels: the frame must lie within it");
}

const char* framebufferFault(GLenum status)
{
    switch (status) {
    case GL_FRAMEBUFFER_COMPLETE:
        return nullptr;
    case GL_FRAMEBUFFER_UNDEFINED:
        return "is 0, the window, but this context has none: give a framebuffer object";
    case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
    case GL_FRAMEBUFFER_UNSUPPORTED:
        return "is not complete: this OpenGL cannot draw to an attachment; attach another format, as "
               "GL_RGBA16F";
    case GL_FRAMEBUFFER_INCOMPLETE_MISSING_ATTACHMENT:
        return "is not complete: nothing is attached; attach a color texture";
    case GL_FRAMEBUFFER_INCOMPLETE_MULTISAMPLE:
        return "is not complete: attachments differ in their count of samples; make them equal";
    case GL_FRAMEBUFFER_INCOMPLETE_LAYER_TARGETS:
        return "is not complete: some attachments are layered and some are not; attach single layers";
    default:
        return "is not complete: glCheckNamedFramebufferStatus tells why";
    }
}

} // namespace

base::Status HostTargetCheck::check(const FrameRequest& request)
{
    const HostTargets& targets = request.targets;
    Size drawn;
    if (targets.useFramebuffer) {
        if (base::Status status = checkFramebuffer(targets, drawn); !status)
            return status;
    }
    if (targets.color != 0) {
        if (base::Status status = checkColor(targets, drawn); !status)
            return status;
    }
    if (targets.depth != 0) {
        if (base::Status status = checkDepth(targets, drawn); !status)
            return status;
    }
    HostTexture map;
    if (request.sunShadow.texture != 0)
        if (base::Status status =
                textures_.check(request.sunShadow.texture, HostUse::ReadDepth, "frame.sunShadowTexture", map);
            !status)
            return status;
    return checkContext(request.camera);
}

base::Status HostTargetCheck::checkColor(const HostTargets& targets, Size& outSize)
{
    const HostUse use = targets.useFramebuffer ? HostUse::ReadColor : HostUse::DrawColor;
    HostTexture color;
    if (base::Status status = textures_.check(targets.color, use, "frame.colorTexture", color); !status)
        return status;
    outSize = {color.width, color.height};
    return checkRoom(targets, "frame.colorTexture", color.width, color.height);
}

/// Depth belongs to the pixels of the frame one by one. It may be larger, as textures are that a host
/// allocates once for all its resolutions; depth of the same picture at another resolution is not meant.
base::Status HostTargetCheck::checkDepth(const HostTargets& targets, Size drawn)
{
    HostTexture depth;
    if (base::Status status = textures_.check(targets.depth, HostUse::ReadDepth, "frame.depthTexture", depth);
        !status)
        return status;
    const int64_t w = targets.width, h = targets.height;
    const bool isSmall = depth.width < w || depth.height < h;
    const bool isThatOfTarget = depth.width == drawn.width && depth.height == drawn.height;
    const bool isScaled =
        4 * int64_t(depth.width) >= 5 * w && std::abs(depth.width * h - depth.height * w) < w + h;
    if (!isSmall && (isThatOfTarget || !isScaled))
        return {};
    return refuse("frame.depthTexture has " + sizeText(depth.width, depth.height) +
                  " texels for a frame of " + sizeText(targets.width, targets.height) +
                  " pixels: give depth with one texel for each pixel of the frame");
}

/// A framebuffer's own state, which OpenGL tells of the one that is bound. The host's is bound again.
GLint HostTargetCheck::drawBuffer(uint32_t framebuffer)
{
    const GlFunctions& gl = device_.gl;
    GLint bound = 0;
    GLint buffer = GL_NONE;
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    const bool isBound = static_cast<uint32_t>(bound) == framebuffer;
    if (!isBound)
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.GetIntegerv(GL_DRAW_BUFFER0, &buffer);
    if (!isBound)
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
    return buffer;
}

base::Status HostTargetCheck::checkFramebuffer(const HostTargets& targets, Size& outSize)
{
    const uint32_t framebuffer = targets.framebuffer;
    if (framebuffer != 0 && !device_.gl.IsFramebuffer(framebuffer))
        return refuse("frame.framebuffer is " + std::to_string(framebuffer) +
                      ", which names no framebuffer of this context: give one that has been created or bound "
                      "and is not deleted");
    if (const char* fault =
            framebufferFault(device_.gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER)))
        return refuse(std::string("frame.framebuffer ") + fault);
    return checkAttachment(targets, outSize);
}

base::Status HostTargetCheck::checkAttachment(const HostTargets& targets, Size& outSize)
{
    const GlFunctions& gl = device_.gl;
    const uint32_t framebuffer = targets.framebuffer;
    const GLint buffer = drawBuffer(framebuffer);
    if (buffer == GL_NONE)
        return refuse(
            "frame.framebuffer has GL_NONE as its draw buffer 0: name the color attachment to draw to "
            "(glNamedFramebufferDrawBuffer)");
    if (framebuffer == 0)
        return {};
    const auto ask = [&](GLenum what) {
        GLint value = 0;
        gl.GetNamedFramebufferAttachmentParameteriv(framebuffer, static_cast<GLenum>(buffer), what, &value);
        return value;
    };
    const GLint type = ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
    if (type == GL_NONE)
        return refuse("frame.framebuffer has nothing attached where its draw buffer 0 points: attach a color "
                      "texture there");
    const auto object = static_cast<GLuint>(ask(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
    const bool isRenderbuffer = type == GL_RENDERBUFFER;
    const GLint level = isRenderbuffer ? 0 : ask(GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL);
    // Not GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE, which NVIDIA's driver refuses to tell of formats with
    // _SNORM.
    GLint component = GL_NONE;
    if (isRenderbuffer) {
        GLint format = GL_NONE;
        gl.GetNamedRenderbufferParameteriv(object, GL_RENDERBUFFER_INTERNAL_FORMAT, &format);
        gl.GetInternalformativ(GL_RENDERBUFFER, static_cast<GLenum>(format), GL_INTERNALFORMAT_RED_TYPE, 1,
                               &component);
    } else {
        gl.GetTextureLevelParameteriv(object, level, GL_TEXTURE_RED_TYPE, &component);
    }
    if (component == GL_INT || component == GL_UNSIGNED_INT)
        return refuse("frame.framebuffer has integers attached as color, not light: attach GL_RGBA16F");
    if (ask(GL_FRAMEBUFFER_ATTACHMENT_GREEN_SIZE) == 0 || ask(GL_FRAMEBUFFER_ATTACHMENT_BLUE_SIZE) == 0)
        return refuse(
            "frame.framebuffer has a color attachment that lacks one of red, green and blue: attach "
            "GL_RGBA16F");
    if (isRenderbuffer) {
        gl.GetNamedRenderbufferParameteriv(object, GL_RENDERBUFFER_WIDTH, &outSize.width);
        gl.GetNamedRenderbufferParameteriv(object, GL_RENDERBUFFER_HEIGHT, &outSize.height);
    } else {
        if (ask(GL_FRAMEBUFFER_ATTACHMENT_LAYERED) != 0)
            return refuse(
                "frame.framebuffer is layered and only its first layer would be drawn to: attach one "
                "layer at a time (glNamedFramebufferTextureLayer)");
        gl.GetTextureLevelParameteriv(object, level, GL_TEXTURE_WIDTH, &outSize.width);
        gl.GetTextureLevelParameteriv(object, level, GL_TEXTURE_HEIGHT, &outSize.height);
    }
    return checkRoom(targets, "the color attachment of frame.framebuffer", outSize.width, outSize.height);
}

/// States of the context that affect draws and that a frame does not change. The origin of clip control: rays
/// follow what the frame says of it; its depth mode does not matter. Transform feedback: it holds the host's
/// program in use.
base::Status HostTargetCheck::checkContext(const CameraView& camera)
{
    GLint origin = GL_LOWER_LEFT;
    device_.gl.GetIntegerv(GL_CLIP_ORIGIN, &origin);
    if (camera.upperLeftOrigin != (origin == GL_UPPER_LEFT))
        return refuse(
            camera.upperLeftOrigin
                ? "frame.upperLeftOrigin is 1, but glClipControl says GL_LOWER_LEFT: make them agree"
                : "frame.upperLeftOrigin is 0, but glClipControl says GL_UPPER_LEFT: make them agree");
    GLint isActive = GL_FALSE;
    GLint isPaused = GL_FALSE;
    device_.gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_ACTIVE, &isActive);
    if (isActive)
        device_.gl.GetIntegerv(GL_TRANSFORM_FEEDBACK_PAUSED, &isPaused);
    if (isActive && !isPaused)
        return refuse("frame: the host's transform feedback is active: end or pause it");
    return {};
}

} // namespace fx::render
