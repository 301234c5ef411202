#include "tests/api/gl_faults.h"

#include <utility>

namespace fx::test {

namespace {

GlFaults* current = nullptr;

} // namespace

/// Functions that may fail. Each calls the real function unless its turn to fail has come.
struct FaultyGl
{
    template <class F>
    static F real(const char* name)
    {
        return reinterpret_cast<F>(current->real_.getProcAddress(current->real_.user, name));
    }
    static bool runsOut(const char* name)
    {
        if (!current->fails(name))
            return false;
        current->error_ = GL_OUT_OF_MEMORY;
        return true;
    }

    static GLenum APIENTRY getError()
    {
        const GLenum own = std::exchange(current->error_, GLenum(GL_NO_ERROR));
        return own != GL_NO_ERROR ? own : real<PFNGLGETERRORPROC>("glGetError")();
    }
    static void APIENTRY bufferStorage(GLuint buffer, GLsizeiptr size, const void* data, GLbitfield flags)
    {
        if (runsOut("glNamedBufferStorage"))
            current->withoutMemory_.insert(buffer);
        else
            real<PFNGLNAMEDBUFFERSTORAGEPROC>("glNamedBufferStorage")(buffer, size, data, flags);
    }
    static void* APIENTRY mapBuffer(GLuint buffer, GLintptr offset, GLsizeiptr size, GLbitfield access)
    {
        if (current->withoutMemory_.contains(buffer) || runsOut("glMapNamedBufferRange"))
            return nullptr;
        return real<PFNGLMAPNAMEDBUFFERRANGEPROC>("glMapNamedBufferRange")(buffer, offset, size, access);
    }
    static void APIENTRY storage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h)
    {
        if (!runsOut("glTextureStorage2D"))
            real<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D")(texture, levels, format, w, h);
    }
    static void APIENTRY storage3D(GLuint texture, GLsizei levels, GLenum format, GLsizei w, GLsizei h,
                                   GLsizei d)
    {
        if (!runsOut("glTextureStorage3D"))
            real<PFNGLTEXTURESTORAGE3DPROC>("glTextureStorage3D")(texture, levels, format, w, h, d);
    }
    static void APIENTRY getShader(GLuint shader, GLenum name, GLint* out)
    {
        real<PFNGLGETSHADERIVPROC>("glGetShaderiv")(shader, name, out);
        if (name == GL_COMPILE_STATUS && current->fails("glCompileShader", true))
            *out = GL_FALSE;
    }
    static void APIENTRY getProgram(GLuint program, GLenum name, GLint* out)
    {
        real<PFNGLGETPROGRAMIVPROC>("glGetProgramiv")(program, name, out);
        if (name == GL_LINK_STATUS && current->fails("glLinkProgram", true))
            *out = GL_FALSE;
    }
    static GLenum APIENTRY checkFramebuffer(GLuint framebuffer, GLenum target)
    {
        if (current->fails("glCheckNamedFramebufferStatus"))
            return GL_FRAMEBUFFER_UNSUPPORTED;
        return real<PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC>("glCheckNamedFramebufferStatus")(framebuffer,
                                                                                           target);
    }
};

GlFaults::GlFaults(const render::GlLoader& real) : real_(real)
{
    current = this;
}

GlFaults::~GlFaults()
{
    current = nullptr;
}

void GlFaults::failAt(uint64_t n, bool ofCompilers)
{
    ofCompilers_ = ofCompilers;
    failing_ = n;
    calls_ = 0;
    failed_.clear();
    withoutMemory_.clear();
    error_ = GL_NO_ERROR;
}

bool GlFaults::fails(const char* name, bool isOfCompiler)
{
    if (isOfCompiler != ofCompilers_ || ++calls_ != failing_)
        return false;
    failed_ = name;
    return true;
}

void* GlFaults::find(void* user, const char* name)
{
    GlFaults& self = *static_cast<GlFaults*>(user);
    const std::string wanted(name);
    self.asked_.insert(wanted);
    if (wanted == self.hidden_)
        return nullptr;
    const std::pair<const char*, void*> faulty[] = {
        {"glGetError", reinterpret_cast<void*>(&FaultyGl::getError)},
        {"glNamedBufferStorage", reinterpret_cast<void*>(&FaultyGl::bufferStorage)},
        {"glMapNamedBufferRange", reinterpret_cast<void*>(&FaultyGl::mapBuffer)},
        {"glTextureStorage2D", reinterpret_cast<void*>(&FaultyGl::storage2D)},
        {"glTextureStorage3D", reinterpret_cast<void*>(&FaultyGl::storage3D)},
        {"glGetShaderiv", reinterpret_cast<void*>(&FaultyGl::getShader)},
        {"glGetProgramiv", reinterpret_cast<void*>(&FaultyGl::getProgram)},
        {"glCheckNamedFramebufferStatus", reinterpret_cast<void*>(&FaultyGl::checkFramebuffer)},
    };
    for (const auto& [known, function] : faulty)
        if (wanted == known)
            return function;
    return self.real_.getProcAddress(self.real_.user, name);
}

} // namespace fx::test
