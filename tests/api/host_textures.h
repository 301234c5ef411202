/// @file host_textures.h
/// Textures and framebuffers of a host, with any target, format, number of samples and state.
#pragma once

#include "rendering/platform/gl_context.h"

#include <GL/glcorearb.h>

#include <cstdint>
#include <vector>

namespace fx::test {

/// GL functions that only hosts call. The library does not call these functions.
struct HostGl
{
    explicit HostGl(const render::GlLoader& loader);

#define FX_HOST_GL(X)                                                                                        \
    X(PFNGLCREATETEXTURESPROC, CreateTextures)                                                               \
    X(PFNGLDELETETEXTURESPROC, DeleteTextures)                                                               \
    X(PFNGLGENTEXTURESPROC, GenTextures)                                                                     \
    X(PFNGLTEXTURESTORAGE1DPROC, TextureStorage1D)                                                           \
    X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)                                                           \
    X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)                                                           \
    X(PFNGLTEXTURESTORAGE2DMULTISAMPLEPROC, TextureStorage2DMultisample)                                     \
    X(PFNGLTEXTURESTORAGE3DMULTISAMPLEPROC, TextureStorage3DMultisample)                                     \
    X(PFNGLTEXTURESUBIMAGE2DPROC, TextureSubImage2D)                                                         \
    X(PFNGLCOMPRESSEDTEXTURESUBIMAGE2DPROC, CompressedTextureSubImage2D)                                     \
    X(PFNGLTEXTUREBUFFERPROC, TextureBuffer)                                                                 \
    X(PFNGLTEXTUREVIEWPROC, TextureView)                                                                     \
    X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)                                                         \
    X(PFNGLTEXTUREPARAMETERIVPROC, TextureParameteriv)                                                       \
    X(PFNGLGETTEXTUREIMAGEPROC, GetTextureImage)                                                             \
    X(PFNGLBINDTEXTUREPROC, BindTexture)                                                                     \
    X(PFNGLTEXIMAGE2DPROC, TexImage2D)                                                                       \
    X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                                                                 \
    X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                                                                 \
    X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)                                                       \
    X(PFNGLCREATERENDERBUFFERSPROC, CreateRenderbuffers)                                                     \
    X(PFNGLDELETERENDERBUFFERSPROC, DeleteRenderbuffers)                                                     \
    X(PFNGLNAMEDRENDERBUFFERSTORAGEPROC, NamedRenderbufferStorage)                                           \
    X(PFNGLNAMEDRENDERBUFFERSTORAGEMULTISAMPLEPROC, NamedRenderbufferStorageMultisample)                     \
    X(PFNGLNAMEDFRAMEBUFFERRENDERBUFFERPROC, NamedFramebufferRenderbuffer)                                   \
    X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)                                                       \
    X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)                                                       \
    X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture)                                             \
    X(PFNGLNAMEDFRAMEBUFFERTEXTURELAYERPROC, NamedFramebufferTextureLayer)                                   \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERSPROC, NamedFramebufferDrawBuffers)                                     \
    X(PFNGLNAMEDFRAMEBUFFERDRAWBUFFERPROC, NamedFramebufferDrawBuffer)                                       \
    X(PFNGLBLITNAMEDFRAMEBUFFERPROC, BlitNamedFramebuffer)                                                   \
    X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv)                                             \
    X(PFNGLCLEARNAMEDFRAMEBUFFERUIVPROC, ClearNamedFramebufferuiv)                                           \
    X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                                                             \
    X(PFNGLGETINTEGERVPROC, GetIntegerv)                                                                     \
    X(PFNGLSCISSORPROC, Scissor)                                                                             \
    X(PFNGLENABLEPROC, Enable)                                                                               \
    X(PFNGLDISABLEPROC, Disable)                                                                             \
    X(PFNGLISENABLEDPROC, IsEnabled)                                                                         \
    X(PFNGLCLIPCONTROLPROC, ClipControl)                                                                     \
    X(PFNGLGETERRORPROC, GetError)

#define FX_HOST_GL_MEMBER(type, name) type name = nullptr;
    FX_HOST_GL(FX_HOST_GL_MEMBER)
#undef FX_HOST_GL_MEMBER
};

/// Creates textures and framebuffers and deletes them in its destructor.
class HostTextures
{
public:
    explicit HostTextures(const render::GlLoader& loader) : gl(loader) {}
    ~HostTextures();
    HostTextures(const HostTextures&) = delete;
    HostTextures& operator=(const HostTextures&) = delete;

    /// Immutable texture with `layers` layers; cubes have six faces, multisample targets four samples.
    GLuint make(GLenum target, GLenum format, int width, int height, int levels = 1, int layers = 2);
    GLuint make2D(GLenum format, int size) { return make(GL_TEXTURE_2D, format, size, size); }
    /// A 2-D view of one level of one layer.
    GLuint makeView(GLuint of, GLenum format, GLuint level, GLuint layer);
    /// Texture created by glTexImage2D, without mipmaps, with the default filters. If `size` is 0, the
    /// texture has no image.
    GLuint makeMutable(GLenum format, int size);
    /// A framebuffer with the whole texture as its only color attachment.
    GLuint makeFramebuffer(GLuint color);
    /// A framebuffer with a renderbuffer as its only color attachment.
    GLuint makeRenderbufferTarget(GLenum format, int size);
    GLuint makeBuffer();

    HostGl gl;

private:
    std::vector<GLuint> textures_, framebuffers_, renderbuffers_, buffers_;
};

} // namespace fx::test
