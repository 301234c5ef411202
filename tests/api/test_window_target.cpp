// Effects in a window: framebuffer 0, with its depth, of one sample and of several. The window is a pbuffer.
#include "tests/api/api_fixture.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {

constexpr int kSide = 64;                           ///< [pixel]
constexpr uint8_t kCleared[] = {51, 102, 153, 255}; ///< codes that Window::clear() writes

/// An OpenGL context with a default framebuffer.
class Window
{
public:
    explicit Window(int samples)
        : display_(eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr))
    {
        if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr) ||
            !eglBindAPI(EGL_OPENGL_API))
            return;
        const EGLint wanted[] = {EGL_SURFACE_TYPE,
                                 EGL_PBUFFER_BIT,
                                 EGL_RENDERABLE_TYPE,
                                 EGL_OPENGL_BIT,
                                 EGL_RED_SIZE,
                                 8,
                                 EGL_DEPTH_SIZE,
                                 24,
                                 EGL_SAMPLES,
                                 samples,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!eglChooseConfig(display_, wanted, &config, 1, &count) || count == 0)
            return;
        const EGLint size[] = {EGL_WIDTH, kSide, EGL_HEIGHT, kSide, EGL_NONE};
        const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                                  4,
                                  EGL_CONTEXT_MINOR_VERSION,
                                  5,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                  EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                  EGL_NONE};
        surface_ = eglCreatePbufferSurface(display_, config, size);
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, version);
        isCurrent_ = surface_ != EGL_NO_SURFACE && context_ != EGL_NO_CONTEXT &&
                     eglMakeCurrent(display_, surface_, surface_, context_);
    }
    ~Window()
    {
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        if (context_ != EGL_NO_CONTEXT)
            eglDestroyContext(display_, context_);
        if (surface_ != EGL_NO_SURFACE)
            eglDestroySurface(display_, surface_);
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool isCurrent() const { return isCurrent_; }

    template <class Function>
    Function load(const char* name) const
    {
        return reinterpret_cast<Function>(eglGetProcAddress(name));
    }

    void setDrawBuffer(GLenum buffer) { load<PFNGLDRAWBUFFERPROC>("glDrawBuffer")(buffer); }

    /// Clears color and depth; the right half is as near as `wall` says. glClear() is used because
    /// glClearBufferfv() of Mesa has no effect on GL_BACK of a window with one buffer, although it is drawn
    /// to.
    void clear(float wall)
    {
        const auto clearDepth = load<PFNGLCLEARDEPTHFPROC>("glClearDepthf");
        const auto clear = load<PFNGLCLEARPROC>("glClear");
        load<PFNGLCLEARCOLORPROC>("glClearColor")(0.2f, 0.4f, 0.6f, 1.0f);
        clearDepth(1.0f);
        clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        load<PFNGLENABLEPROC>("glEnable")(GL_SCISSOR_TEST);
        load<PFNGLSCISSORPROC>("glScissor")(kSide / 2, 0, kSide / 2, kSide);
        clearDepth(wall);
        clear(GL_DEPTH_BUFFER_BIT);
        load<PFNGLDISABLEPROC>("glDisable")(GL_SCISSOR_TEST);
    }

    std::vector<uint8_t> codes()
    {
        GLuint texture = 0, framebuffer = 0;
        load<PFNGLCREATETEXTURESPROC>("glCreateTextures")(GL_TEXTURE_2D, 1, &texture);
        load<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D")(texture, 1, GL_RGBA8, kSide, kSide);
        load<PFNGLCREATEFRAMEBUFFERSPROC>("glCreateFramebuffers")(1, &framebuffer);
        load<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>("glNamedFramebufferTexture")(framebuffer, GL_COLOR_ATTACHMENT0,
                                                                            texture, 0);
        load<PFNGLBLITNAMEDFRAMEBUFFERPROC>("glBlitNamedFramebuffer")(
            0, framebuffer, 0, 0, kSide, kSide, 0, 0, kSide, kSide, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        std::vector<uint8_t> out(size_t(kSide * kSide * 4));
        load<PFNGLGETTEXTUREIMAGEPROC>("glGetTextureImage")(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                                                            GLsizei(out.size()), out.data());
        load<PFNGLDELETEFRAMEBUFFERSPROC>("glDeleteFramebuffers")(1, &framebuffer);
        load<PFNGLDELETETEXTURESPROC>("glDeleteTextures")(1, &texture);
        return out;
    }

private:
    EGLDisplay display_;
    EGLSurface surface_ = EGL_NO_SURFACE;
    EGLContext context_ = EGL_NO_CONTEXT;
    bool isCurrent_ = false;
};

FxFrameDef windowFrame()
{
    FxFrameDef def = fxDefaultFrameDef();
    def.origin[2] = 3.0;
    def.projection[0] = def.projection[5] = 1.0f;
    def.projection[10] = def.projection[11] = -1.0f; // infinite far plane, near plane at 0.1 m
    def.projection[14] = -0.2f;
    def.projection[15] = 0.0f;
    def.target = FX_TARGET_FRAMEBUFFER;
    def.targetEncoding = FX_TARGET_DISPLAY_SRGB;
    def.depthFromFramebuffer = 1;
    def.width = def.height = kSide;
    return def;
}

} // namespace

TEST(WindowTarget, effectsAreDrawnOverTheWindowAndBehindItsSurfaces)
{
    for (const int samples : {0, 4}) {
        SCOPED_TRACE(std::to_string(samples) + " samples");
        Window window(samples);
        if (!window.isCurrent())
            GTEST_SKIP() << "no pbuffer with " << samples << " samples";
        FxContextDef contextDef = fxDefaultContextDef();
        contextDef.gl.getProcAddress = fxGetGlProcAddress;
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        FxInstanceDef instance = fxDefaultInstanceDef();
        FxContext* context = nullptr;
        FxScene* scene = nullptr;
        FxView* view = nullptr;
        FxInstanceId id;
        ASSERT_EQ(fxCreateContext(&contextDef, &context), FX_OK) << fxGetLastErrorMessage();
        ASSERT_EQ(fxCreateScene(context, &sceneDef, &scene), FX_OK);
        ASSERT_EQ(fxLoadPresetLibrary(context, "campfire", &instance.preset), FX_OK)
            << fxGetLastErrorMessage();
        ASSERT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        for (int i = 0; i < 120; ++i)
            ASSERT_EQ(fxScene_Update(scene, fx::test::kFrame), FX_OK);
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0;
        settings.shimmerStrength = 0; // it takes pixels from beside it
        ASSERT_EQ(fxCreateView(context, scene, &settings, &view), FX_OK) << fxGetLastErrorMessage();
        const FxFrameDef def = windowFrame();
        const auto changed = [&](float wall, size_t outHalves[2], std::vector<uint8_t>& outCodes) {
            window.clear(wall);
            const std::vector<uint8_t> before = window.codes();
            for (size_t i = 0; i < before.size(); ++i)
                ASSERT_EQ(before[i], kCleared[i % 4]);
            ASSERT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
            outCodes = window.codes();
            outHalves[0] = outHalves[1] = 0;
            for (size_t i = 0; i < outCodes.size(); i += 4)
                outHalves[i / 4 % kSide < kSide / 2 ? 0 : 1] +=
                    !std::equal(std::begin(kCleared), std::end(kCleared), outCodes.begin() + long(i));
        };
        size_t open[2], walled[2], again[2];
        std::vector<uint8_t> first, behind, repeated;
        changed(1.0f, open, first);
        EXPECT_GT(open[0], 30u);
        EXPECT_GT(open[1], 30u);
        EXPECT_LT(open[0] + open[1], size_t(kSide * kSide) / 2); // the rest keeps its bits
        changed(0.8f, walled, behind);                           // 0.5 m away, before the fire
        EXPECT_EQ(walled[1], 0u);
        for (size_t i = 0; i < first.size(); ++i) // the wall changes nothing beside it
            ASSERT_EQ(behind[i], i / 4 % kSide < kSide / 2 ? first[i] : kCleared[i % 4]) << i;
        changed(1.0f, again, repeated);
        EXPECT_EQ(repeated, first);
        window.setDrawBuffer(GL_FRONT); // the only buffer of a pbuffer in Mesa, where GL_BACK stands for it
        changed(1.0f, again, repeated);
        EXPECT_EQ(repeated, first);
        EXPECT_EQ(fxDestroyContext(context), FX_OK);
    }
}
