#include "host_report.h"

#include "gl_counts.h"
#include "gl_state.h"
#include "host_scene.h"
#include "offscreen_gl.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <stdexcept>

namespace {

using Floats = std::vector<float>;

constexpr int kPairs = 11; // of frames with and without saving of state

struct Measured
{
    bool isOn = false;
    FxFrameDef frame;
    host::GlState before, after;
    host::GlCounts counts;
} measured;

void check(bool isRight, const char* what)
{
    if (!isRight)
        throw std::runtime_error(std::string(what) + ": " + fxGetLastErrorMessage());
}

void check(FxResult result)
{
    check(result == FX_OK, "fxsdk");
}

/// RGBA as stored, lower row first. Half and byte values are exact in floats.
Floats readTarget(GLuint framebuffer, int width, int height)
{
    Floats pixels(size_t(width) * size_t(height) * 4);
    glFinish(); // llvmpipe with GLX has returned pixels from before the last draws without it
    GLint before = 0, pack = 0;
    glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
    glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(before));
    glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(pack));
    return pixels;
}

void writeDisplay(const HostReport& report, const HostOptions& options)
{
    const Floats pixels = readTarget(report.displayFramebuffer, options.width, options.height);
    std::vector<uint8_t> bytes;
    bytes.reserve(pixels.size());
    for (int y = options.height - 1; y >= 0; --y)
        for (int x = 0; x < options.width; ++x)
            for (int c = 0; c < 3; ++c)
                bytes.push_back(
                    uint8_t(std::lround(255.0f * pixels[size_t((y * options.width + x) * 4 + c)])));
    example::writePng(options.output, options.width, options.height, bytes);
}

/// Sum of all media of a frame without glare and shimmer: RGBA, exposed and premultiplied.
/// @param frame camera and depth; the target is another
Floats mediaOf(HostEffects& effects, FxFrameDef frame)
{
    FxViewSettings settings = hostLight();
    settings.layerOutputs = 1;
    settings.dazzle = 0;
    settings.shimmerStrength = 0.0f;
    FxView* view = nullptr;
    check(fxCreateView(effects.context, effects.scene, &settings, &view));
    example::Picture picture(frame.width, frame.height);
    const float black[4] = {};
    picture.clear(black);
    frame.target = FX_TARGET_TEXTURE;
    frame.targetEncoding = FX_TARGET_LINEAR;
    frame.colorTexture = picture.color();
    frame.resetHistory = 1;
    check(fxView_Render(view, &frame));
    FxLayerTextures textures = {};
    textures.structSize = sizeof textures;
    check(fxView_GetLayerTextures(view, &textures));
    Floats media(size_t(frame.width) * size_t(frame.height) * 4);
    glGetTextureImage(textures.media, 0, GL_RGBA, GL_FLOAT, GLsizei(media.size() * sizeof(float)),
                      media.data());
    check(fxDestroyView(view));
    return media;
}

/// The media before the same scene, with camera and depth of this file: 32-bit floats, near to far, one
/// sample.
/// @param outLight receives the scene without the media: RGBA, exposed
Floats referenceMedia(HostEffects& effects, int width, int height, Floats& outLight)
{
    example::Picture picture(width, height);
    const float sky[4] = {kHostSky[0], kHostSky[1], kHostSky[2], 1.0f};
    picture.clear(sky);
    GLuint framebuffer = 0;
    glCreateFramebuffers(1, &framebuffer);
    glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, picture.color(), 0);
    glNamedFramebufferTexture(framebuffer, GL_DEPTH_ATTACHMENT, picture.depth(), 0);
    FxFrameDef frame = fxDefaultFrameDef();
    hostCamera(float(width) / float(height), 0, frame.view, frame.projection);
    float camera[16];
    hostMultiply(frame.projection, frame.view, camera);
    int count = 0;
    const GLuint mesh = hostMakeMesh(&count);
    const GLuint program = hostMakeProgram(kHostVertexGlsl, kHostShadeGlsl,
                                           "in vec3 normal;\nin vec3 albedo;\nout vec4 color;\n"
                                           "void main() { color = vec4(hostShade(albedo, normal), 1.0); }\n");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width, height);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const GLenum what : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST})
        glDisable(what);
    glBindProgramPipeline(0);
    glUseProgram(program);
    glUniformMatrix4fv(0, 1, GL_FALSE, camera);
    glBindVertexArray(mesh);
    glDrawArrays(GL_TRIANGLES, 0, count);
    outLight.resize(size_t(width) * size_t(height) * 4);
    glGetTextureImage(picture.color(), 0, GL_RGBA, GL_FLOAT, GLsizei(outLight.size() * sizeof(float)),
                      outLight.data());
    frame.depthTexture = picture.depth();
    frame.width = width;
    frame.height = height;
    Floats media = mediaOf(effects, frame);
    glDeleteFramebuffers(1, &framebuffer);
    return media;
}

struct Comparison
{
    int covered = 0;        ///< pixels with media
    int outsideChanged = 0; ///< pixels without media whose bits differ
    int visible = 0;        ///< pixels whose media a display of 8 bits shows
    int visibleChanged = 0; ///< those of them that the target shows as well
};

Comparison compare(const Floats& without, const Floats& with, const Floats& media)
{
    constexpr float kVisible = 0.02f; // of white, above the steps of every format and code
    Comparison result;
    for (size_t i = 0; i < without.size(); i += 4) {
        const bool isChanged = !std::equal(&without[i], &without[i] + 4, &with[i]);
        const float most = std::max({media[i], media[i + 1], media[i + 2]});
        const bool isCovered = most > 0.0f || media[i + 3] > 0.0f;
        const bool isVisible = most > kVisible && media[i + 3] < 0.5f;
        result.covered += isCovered;
        result.outsideChanged += !isCovered && isChanged;
        result.visible += isVisible;
        result.visibleChanged += isVisible && isChanged;
    }
    return result;
}

/// Root mean square difference of two sums of media, each value limited to white, over the covered pixels.
double errorOf(const Floats& media, const Floats& wanted)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < media.size(); i += 4) {
        if (wanted[i + 3] <= 0.0f && media[i + 3] <= 0.0f)
            continue;
        for (size_t c = 0; c < 4; ++c) {
            const double difference =
                double(std::min(media[i + c], 1.0f)) - double(std::min(wanted[i + c], 1.0f));
            sum += difference * difference;
            ++count;
        }
    }
    return count ? std::sqrt(sum / double(count)) : 0.0;
}

/// Codes of the display for exposed light, as kHostToneMapGlsl.
void toneMap(float rgb[3])
{
    constexpr float kWhite = 8.0f, kGray = 0.18f, kRest = 1.0f - kGray, kLargest = (kWhite - kGray) / kRest;
    for (int c = 0; c < 3; ++c)
        rgb[c] = std::clamp(rgb[c], 0.0f, kWhite);
    const float mean = (rgb[0] + rgb[1] + rgb[2]) / 3.0f;
    const float share = 0.22f * std::max({rgb[0], rgb[1], rgb[2]}) / kWhite;
    for (int c = 0; c < 3; ++c) {
        const float light = rgb[c] + share * (mean - rgb[c]);
        const float t = std::max(light - kGray, 0.0f) / kRest;
        const float y = std::min(light, kGray) + kRest * t * (1.0f + t / (kLargest * kLargest)) / (1.0f + t);
        rgb[c] = y <= 0.0031308f ? 12.92f * y : 1.055f * std::pow(y, 1.0f / 2.4f) - 0.055f;
    }
}

/// Mean difference of the display's picture, in steps of 8 bits and over the covered pixels, from the media
/// over the scene with the same curve.
double displayErrorOf(const Floats& shown, const Floats& media, const Floats& light)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < media.size(); i += 4) {
        if (media[i + 3] <= 0.0f)
            continue;
        float rgb[3];
        for (size_t c = 0; c < 3; ++c)
            rgb[c] = media[i + c] + (1.0f - media[i + 3]) * light[i + c];
        toneMap(rgb);
        for (size_t c = 0; c < 3; ++c)
            sum += std::abs(double(shown[i + c]) - double(rgb[c])) * 255.0;
        count += 3;
    }
    return count ? sum / double(count) : 0.0;
}

/// Turns rows around.
Floats mirrored(const Floats& pixels, int width)
{
    const size_t row = size_t(width) * 4, rows = pixels.size() / row;
    Floats result(pixels.size());
    for (size_t y = 0; y < rows; ++y)
        std::copy_n(&pixels[y * row], row, &result[(rows - 1 - y) * row]);
    return result;
}

struct StateCost
{
    uint64_t calls = 0, queries = 0; ///< of one frame with saving, beyond those of a frame without
    double ratio = 0.0; ///< shortest processor time of fxView_Render() with saving by that without
};

/// [s] processor time of the calling thread. It depends little on what else the machine does.
double secondsOfThread()
{
    timespec time = {};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Draws the same frame in pairs.
StateCost costOfState(HostEffects& effects, FxViewSettings settings)
{
    StateCost cost;
    host::GlCounts counts[2];
    double shortest[2] = {1e9, 1e9};             // [s]
    for (int pair = -1; pair < kPairs; ++pair) { // the first pair warms up
        for (uint32_t i = 0; i < 2; ++i) {
            const uint32_t saves = (i + uint32_t(pair)) & 1u; // each is the first one in every other pair
            settings.saveState = saves;
            check(fxView_SetSettings(effects.view, &settings));
            glFinish();
            host::resetCounts();
            const double begin = secondsOfThread();
            check(fxView_Render(effects.view, &measured.frame));
            const double seconds = secondsOfThread() - begin;
            if (pair >= 0)
                shortest[saves] = std::min(shortest[saves], seconds);
            counts[saves] = host::counts();
        }
    }
    cost.calls = counts[1].calls - counts[0].calls;
    cost.queries = counts[1].queries - counts[0].queries;
    cost.ratio = shortest[1] / shortest[0];
    return cost;
}

void run(const HostReport& report, const HostOptions& options, HostEffects& effects, FxViewSettings settings)
{
    const auto draw = [&](int withEffects) {
        check(report.draw(report.host, withEffects) != 0, "the host");
        return readTarget(report.targetFramebuffer, options.width, options.height);
    };
    writeDisplay(report, options);
    settings.dazzle = 0; // glare and shimmer reach pixels beyond the media
    settings.shimmerStrength = 0.0f;
    settings.saveState = options.hostRestores ? 0 : 1;
    check(fxView_SetSettings(effects.view, &settings));
    const Floats without = draw(0);
    measured.isOn = true;
    const Floats with = draw(1);
    measured.isOn = false;
    const Floats shown = readTarget(report.displayFramebuffer, options.width, options.height);
    FxViewStatistics statistics = {};
    statistics.structSize = sizeof statistics;
    check(fxView_GetStatistics(effects.view, &statistics));
    check(statistics.glCalls == measured.counts.calls && host::uncountedFunctions().empty(),
          "calls of OpenGL were missed");
    const Floats later = draw(0);
    // The depth of the host still lies in its target.
    const Floats media = mediaOf(effects, measured.frame);
    Floats light;
    const Floats wanted = referenceMedia(effects, options.width, options.height, light);
    const double displayError = displayErrorOf(shown, wanted, light);
    const double error = errorOf(report.isMirrored ? mirrored(media, options.width) : media, wanted);
    const Comparison result = compare(without, with, media);
    const int differences = host::printDifferences(measured.before, measured.after);
    const StateCost cost = costOfState(effects, settings);
    const char* text =
        "{\"host\": \"%s\", \"renderer\": \"%s\", \"target_format\": \"%s\", \"depth\": \"%s\", \"samples\": "
        "%d, "
        "\"pixels_covered\": %d, \"pixels_visible\": %d, \"pixels_visible_changed\": %d, "
        "\"pixels_outside_changed\": %d, \"later_frame_changed\": %s, \"media_error\": %.6f, "
        "\"display_error\": %.3f, "
        "\"gl_state_values\": %zu, \"gl_state_differences\": %d, \"gl_calls\": %llu, \"state_calls\": %llu, "
        "\"state_queries\": %llu, \"state_cost_ratio\": %.3f}\n";
    std::printf(text, report.name, reinterpret_cast<const char*>(glGetString(GL_RENDERER)),
                report.targetFormat, report.depth, report.samples, result.covered, result.visible,
                result.visibleChanged, result.outsideChanged, later == without ? "false" : "true", error,
                displayError, measured.before.size(), differences,
                static_cast<unsigned long long>(measured.counts.calls),
                static_cast<unsigned long long>(cost.calls), static_cast<unsigned long long>(cost.queries),
                cost.ratio);
}

} // namespace

FxGlLoader hostCountCalls(const FxGlLoader* real)
{
    return host::countedLoader(*real);
}

void hostBeforeEffects(void)
{
    if (!measured.isOn)
        return;
    measured.before = host::readGlState();
    host::resetCounts();
}

void hostAfterEffects(const FxFrameDef* frame)
{
    measured.frame = *frame;
    if (!measured.isOn)
        return;
    measured.counts = host::counts();
    measured.after = host::readGlState();
}

int hostReport(const HostReport* report, const HostOptions* options, HostEffects* effects)
{
    try {
        run(*report, *options, *effects, hostLight());
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", report->name, error.what());
        return 0;
    }
}
