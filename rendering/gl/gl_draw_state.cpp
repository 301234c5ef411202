#include "rendering/gl/gl_draw_state.h"

#include "rendering/gl/gl_state_guard.h"

namespace fx::render {

namespace {

/// Switches that could discard, move or alter fragments; off in all passes.
constexpr GLenum kOff[] = {
    GL_CULL_FACE,
    GL_DEPTH_TEST,
    GL_STENCIL_TEST,
    GL_DEPTH_CLAMP,
    GL_RASTERIZER_DISCARD,
    GL_PRIMITIVE_RESTART,
    GL_PRIMITIVE_RESTART_FIXED_INDEX,
    GL_COLOR_LOGIC_OP,
    GL_DITHER,
    GL_POLYGON_OFFSET_FILL,
    GL_POLYGON_SMOOTH,
    GL_SAMPLE_MASK,
    GL_SAMPLE_ALPHA_TO_COVERAGE,
    GL_SAMPLE_ALPHA_TO_ONE,
    GL_SAMPLE_COVERAGE,
    GL_SAMPLE_SHADING,
    GL_CLIP_DISTANCE0,
    GL_CLIP_DISTANCE1,
    GL_CLIP_DISTANCE2,
    GL_CLIP_DISTANCE3,
    GL_CLIP_DISTANCE4,
    GL_CLIP_DISTANCE5,
    GL_CLIP_DISTANCE6,
    GL_CLIP_DISTANCE7,
};

} // namespace

GlDrawState::GlDrawState(GlDevice& device)
    : device_(device),
      vertexArray_(createVertexArray(device)), samplers_{createSampler(device, Sampling::Nearest),
                                                         createSampler(device, Sampling::Linear),
                                                         createSampler(device, Sampling::LinearRepeat),
                                                         createSampler(device, Sampling::Trilinear),
                                                         createSampler(device, Sampling::TrilinearRepeat)}
{}

void GlDrawState::reset(bool encodeSrgb, bool keepScissor)
{
    const GlFunctions& gl = device_.gl;
    hasScissor_ = keepScissor && gl.IsEnabledi(GL_SCISSOR_TEST, 0) != GL_FALSE;
    for (const GLenum what : kOff)
        if (!device_.guard || !device_.guard->isOff(what))
            gl.Disable(what);
    encodeSrgb ? gl.Enable(GL_FRAMEBUFFER_SRGB) : gl.Disable(GL_FRAMEBUFFER_SRGB);
    gl.Disablei(GL_SCISSOR_TEST, 0);
    gl.DepthMask(GL_TRUE); // without the test nothing is written
    gl.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl.ProvokingVertex(GL_LAST_VERTEX_CONVENTION); // whose flat outputs a triangle has
    gl.DepthRangeIndexed(0, 0.0, 1.0);
    gl.BindVertexArray(vertexArray_.name());

    program_ = framebuffer_ = kUnknown;
    viewport_ = {};
    blend_ = Blend::None;
    onlyFirst_ = depthTested_ = depthReversed_ = false;
    units_.fill({kUnknown, kUnknown});
    targets_ = 0;
    useTargets(1); // clears obey its mask
}

void GlDrawState::useTargets(uint32_t count)
{
    for (; targets_ < count; ++targets_) {
        touchState(device_, GlStateGroup::DrawBuffer, targets_);
        touchState(device_, GlStateGroup::ColorMask, targets_);
        device_.gl.BlendEquationSeparatei(targets_, GL_FUNC_ADD, GL_FUNC_ADD);
        device_.gl.ColorMaski(targets_, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        setBlendAt(targets_);
    }
}

void GlDrawState::useProgram(uint32_t program)
{
    if (program_ == program)
        return;
    program_ = program;
    device_.gl.UseProgram(program);
}

void GlDrawState::bindFramebuffer(uint32_t framebuffer, const Viewport& viewport)
{
    const GlFunctions& gl = device_.gl;
    if (framebuffer_ != framebuffer)
        gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    if (framebuffer_ == kUnknown || viewport_ != viewport)
        gl.ViewportIndexedf(0, static_cast<GLfloat>(viewport.x), static_cast<GLfloat>(viewport.y),
                            static_cast<GLfloat>(viewport.width), static_cast<GLfloat>(viewport.height));
    if (hasScissor_ && viewport_.isHosts != viewport.isHosts)
        viewport.isHosts ? gl.Enablei(GL_SCISSOR_TEST, 0) : gl.Disablei(GL_SCISSOR_TEST, 0);
    framebuffer_ = framebuffer;
    viewport_ = viewport;
}

void GlDrawState::openScissor()
{
    if (!hasScissor_ || !viewport_.isHosts)
        return;
    device_.gl.Disablei(GL_SCISSOR_TEST, 0);
    viewport_.isHosts = false;
}

void GlDrawState::drawToFirst(bool only)
{
    if (onlyFirst_ == only)
        return;
    onlyFirst_ = only;
    const GLboolean mask = only ? GL_FALSE : GL_TRUE;
    for (uint32_t i = 1; i < (only ? kTargets : targets_); ++i) {
        touchState(device_, GlStateGroup::ColorMask, i);
        device_.gl.ColorMaski(i, mask, mask, mask, mask);
    }
}

void GlDrawState::setBlend(Blend blend)
{
    if (blend_ == blend)
        return;
    blend_ = blend;
    for (uint32_t i = 0; i < targets_; ++i)
        setBlendAt(i);
}

void GlDrawState::setBlendAt(uint32_t target)
{
    const GlFunctions& gl = device_.gl;
    if (blend_ == Blend::None) {
        gl.Disablei(GL_BLEND, target);
        return;
    }
    const GLenum destination = blend_ == Blend::Additive ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA;
    gl.Enablei(GL_BLEND, target);
    gl.BlendFuncSeparatei(target, GL_ONE, destination, GL_ONE, destination);
}

void GlDrawState::setDepth(bool tested, bool reversed)
{
    if (depthTested_ != tested)
        tested ? device_.gl.Enable(GL_DEPTH_TEST) : device_.gl.Disable(GL_DEPTH_TEST);
    if (tested && (!depthTested_ || depthReversed_ != reversed))
        device_.gl.DepthFunc(reversed ? GL_GREATER : GL_LESS);
    depthTested_ = tested;
    depthReversed_ = reversed;
}

void GlDrawState::bindTexture(uint32_t unit, uint32_t texture, Sampling sampling)
{
    const uint32_t sampler = samplers_[static_cast<size_t>(sampling)].name();
    Unit& bound = units_[unit];
    if (bound.texture == kUnknown)
        touchState(device_, GlStateGroup::TextureUnit, unit);
    if (bound.texture != texture)
        device_.gl.BindTextureUnit(unit, texture);
    if (bound.sampler != sampler)
        device_.gl.BindSampler(unit, sampler);
    bound = {texture, sampler};
}

} // namespace fx::render
