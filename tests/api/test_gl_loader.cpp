// Hosts without a loader of OpenGL functions of their own.
#include "rendering/platform/gl_context.h"
#include "tests/api/api_fixture.h"

#include <EGL/egl.h>

#include <cstring>

namespace {

FxResult createContext(FxContext*& outContext)
{
    FxContextDef def = fxDefaultContextDef();
    def.gl.getProcAddress = fxGetGlProcAddress;
    return fxCreateContext(&def, &outContext);
}

} // namespace

TEST(GlLoader, findsTheFunctionsOfTheContextThatIsCurrent)
{
    auto gl = fx::render::createEglContext({});
    ASSERT_TRUE(gl.ok()) << gl.status().message();
    EXPECT_EQ(fxGetGlProcAddress(nullptr, "glCreateTextures"),
              reinterpret_cast<void*>(eglGetProcAddress("glCreateTextures")));
    EXPECT_EQ(fxGetGlProcAddress(nullptr, nullptr), nullptr);
    FxContext* context = nullptr;
    ASSERT_EQ(createContext(context), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxContext_WarmUp(context), FX_OK) << fxGetLastErrorMessage();
    EXPECT_EQ(fxDestroyContext(context), FX_OK);
}

TEST(GlLoader, withoutACurrentContextTheMessageNamesTheCauseAndTheRemedy)
{
    eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    EXPECT_EQ(fxGetGlProcAddress(nullptr, "glCreateTextures"), nullptr);
    FxContext* context = nullptr;
    EXPECT_EQ(createContext(context), FX_ERROR_GL_UNSUPPORTED);
    EXPECT_EQ(context, nullptr);
    EXPECT_NE(
        std::strstr(fxGetLastErrorMessage(), "no OpenGL context is current on this thread: make one current"),
        nullptr)
        << fxGetLastErrorMessage();
}
