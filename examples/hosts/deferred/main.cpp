// host_deferred [--headless FILE.png] [--frames N] [--size WxH]
//
// A deferred renderer: surfaces go into a G-buffer of four samples, a light pass shades each sample into
// GL_RGBA16F, effects are blended over the samples, the samples are resolved, a curve of the host makes the
// picture for the display. Shows: effects in a target of several samples with its depth, before resolving
// and tone mapping.
#include "host_effects.h"
#include "host_options.h"
#include "host_report.h"
#include "host_scene.h"
#include "host_window.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstdio>

namespace {

constexpr int kSamples = 4;

constexpr const char* kSurface = R"(
in vec3 normal;
in vec3 albedo;
layout(location = 0) out vec4 albedoOut;
layout(location = 1) out vec4 normalOut;
void main()
{
    albedoOut = vec4(albedo, 1.0);
    normalOut = vec4(normal, 0.0);
}
)";

/// Shades every sample, as it uses gl_SampleID.
constexpr const char* kLight = R"(
layout(binding = 0) uniform sampler2DMS albedos;
layout(binding = 1) uniform sampler2DMS normals;
layout(binding = 2) uniform sampler2DMS depths;
layout(location = 0) uniform vec3 sky;
out vec4 color;
void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 albedo = texelFetch(albedos, at, gl_SampleID).rgb;
    vec3 normal = texelFetch(normals, at, gl_SampleID).xyz;
    bool isSky = texelFetch(depths, at, gl_SampleID).r == 1.0;
    color = vec4(isSky ? sky : hostShade(albedo, normal), 1.0);
}
)";

constexpr const char* kDisplay = R"(
layout(binding = 0) uniform sampler2D light;
out vec4 color;
void main() { color = vec4(hostToneMap(texelFetch(light, ivec2(gl_FragCoord.xy), 0).rgb), 1.0); }
)";

/// The game's renderer, without effects.
class Renderer
{
public:
    Renderer(int width, int height) : width_(width), height_(height)
    {
        glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 4, samples_);
        const GLenum formats[] = {GL_RGBA8, GL_RGBA16F, GL_DEPTH_COMPONENT32F, GL_RGBA16F};
        for (int i = 0; i < 4; ++i)
            glTextureStorage2DMultisample(samples_[i], kSamples, formats[i], width, height, GL_TRUE);
        glCreateTextures(GL_TEXTURE_2D, 1, &resolved_);
        glTextureStorage2D(resolved_, 1, GL_RGBA16F, width, height);
        glCreateRenderbuffers(1, &display_);
        glNamedRenderbufferStorage(display_, GL_RGBA8, width, height);

        glCreateFramebuffers(4, framebuffers_);
        const GLenum drawn[] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
        glNamedFramebufferTexture(framebuffers_[GBuffer], drawn[0], samples_[Albedo], 0);
        glNamedFramebufferTexture(framebuffers_[GBuffer], drawn[1], samples_[Normal], 0);
        glNamedFramebufferTexture(framebuffers_[GBuffer], GL_DEPTH_ATTACHMENT, samples_[Depth], 0);
        glNamedFramebufferDrawBuffers(framebuffers_[GBuffer], 2, drawn);
        glNamedFramebufferTexture(framebuffers_[Lit], drawn[0], samples_[Light], 0);
        glNamedFramebufferTexture(framebuffers_[Resolved], drawn[0], resolved_, 0);
        glNamedFramebufferRenderbuffer(framebuffers_[Display], drawn[0], GL_RENDERBUFFER, display_);

        surface_ = hostMakeProgram(kHostVertexGlsl, "", kSurface);
        light_ = hostMakeProgram(kHostFullScreenGlsl, kHostShadeGlsl, kLight);
        toneMap_ = hostMakeProgram(kHostFullScreenGlsl, kHostToneMapGlsl, kDisplay);
        mesh_ = hostMakeMesh(&vertexCount_);
        glCreateVertexArrays(1, &noVertices_);
    }

    bool isRight() const { return surface_ && light_ && toneMap_; }
    GLuint lightTexture() const { return samples_[Light]; }
    GLuint depthTexture() const { return samples_[Depth]; }
    GLuint resolvedFramebuffer() const { return framebuffers_[Resolved]; }
    GLuint displayFramebuffer() const { return framebuffers_[Display]; }

    void drawGBuffer(const float view[16], const float projection[16]) const
    {
        const float none[4] = {}, farthest = 1.0f;
        float camera[16];
        hostMultiply(projection, view, camera);
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[GBuffer]);
        glViewport(0, 0, width_, height_);
        glDepthMask(GL_TRUE);
        glClearBufferfv(GL_COLOR, 0, none);
        glClearBufferfv(GL_COLOR, 1, none);
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        glEnable(GL_DEPTH_TEST);
        glUseProgram(surface_);
        glUniformMatrix4fv(0, 1, GL_FALSE, camera);
        glBindVertexArray(mesh_);
        glDrawArrays(GL_TRIANGLES, 0, vertexCount_);
        glDisable(GL_DEPTH_TEST);
    }

    void drawLight() const
    {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[Lit]);
        glUseProgram(light_);
        glUniform3fv(0, 1, kHostSky);
        for (const GLuint unit : {Albedo, Normal, Depth})
            glBindTextureUnit(unit, samples_[unit]);
        drawFullScreen();
    }

    void resolve() const
    {
        glBlitNamedFramebuffer(framebuffers_[Lit], framebuffers_[Resolved], 0, 0, width_, height_, 0, 0,
                               width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }

    void toneMap() const
    {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffers_[Display]);
        glUseProgram(toneMap_);
        glBindTextureUnit(0, resolved_);
        drawFullScreen();
    }

private:
    enum Samples : GLuint
    {
        Albedo,
        Normal,
        Depth,
        Light
    };
    enum Framebuffer
    {
        GBuffer,
        Lit,
        Resolved,
        Display
    };

    void drawFullScreen() const
    {
        glBindVertexArray(noVertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    int width_, height_;
    GLuint samples_[4] = {};
    GLuint resolved_ = 0, display_ = 0;
    GLuint framebuffers_[4] = {};
    GLuint surface_ = 0, light_ = 0, toneMap_ = 0, mesh_ = 0, noVertices_ = 0;
    int vertexCount_ = 0;
};

class Game
{
public:
    explicit Game(const HostOptions& options) : options_(options), renderer_(options.width, options.height)
    {
        const FxGlLoader counted = hostCountCalls(&loader_); // measures; a game passes its loader
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
            if (!hostPresent(renderer_.displayFramebuffer(), options_.width, options_.height))
                break;
        }
        if (!isRight_)
            std::fprintf(stderr, "deferred: %s\n", fxGetLastErrorMessage());
        return isRight_ && (!options_.output || report());
    }

private:
    bool draw(bool withEffects)
    {
        float view[16], projection[16];
        hostCamera(float(options_.width) / float(options_.height), 0, view, projection);
        renderer_.drawGBuffer(view, projection);
        renderer_.drawLight();
        if (withEffects && !drawEffects(view, projection))
            return false;
        renderer_.resolve();
        renderer_.toneMap();
        return true;
    }

    /// The effects over the lit samples. Media are computed once for each pixel and blended over its samples.
    bool drawEffects(const float view[16], const float projection[16]) const
    {
        FxFrameDef frame = fxDefaultFrameDef();
        std::copy_n(view, 16, frame.view);
        std::copy_n(projection, 16, frame.projection);
        frame.colorTexture = renderer_.lightTexture();
        frame.depthTexture = renderer_.depthTexture();
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
            "deferred",
            "GL_RGBA16F, linear",
            "GL_DEPTH_COMPONENT32F, near to far",
            kSamples,
            [](void* game, int with) { return int(static_cast<Game*>(game)->draw(with != 0)); },
            this,
            renderer_.resolvedFramebuffer(),
            renderer_.displayFramebuffer(),
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
    bool isRight = hostOpenWindow(&options, "deferred");
    if (isRight) {
        Game game(options);
        isRight = game.play();
    }
    hostCloseWindow();
    return isRight ? 0 : 1;
}
