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
    const bool isWide = targets.width > width - targets.x;
    if (!isWide && targets.height <= height - targets.y)
        return {};
    const int start = isWide ? targets.x : targets.y;
    return refuse(
        std::string(isWide ? "frame.width" : "frame.height") + " is " +
        std::to_string(isWide ? targets.width : targets.height) +
        (start > 0 ? std::string(" from ") + (isWide ? "viewportX " : "viewportY ") + std::to_string(start)
                   : std::string()) +
        ", but " + member + " has " + sizeText(width, height) + " pixels: the frame must lie within it");
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

/// The sized format of a depth image. Hosts may have specified it by an unsized one.
GLenum sizedDepthFormat(GLenum format, GLint bits, bool isFloat, bool hasStencil)
{
    switch (format) {
    case GL_DEPTH_COMPONENT16:
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32:
    case GL_DEPTH_COMPONENT32F:
    case GL_DEPTH24_STENCIL8:
    case GL_DEPTH32F_STENCIL8:
        return format;
    default:
        break;
    }
    if (isFloat)
        return hasStencil ? GL_DEPTH32F_STENCIL8 : GL_DEPTH_COMPONENT32F;
    if (hasStencil)
        return GL_DEPTH24_STENCIL8;
    return bits <= 16 ? GL_DEPTH_COMPONENT16 : bits <= 24 ? GL_DEPTH_COMPONENT24 : GL_DEPTH_COMPONENT32;
}

} // namespace

base::Status HostTargetCheck::check(const FrameRequest& request, HostTargetFacts& outFacts)
{
    const HostTargets& targets = request.targets;
    outFacts = {};
    Size drawn;
    if (targets.useFramebuffer || targets.depthFromFramebuffer) {
        if (base::Status status = checkName(targets.framebuffer); !status)
            return status;
    }
    if (targets.useFramebuffer) {
        if (base::Status status = checkAttachment(targets, drawn, outFacts); !status)
            return status;
    }
    if (targets.color != 0) {
        if (base::Status status = checkColor(targets, drawn, outFacts); !status)
            return status;
    }
    if (targets.depth != 0) {
        if (base::Status status = checkDepth(targets, targets.depth, drawn, outFacts); !status)
            return status;
    }
    if (targets.depthFromFramebuffer) {
        if (base::Status status = checkFramebufferDepth(targets, drawn, outFacts); !status)
            return status;
    }
    HostTexture map;
    if (request.sunShadow.texture != 0)
        if (base::Status status = textures_.check(request.sunShadow.texture, HostUse::ReadShadow,
                                                  "frame.sunShadowTexture", map);
            !status)
            return status;
    return checkContext(request.camera);
}

base::Status HostTargetCheck::checkColor(const HostTargets& targets, Size& outSize, HostTargetFacts& outFacts)
{
    const HostUse use = targets.useFramebuffer ? HostUse::ReadColor : HostUse::DrawColor;
    HostTexture color;
    if (base::Status status = textures_.check(targets.color, use, "frame.colorTexture", color); !status)
        return status;
    outSize = {color.width, color.height};
    outFacts.colorHasSamples = color.hasSamples();
    outFacts.colorIsSrgb = color.isSrgb();
    if (color.isSrgb() && targets.encoding == TargetEncoding::DisplayGamma)
        return refuse("frame.colorTexture has the format " + glFormatName(static_cast<GLenum>(color.format)) +
                      ", whose codes are those of sRGB: set frame.targetEncoding to FX_TARGET_DISPLAY_SRGB");
    return checkRoom(targets, "frame.colorTexture", color.width, color.height);
}

/// Depth belongs to the pixels of the frame one by one. It may be larger, as textures are that a host
/// allocates once for all its resolutions; depth of the same picture at another resolution is not meant.
base::Status HostTargetCheck::checkDepth(const HostTargets& targets, uint32_t texture, Size drawn,
                                         HostTargetFacts& outFacts)
{
    HostTexture depth;
    if (base::Status status = textures_.check(texture, HostUse::ReadDepth, "frame.depthTexture", depth);
        !status)
        return status;
    const bool isMoved = targets.x != 0 || targets.y != 0;
    if (isMoved || depth.hasSamples()) {
        outFacts.copiedDepth = texture;
        outFacts.depthFormat = static_cast<GLenum>(depth.format);
    } else {
        outFacts.depth = texture;
    }
    const int64_t w = targets.width, h = targets.height;
    const bool isSmall = depth.width < targets.x + w || depth.height < targets.y + h;
    const bool isThatOfTarget = depth.width == drawn.width && depth.height == drawn.height;
    const bool isScaled =
        4 * int64_t(depth.width) >= 5 * w && std::abs(depth.width * h - depth.height * w) < w + h;
    if (!isSmall && (isThatOfTarget || isMoved || !isScaled))
        return {};
    return refuse("frame.depthTexture has " + sizeText(depth.width, depth.height) +
                  " texels for a frame of " + sizeText(targets.width, targets.height) +
                  " pixels: give depth with one texel for each pixel of the frame");
}

/// A texture of one sample is read where it is; all others are copied, which needs an equal format.
base::Status HostTargetCheck::checkFramebufferDepth(const HostTargets& targets, Size drawn,
                                                    HostTargetFacts& outFacts)
{
    const GlFunctions& gl = device_.gl;
    const uint32_t framebuffer = targets.framebuffer;
    const auto ask = [&](GLenum attachment, GLenum what) {
        GLint value = 0;
        gl.GetNamedFramebufferAttachmentParameteriv(framebuffer, attachment, what, &value);
        return value;
    };
    const GLenum depth = framebuffer == 0 ? GL_DEPTH : GL_DEPTH_ATTACHMENT;
    const GLint type = ask(depth, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE);
    const GLint bits = type == GL_NONE ? 0 : ask(depth, GL_FRAMEBUFFER_ATTACHMENT_DEPTH_SIZE);
    if (bits == 0)
        return refuse("frame.depthFromFramebuffer is 1, but frame.framebuffer has no depth: attach a depth "
                      "texture or renderbuffer, or set it to 0");
    GLint format = GL_NONE;
    bool hasStencil = false;
    if (type == GL_TEXTURE || type == GL_RENDERBUFFER) {
        const auto object = static_cast<GLuint>(ask(depth, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME));
        GLint stencilBits = 0;
        if (type == GL_TEXTURE) {
            const GLint level = ask(depth, GL_FRAMEBUFFER_ATTACHMENT_TEXTURE_LEVEL);
            const GLint target = textureTargetOf(device_, object);
            const bool isPlain = target == GL_TEXTURE_2D && level == 0 && targets.x == 0 && targets.y == 0;
            if (isPlain && checkDepth(targets, object, drawn, outFacts))
                return {};
            outFacts.depth = 0;
            gl.GetTextureLevelParameteriv(object, level, GL_TEXTURE_INTERNAL_FORMAT, &format);
            gl.GetTextureLevelParameteriv(object, level, GL_TEXTURE_STENCIL_SIZE, &stencilBits);
        } else {
            gl.GetNamedRenderbufferParameteriv(object, GL_RENDERBUFFER_INTERNAL_FORMAT, &format);
            gl.GetNamedRenderbufferParameteriv(object, GL_RENDERBUFFER_STENCIL_SIZE, &stencilBits);
        }
        hasStencil = stencilBits > 0;
    } else {
        hasStencil = ask(GL_STENCIL, GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_NONE &&
                     ask(GL_STENCIL, GL_FRAMEBUFFER_ATTACHMENT_STENCIL_SIZE) > 0;
    }
    const bool isFloat = ask(depth, GL_FRAMEBUFFER_ATTACHMENT_COMPONENT_TYPE) == GL_FLOAT;
    outFacts.depthFormat = sizedDepthFormat(static_cast<GLenum>(format), bits, isFloat, hasStencil);
    return {};
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

base::Status HostTargetCheck::checkName(uint32_t framebuffer)
{
    if (framebuffer != 0 && !device_.gl.IsFramebuffer(framebuffer))
        return refuse("frame.framebuffer is " + std::to_string(framebuffer) +
                      ", which names no framebuffer of this context: give one that has been created or bound "
                      "and is not deleted");
    if (const char* fault =
            framebufferFault(device_.gl.CheckNamedFramebufferStatus(framebuffer, GL_DRAW_FRAMEBUFFER)))
        return refuse(std::string("frame.framebuffer ") + fault);
    return {};
}

base::Status HostTargetCheck::checkAttachment(const HostTargets& targets, Size& outSize,
                                              HostTargetFacts& outFacts)
{
    const GlFunctions& gl = device_.gl;
    const uint32_t framebuffer = targets.framebuffer;
    const GLint buffer = drawBuffer(framebuffer);
    if (buffer == GL_NONE)
        return refuse(
            "frame.framebuffer has GL_NONE as its draw buffer 0: name the color attachment to draw to "
            "(glNamedFramebufferDrawBuffer)");
    outFacts.drawBuffer = static_cast<GLenum>(buffer);
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
