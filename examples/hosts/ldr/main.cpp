// host_ldr [--headless FILE.png] [--frames N] [--size WxH]
//
// A game without HDR: it lights, clamps to 1, encodes with the curve of sRGB and stores 8 bits. Effects are
// drawn into the same renderbuffer. Shows: FxFrameDef::targetEncoding and displayWhite, how exposure and
// light of the view follow from the codes of the game, depth of a framebuffer.
#include "host_effects.h"
#include "host_options.h"
#include "host_report.h"
#include "host_scene.h"
#include "host_window.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

/// Lights and encodes at once, as a game with a single pass does.
constexpr const char* kSurface = R"(
in vec3 normal;
in vec3 albedo;
out vec4 color;
void main()
{
    vec3 y = clamp(hostShade(albedo, normal), 0.0, 1.0); // linear, clamped
    vec3 code = mix(12.92 * y, 1.055 * pow(max(y, 1e-6), vec3(1.0 / 2.4)) - 0.055, greaterThan(y, vec3(0.0031308)));
    color = vec4(code, 1.0);
}
)";

float codeOf(float linear)
{
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

/// The game's renderer, without effects.
class Renderer
{
public:
    Renderer(int width, int height) : width_(width), height_(height)
    {
        glCreateRenderbuffers(2, buffers_);
        glNamedRenderbufferStorage(buffers_[0], GL_RGBA8, width, height);
        glNamedRenderbufferStorage(buffers_[1], GL_DEPTH24_STENCIL8, width, height);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferRenderbuffer(framebuffer_, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers_[0]);
        glNamedFramebufferRenderbuffer(framebuffer_, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER,
                                       buffers_[1]);
        program_ = hostMakeProgram(kHostVertexGlsl, kHostShadeGlsl, kSurface);
        mesh_ = hostMakeMesh(&vertexCount_);
    }

    bool isRight() const { return program_ != 0; }
    GLuint framebuffer() const { return framebuffer_; }

    void draw(const float view[16], const float projection[16]) const
    {
        const float sky[4] = {codeOf(kHostSky[0]), codeOf(kHostSky[1]), codeOf(kHostSky[2]), 1.0f};
        float camera[16];
        hostMultiply(projection, view, camera);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glViewport(0, 0, width_, height_);
        glDepthMask(GL_TRUE);
        glClearBufferfv(GL_COLOR, 0, sky);
        glClearBufferfi(GL_DEPTH_STENCIL, 0, 1.0f, 0);
        glEnable(GL_DEPTH_TEST);
        glEnable(GL_CULL_FACE);
        glUseProgram(program_);
        glUniformMatrix4fv(0, 1, GL_FALSE, camera);
        glBindVertexArray(mesh_);
        glDrawArrays(GL_TRIANGLES, 0, vertexCount_);
    }

private:
    int width_, height_;
    GLuint buffers_[2] = {}; ///< color, depth
    GLuint framebuffer_ = 0, program_ = 0, mesh_ = 0;
    int vertexCount_ = 0;
};

class Game
{
public:
    explicit Game(const HostOptions& options) : options_(options), renderer_(options.width, options.height)
    {
        const FxGlLoader counted = hostCountCalls(&loader_); // measures; a game passes its loader
        // Exposure, and the light of the game: what it stores for white paper and for its sky, as linear
        // values.
        const FxViewSettings settings = hostLight();
        isRight_ = renderer_.isRight() && hostOpenEffects(&effects_, &counted, &settings);
    }
    ~Game() { hostCloseEffects(&effects_); }
    Game(const Game&) = delete;
    Game& operator=(const Game&) = delete;

    bool play()
    {
        for (int frame = 0; isRight_ && hostPlays(&options_, frame); ++frame) {
            isRight_ = fxScene_Update(effects_.scene, hostStep(&options_)) == FX_OK;
            if (isRight_ && hostDraws(&options_, frame))
                isRight_ = draw(true);
            if (!hostPresent(renderer_.framebuffer(), options_.width, options_.height))
                break;
        }
        if (!isRight_)
            std::fprintf(stderr, "ldr: %s\n", fxGetLastErrorMessage());
        return isRight_ && (!options_.output || report());
    }

private:
    bool draw(bool withEffects)
    {
        float view[16], projection[16];
        hostCamera(float(options_.width) / float(options_.height), 0, view, projection);
        renderer_.draw(view, projection);
        return !withEffects || drawEffects(view, projection);
    }

    /// The effects over codes of the display, before a HUD.
    bool drawEffects(const float view[16], const float projection[16]) const
    {
        FxFrameDef frame = fxDefaultFrameDef();
        std::copy_n(view, 16, frame.view);
        std::copy_n(projection, 16, frame.projection);
        frame.target = FX_TARGET_FRAMEBUFFER;
        frame.framebuffer = renderer_.framebuffer();
        frame.depthFromFramebuffer = 1;                // a renderbuffer, which is copied
        frame.targetEncoding = FX_TARGET_DISPLAY_SRGB; // otherwise codes would count as light
        frame.displayWhite = 1.0f;                     // code 255 is 1: colors are clamped, without a curve
        frame.width = options_.width;
        frame.height = options_.height;
        hostBeforeEffects(); // measures; a game leaves this out
        const FxResult result = fxView_Render(effects_.view, &frame);
        hostAfterEffects(&frame);
        return result == FX_OK;
    }

    bool report()
    {
        const HostReport report = {
            "ldr",
            "GL_RGBA8 renderbuffer, sRGB codes",
            "GL_DEPTH24_STENCIL8 renderbuffer, near to far",
            1,
            [](void* game, int with) { return int(static_cast<Game*>(game)->draw(with != 0)); },
            this,
            renderer_.framebuffer(),
            renderer_.framebuffer(),
            0};
        return hostReport(&report, &options_, &effects_);
    }

    HostOptions options_;
    Renderer renderer_;
    FxGlLoader loader_{nullptr, fxGetGlProcAddress}; ///< of the context that is current: EGL or GLX
    HostEffects effects_ = {};
    bool isRight_ = false;
};

} // namespace

int main(int argumentCount, char** arguments)
{
    HostOptions options;
    if (!hostParse(argumentCount, arguments, &options))
        return 2;
    bool isRight = hostOpenWindow(&options, "ldr");
    if (isRight) {
        Game game(options);
        isRight = game.play();
    }
    hostCloseWindow();
    return isRight ? 0 : 1;
}
