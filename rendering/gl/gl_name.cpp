#include "rendering/gl/gl_name.h"

namespace fx::render {

GlVertexArray createVertexArray(GlDevice& device)
{
    uint32_t name = 0;
    device.gl.CreateVertexArrays(1, &name);
    return {device, name};
}

GlFramebuffer createFramebuffer(GlDevice& device)
{
    uint32_t name = 0;
    device.gl.CreateFramebuffers(1, &name);
    return {device, name};
}

GlSampler createSampler(GlDevice& device, Sampling sampling)
{
    const bool hasLevels = sampling == Sampling::Trilinear || sampling == Sampling::TrilinearRepeat;
    const bool repeats = sampling == Sampling::LinearRepeat || sampling == Sampling::TrilinearRepeat;
    const GLint filter = sampling == Sampling::Nearest ? GL_NEAREST : GL_LINEAR;
    const GLint wrap = repeats ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    uint32_t name = 0;
    device.gl.CreateSamplers(1, &name);
    device.gl.SamplerParameteri(name, GL_TEXTURE_MIN_FILTER, hasLevels ? GL_LINEAR_MIPMAP_LINEAR : filter);
    device.gl.SamplerParameteri(name, GL_TEXTURE_MAG_FILTER, filter);
    device.gl.SamplerParameteri(name, GL_TEXTURE_WRAP_S, wrap);
    device.gl.SamplerParameteri(name, GL_TEXTURE_WRAP_T, wrap);
    device.gl.SamplerParameteri(name, GL_TEXTURE_WRAP_R, wrap);
    return {device, name};
}

} // namespace fx::render
