// host_sdl2 [--headless FILE.png] [--frames N] [--size WxH] [--host-restores]
//
// An SDL2 window, a renderer with reversed depth and a cache of GL state. The scene is drawn into
// GL_R11F_G11F_B10F with 32-bit depth from 1 at the near plane to 0 at infinity. Shows: glClipControl, depth
// and camera of a reversed frame, a cache that stays true after fxView_Render(), and with --host-restores
// what a host does that leaves saving to itself (FxViewSettings::saveState = 0).
#include "host_effects.h"
#include "host_options.h"
#include "host_report.h"
#include "host_scene.h"
#include "state_cache.h"

#include <SDL.h>

#include <algorithm>
#include <cstdio>

namespace {

constexpr const char* kSurface = R"(
in vec3 normal;
in vec3 albedo;
out vec4 color;
void main() { color = vec4(hostShade(albedo, normal), 1.0); }
)";

constexpr const char* kDisplay = R"(
layout(binding = 0) uniform sampler2D light;
out vec4 color;
void main() { color = vec4(hostToneMap(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
)";

/// A window with OpenGL 4.5. Without a display, SDL's driver "offscreen" has one that is not seen.
class Window
{
public:
    /// @param ioOptions receives the size of the window's framebuffer, which is larger on displays that scale
    explicit Window(HostOptions& ioOptions)
    {
        if (ioOptions.output)
            SDL_SetHint(SDL_HINT_VIDEODRIVER, "offscreen");
        if (SDL_Init(SDL_INIT_VIDEO) != 0)
            return;
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 4);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 5);
        SDL_GL_SetAttribute(SDL_GL_CONTEXT_PROFILE_MASK, SDL_GL_CONTEXT_PROFILE_CORE);
        window_ =
            SDL_CreateWindow("fxsdk: SDL2", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, ioOptions.width,
                             ioOptions.height, SDL_WINDOW_OPENGL | SDL_WINDOW_ALLOW_HIGHDPI);
        context_ = window_ ? SDL_GL_CreateContext(window_) : nullptr;
        if (!context_)
            return;
        SDL_GL_SetSwapInterval(1); // one frame for each refresh of the display
        SDL_GL_GetDrawableSize(window_, &ioOptions.width, &ioOptions.height);
    }
    ~Window()
    {
        if (context_)
            SDL_GL_DeleteContext(context_);
        if (window_)
            SDL_DestroyWindow(window_);
        SDL_Quit();
    }
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    bool isOpen() const { return context_ != nullptr; }
    /// Shows the frame. @return false when the user closes the window
    bool present() const
    {
        SDL_GL_SwapWindow(window_);
        for (SDL_Event event; SDL_PollEvent(&event);)
            if (event.type == SDL_QUIT)
                return false;
        return true;
    }

private:
    SDL_Window* window_ = nullptr;
    SDL_GLContext context_ = nullptr;
};

class Game
{
public:
    explicit Game(const HostOptions& options)
        : options_(options), viewport_{0, 0, options.width, options.height}
    {
        glCreateTextures(GL_TEXTURE_2D, 2, textures_);
        glTextureStorage2D(textures_[Color], 1, GL_R11F_G11F_B10F, options.width, options.height);
        glTextureStorage2D(textures_[Depth], 1, GL_DEPTH_COMPONENT32F, options.width, options.height);
        glCreateRenderbuffers(1, &display_);
        glNamedRenderbufferStorage(display_, GL_RGBA8, options.width, options.height);
        glCreateFramebuffers(2, framebuffers_);
        glNamedFramebufferTexture(framebuffers_[Scene], GL_COLOR_ATTACHMENT0, textures_[Color], 0);
        glNamedFramebufferTexture(framebuffers_[Scene], GL_DEPTH_ATTACHMENT, textures_[Depth], 0);
        glNamedFramebufferRenderbuffer(framebuffers_[Display], GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                                       display_);
        surface_ = hostMakeProgram(kHostVertexGlsl, kHostShadeGlsl, kSurface);
        toneMap_ = hostMakeProgram(kHostFullScreenGlsl, kHostToneMapGlsl, kDisplay);
        mesh_ = hostMakeMesh(&vertexCount_);
        glCreateVertexArrays(1, &noVertices_);
        // Reversed depth: [0, 1] without a loss of precision. The view does not change it.
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);

        const FxGlLoader counted = hostCountCalls(&loader_); // measures; a game passes its loader
        FxViewSettings settings = hostLight();
        settings.saveState = options.hostRestores ? 0 : 1;
        isRight_ = surface_ && toneMap_ && hostOpenEffects(&effects_, &counted, &settings);
    }
    ~Game() { hostCloseEffects(&effects_); }
    Game(const Game&) = delete;
    Game& operator=(const Game&) = delete;

    bool play(const Window& window)
    {
        for (int frame = 0; isRight_ && hostPlays(&options_, frame); ++frame) {
            isRight_ = fxScene_Update(effects_.scene, hostStep(&options_)) == FX_OK;
            if (isRight_ && hostDraws(&options_, frame))
                isRight_ = draw(true);
            if (!options_.output && !present(window))
                break;
        }
        if (!isRight_)
            std::fprintf(stderr, "sdl2: %s\n", fxGetLastErrorMessage());
        return isRight_ && (!options_.output || report());
    }

private:
    enum
    {
        Color,
        Depth
    };
    enum
    {
        Scene,
        Display
    };

    bool draw(bool withEffects)
    {
        float view[16], projection[16];
        hostCamera(float(options_.width) / float(options_.height), 1, view, projection);
        drawScene(view, projection);
        if (withEffects && !drawEffects(view, projection))
            return false;
        state_.bindFramebuffer(framebuffers_[Display]);
        state_.setViewport(viewport_);
        state_.setDepth(false, false, GL_GREATER);
        state_.setBlend(false);
        state_.setCull(false);
        state_.useProgram(toneMap_);
        state_.bindTexture(0, textures_[Color]);
        state_.bindVertexArray(noVertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
        return true;
    }

    void drawScene(const float view[16], const float projection[16])
    {
        const float sky[4] = {kHostSky[0], kHostSky[1], kHostSky[2], 1.0f}, farthest = 0.0f;
        float camera[16];
        hostMultiply(projection, view, camera);
        state_.bindFramebuffer(framebuffers_[Scene]);
        state_.setViewport(viewport_);
        state_.setDepth(true, true, GL_GREATER); // near is the larger value
        state_.setBlend(false);
        state_.setCull(true);
        glClearBufferfv(GL_COLOR, 0, sky);
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        state_.useProgram(surface_);
        glProgramUniformMatrix4fv(surface_, 0, 1, GL_FALSE, camera);
        state_.bindVertexArray(mesh_);
        glDrawArrays(GL_TRIANGLES, 0, vertexCount_);
    }

    bool drawEffects(const float view[16], const float projection[16])
    {
        FxFrameDef frame = fxDefaultFrameDef();
        std::copy_n(view, 16, frame.view);
        std::copy_n(projection, 16, frame.projection);
        frame.depthConvention = FX_DEPTH_REVERSED;
        frame.zeroToOne = 1; // as glClipControl above
        frame.colorTexture = textures_[Color];
        frame.depthTexture = textures_[Depth];
        frame.width = options_.width;
        frame.height = options_.height;
        hostBeforeEffects(); // measures; a game leaves this out
        const FxResult result = fxView_Render(effects_.view, &frame);
        if (options_.hostRestores)
            restoreState(); // saveState = 0: the states that fxGetTouchedGlState() lists have changed
        hostAfterEffects(&frame);
        if (const int count = state_.countFalse(); count != 0) { // a check; a game leaves this out
            std::fprintf(stderr, "sdl2: %d values of the cache are false\n", count);
            return false;
        }
        return result == FX_OK;
    }

    /// What a host does after fxView_Render() with saveState = 0: the cache forgets, and the other states of
    /// fxGetTouchedGlState() get the value that the host always has, here that of a new context.
    void restoreState()
    {
        state_.forget();
        for (const GLenum what :
             {GL_STENCIL_TEST, GL_DEPTH_CLAMP, GL_FRAMEBUFFER_SRGB, GL_RASTERIZER_DISCARD,
              GL_PRIMITIVE_RESTART, GL_PRIMITIVE_RESTART_FIXED_INDEX, GL_COLOR_LOGIC_OP,
              GL_POLYGON_OFFSET_FILL, GL_POLYGON_SMOOTH, GL_SAMPLE_MASK, GL_SAMPLE_ALPHA_TO_COVERAGE,
              GL_SAMPLE_ALPHA_TO_ONE, GL_SAMPLE_COVERAGE, GL_SAMPLE_SHADING, GL_SCISSOR_TEST})
            glDisable(what);
        for (GLenum plane = 0; plane < 8; ++plane)
            glDisable(GL_CLIP_DISTANCE0 + plane);
        glEnable(GL_DITHER);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ZERO);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
        glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
        glDepthRange(0.0, 1.0);
        glActiveTexture(GL_TEXTURE0);
        glBindTextures(0, 13, nullptr); // as many units as fxGetTouchedGlState() names
        glBindSamplers(0, 13, nullptr);
        glBindImageTextures(0, 7, nullptr);
        glBindBuffersBase(GL_UNIFORM_BUFFER, 0, 2, nullptr);
        glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 8, nullptr);
        for (const GLenum target : {GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER, GL_DRAW_INDIRECT_BUFFER})
            glBindBuffer(target, 0);
    }

    bool present(const Window& window)
    {
        glBlitNamedFramebuffer(framebuffers_[Display], 0, 0, 0, options_.width, options_.height, 0, 0,
                               options_.width, options_.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
        return window.present();
    }

    bool report()
    {
        const HostReport report = {
            "sdl2",
            "GL_R11F_G11F_B10F, linear",
            "GL_DEPTH_COMPONENT32F, reversed, infinite",
            1,
            [](void* game, int with) { return int(static_cast<Game*>(game)->draw(with != 0)); },
            this,
            framebuffers_[Scene],
            framebuffers_[Display],
            0};
        return hostReport(&report, &options_, &effects_);
    }

    HostOptions options_;
    StateCache::Rectangle viewport_;
    StateCache state_;
    FxGlLoader loader_{nullptr, [](void*, const char* name) { return SDL_GL_GetProcAddress(name); }};
    GLuint textures_[2] = {}, framebuffers_[2] = {}, display_ = 0;
    GLuint surface_ = 0, toneMap_ = 0, mesh_ = 0, noVertices_ = 0;
    int vertexCount_ = 0;
    HostEffects effects_ = {};
    bool isRight_ = false;
};

} // namespace

int main(int argumentCount, char** arguments)
{
    HostOptions options;
    if (!hostParse(argumentCount, arguments, &options))
        return 2;
    const Window window(options);
    if (!window.isOpen()) {
        std::fprintf(stderr, "sdl2: no window with OpenGL 4.5: %s\n", SDL_GetError());
        return 1;
    }
    Game game(options);
    return game.play(window) ? 0 : 1;
}
