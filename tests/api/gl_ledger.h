/// @file gl_ledger.h
/// Intercepts the OpenGL calls of a context and records the existing objects: textures by format, buffers by
/// label, programs by name, and the number of framebuffers.
///
/// Threads: one thread. Only one ledger may exist at a time.
#pragma once

#include "rendering/platform/gl_context.h"

#include <GL/glcorearb.h>

#include <cstring>
#include <map>
#include <set>
#include <string>

namespace fx::test {

class GlLedger
{
public:
    explicit GlLedger(const render::GlLoader& real) : real_(real) { current() = this; }
    ~GlLedger() { current() = nullptr; }
    GlLedger(const GlLedger&) = delete;
    GlLedger& operator=(const GlLedger&) = delete;

    render::GlLoader loader() { return {this, &find}; }

    using Counts = std::map<std::string, int>;
    Counts textures() const ///< number of existing textures by format
    {
        Counts counts;
        for (const auto& [name, format] : textures_)
            ++counts[format];
        return counts;
    }
    Counts buffers() const ///< number of existing buffers by label
    {
        Counts counts;
        for (const auto& [name, label] : buffers_)
            ++counts[label];
        return counts;
    }
    /// names of all created programs, including deleted programs
    const std::set<std::string>& programs() const { return programs_; }
    size_t framebuffers() const { return framebuffers_.size(); } ///< number of existing framebuffers

private:
    static GlLedger*& current()
    {
        static GlLedger* ledger = nullptr;
        return ledger;
    }
    static std::string formatName(GLenum format)
    {
        switch (format) {
        case GL_RGBA32F:
            return "RGBA32F";
        case GL_RGBA16F:
            return "RGBA16F";
        case GL_DEPTH_COMPONENT32F:
            return "Depth32F";
        case GL_R32F:
            return "R32F";
        case GL_RG32F:
            return "RG32F";
        case GL_RG32UI:
            return "RG32UI";
        case GL_RGBA8:
            return "RGBA8";
        default:
            return std::to_string(format);
        }
    }

    template <class F>
    F real(const char* name)
    {
        return reinterpret_cast<F>(real_.getProcAddress(real_.user, name));
    }
    static void APIENTRY textureStorage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h)
    {
        current()->textures_[texture] = formatName(format);
        current()->real<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D")(texture, levels, format, w, h);
    }
    static void APIENTRY textureStorage3D(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h,
                                          GLsizei d)
    {
        current()->textures_[texture] = formatName(format) + " array";
        current()->real<PFNGLTEXTURESTORAGE3DPROC>("glTextureStorage3D")(texture, levels, format, w, h, d);
    }
    static void APIENTRY deleteTextures(GLsizei count, const GLuint* names)
    {
        for (GLsizei i = 0; i < count; ++i)
            current()->textures_.erase(names[i]);
        current()->real<PFNGLDELETETEXTURESPROC>("glDeleteTextures")(count, names);
    }
    static void APIENTRY deleteBuffers(GLsizei count, const GLuint* names)
    {
        for (GLsizei i = 0; i < count; ++i)
            current()->buffers_.erase(names[i]);
        current()->real<PFNGLDELETEBUFFERSPROC>("glDeleteBuffers")(count, names);
    }
    static void APIENTRY createFramebuffers(GLsizei count, GLuint* names)
    {
        current()->real<PFNGLCREATEFRAMEBUFFERSPROC>("glCreateFramebuffers")(count, names);
        current()->framebuffers_.insert(names, names + count);
    }
    static void APIENTRY deleteFramebuffers(GLsizei count, const GLuint* names)
    {
        for (GLsizei i = 0; i < count; ++i)
            current()->framebuffers_.erase(names[i]);
        current()->real<PFNGLDELETEFRAMEBUFFERSPROC>("glDeleteFramebuffers")(count, names);
    }
    static void APIENTRY objectLabel(GLenum kind, GLuint name, GLsizei length, const GLchar* label)
    {
        if (kind == GL_BUFFER)
            current()->buffers_[name] = label;
        if (kind == GL_PROGRAM)
            current()->programs_.insert(label);
        current()->real<PFNGLOBJECTLABELPROC>("glObjectLabel")(kind, name, length, label);
    }

    static void* find(void* user, const char* name)
    {
        const std::map<std::string, void*> ours = {
            {"glTextureStorage2D", reinterpret_cast<void*>(&textureStorage2D)},
            {"glTextureStorage3D", reinterpret_cast<void*>(&textureStorage3D)},
            {"glDeleteTextures", reinterpret_cast<void*>(&deleteTextures)},
            {"glDeleteBuffers", reinterpret_cast<void*>(&deleteBuffers)},
            {"glCreateFramebuffers", reinterpret_cast<void*>(&createFramebuffers)},
            {"glDeleteFramebuffers", reinterpret_cast<void*>(&deleteFramebuffers)},
            {"glObjectLabel", reinterpret_cast<void*>(&objectLabel)},
        };
        const auto found = ours.find(name);
        const render::GlLoader& real = static_cast<GlLedger*>(user)->real_;
        return found == ours.end() ? real.getProcAddress(real.user, name) : found->second;
    }

    render::GlLoader real_;
    std::map<GLuint, std::string> textures_, buffers_;
    std::set<std::string> programs_;
    std::set<GLuint> framebuffers_;
};

} // namespace fx::test
