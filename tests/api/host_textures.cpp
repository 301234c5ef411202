#include "tests/api/host_textures.h"

#include <stdexcept>

namespace fx::test {

HostGl::HostGl(const render::GlLoader& loader)
{
#define FX_HOST_GL_LOAD(type, name)                                                                          \
    name = reinterpret_cast<type>(loader.getProcAddress(loader.user, "gl" #name));                           \
    if (!name)                                                                                               \
        throw std::runtime_error("gl" #name " is missing");
    FX_HOST_GL(FX_HOST_GL_LOAD)
#undef FX_HOST_GL_LOAD
}

HostTextures::~HostTextures()
{
    gl.DeleteFramebuffers(GLsizei(framebuffers_.size()), framebuffers_.data());
    gl.DeleteTextures(GLsizei(textures_.size()), textures_.data());
    gl.DeleteRenderbuffers(GLsizei(renderbuffers_.size()), renderbuffers_.data());
    gl.DeleteBuffers(GLsizei(buffers_.size()), buffers_.data());
}

GLuint HostTextures::make(GLenum target, GLenum format, int width, int height, int levels, int layers)
{
    GLuint name = 0;
    gl.CreateTextures(target, 1, &name);
    textures_.push_back(name);
    switch (target) {
    case GL_TEXTURE_1D:
        gl.TextureStorage1D(name, levels, format, width);
        break;
    case GL_TEXTURE_2D_ARRAY:
    case GL_TEXTURE_3D:
    case GL_TEXTURE_CUBE_MAP_ARRAY:
        gl.TextureStorage3D(name, levels, format, width, height,
                            target == GL_TEXTURE_CUBE_MAP_ARRAY ? 6 * layers : layers);
        break;
    case GL_TEXTURE_2D_MULTISAMPLE:
        gl.TextureStorage2DMultisample(name, 4, format, width, height, GL_TRUE);
        break;
    case GL_TEXTURE_2D_MULTISAMPLE_ARRAY:
        gl.TextureStorage3DMultisample(name, 4, format, width, height, layers, GL_TRUE);
        break;
    case GL_TEXTURE_BUFFER:
        gl.TextureBuffer(name, format, makeBuffer());
        break;
    default: // GL_TEXTURE_1D_ARRAY takes its layers from the height
        gl.TextureStorage2D(name, levels, format, width, height);
    }
    return name;
}

GLuint HostTextures::makeView(GLuint of, GLenum format, GLuint level, GLuint layer)
{
    GLuint name = 0;
    gl.GenTextures(1, &name);
    textures_.push_back(name);
    gl.TextureView(name, GL_TEXTURE_2D, of, format, level, 1, layer, 1);
    return name;
}

GLuint HostTextures::makeMutable(GLenum format, int size)
{
    GLuint name = 0;
    GLint bound = 0;
    gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &bound);
    gl.GenTextures(1, &name);
    textures_.push_back(name);
    gl.BindTexture(GL_TEXTURE_2D, name);
    if (size > 0)
        gl.TexImage2D(GL_TEXTURE_2D, 0, GLint(format), size, size, 0, GL_RGBA, GL_FLOAT, nullptr);
    gl.BindTexture(GL_TEXTURE_2D, GLuint(bound));
    return name;
}

GLuint HostTextures::makeFramebuffer(GLuint color)
{
    GLuint name = 0;
    gl.CreateFramebuffers(1, &name);
    framebuffers_.push_back(name);
    if (color != 0)
        gl.NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color, 0);
    return name;
}

GLuint HostTextures::makeRenderbufferTarget(GLenum format, int size)
{
    GLuint name = 0;
    gl.CreateRenderbuffers(1, &name);
    renderbuffers_.push_back(name);
    gl.NamedRenderbufferStorage(name, format, size, size);
    const GLuint framebuffer = makeFramebuffer(0);
    gl.NamedFramebufferRenderbuffer(framebuffer, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, name);
    return framebuffer;
}

GLuint HostTextures::makeBuffer()
{
    GLuint name = 0;
    gl.CreateBuffers(1, &name);
    buffers_.push_back(name);
    gl.NamedBufferStorage(name, 1 << 16, nullptr, 0);
    return name;
}

} // namespace fx::test
