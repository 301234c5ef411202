// fx bench paper-frame: the case of the paper [UBT96], an explosion of 270 blobs, simulated, drawn and
// dazzled at 480x300. Prints one JSON object: time of each stage (median of N frames), frames a second of the
// whole (of the mean frame, simulation steps included), and what was drawn: the share of the picture that gas
// covers and the mean number of layers over each covered pixel, so that the figure cannot be had by drawing
// little. Times are of this machine; the paper's 15 s are of a CM-5 with 32 processors.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/cli/support/named_choice.h"
#include "fxsdk/fxsdk.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/stage/stage_camera.h"

#include <CLI/CLI.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::string_view kPreset = R"({
  "version": 1, "name": "paper",
  "ground": false,
  "gas": [{"name": "blobs", "particles": 270, "position": [0, 0, 0], "material": "petrol", "energy": 250000000,
           "soundSpeed": 30, "throwSpeed": 2.2, "opacity": 0.1, "growth": 0.9, "detailAmount": 0.8, "heat": 0}]
})";

struct Options
{
    int frames = 60; // one second: the fireball stays in the picture
    int width = 480;
    int height = 300;
    std::string form = "kernel";
    bool detail = false;
    bool isSmall = false;
};

/// Milliseconds of the stages of one frame.
struct FrameTime
{
    double update, submit, finish;
    double total() const { return update + submit + finish; }
};

uint32_t formOf(const std::string& name)
{
    return name == "planar"     ? uint32_t(FX_BILLBOARD_PLANAR)
           : name == "constant" ? uint32_t(FX_BILLBOARD_CONSTANT)
                                : uint32_t(FX_BILLBOARD_KERNEL);
}

void check(FxResult result, const char* what)
{
    if (result != FX_OK)
        fail(std::string(what) + ": " + fxGetLastErrorMessage());
}

double milliseconds(Clock::time_point from, Clock::time_point to)
{
    return std::chrono::duration<double, std::milli>(to - from).count();
}

double percentile(std::vector<double> values, double share)
{
    std::sort(values.begin(), values.end());
    return values[size_t(share * double(values.size() - 1) + 0.5)];
}

/// Runs the effect through the C API, as a game would.
class PaperCase
{
public:
    PaperCase(const Options& options, render::GlContext& gl, render::GlDevice& device)
        : options_(options), device_(device)
    {
        FxContextDef def = fxDefaultContextDef();
        loader_ = gl.loader();
        def.gl.user = &loader_;
        def.gl.getProcAddress = [](void* user, const char* name) {
            const auto& loader = *static_cast<render::GlLoader*>(user);
            return loader.getProcAddress(loader.user, name);
        };
        check(fxCreateContext(&def, &context_), "context");
        check(fxContext_WarmUp(context_), "warm-up");
        FxPresetId preset;
        check(fxLoadPresetText(context_, kPreset.data(), kPreset.size(), "paper", &preset), "preset");
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        check(fxCreateScene(context_, &sceneDef, &scene_), "scene");
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = preset;
        instance.seed = 7;
        FxInstanceId id;
        check(fxScene_CreateInstance(scene_, &instance, &id), "instance");
        settings_ = fxDefaultViewSettings();
        settings_.exposureEv100 = 12.0f;
        settings_.dazzleA = 0.02f;
        settings_.billboardForm = formOf(options.form);
        settings_.detail = options.detail ? 1 : 0;
        check(fxCreateView(context_, scene_, &settings_, &view_), "view");
        for (int i = 0; i < 15; ++i) // a quarter of a second: the fireball has grown
            check(fxScene_Update(scene_, 1.0 / 60.0), "update");
    }
    ~PaperCase()
    {
        fxDestroyView(view_);
        fxDestroyScene(scene_);
        fxDestroyContext(context_);
    }

    FrameTime frame(uint32_t color)
    {
        const float clear[4] = {0.02f, 0.03f, 0.04f, 1.0f};
        device_.gl.ClearTexImage(color, 0, GL_RGBA, GL_FLOAT, clear);
        device_.gl.Finish();
        const auto t0 = Clock::now();
        check(fxScene_Update(scene_, 1.0 / 60.0), "update");
        const auto t1 = Clock::now();
        render(color);
        const auto t2 = Clock::now();
        device_.gl.Finish();
        const auto t3 = Clock::now();
        return {milliseconds(t0, t1), milliseconds(t1, t2), milliseconds(t2, t3)};
    }

    /// Statistics of one more frame, with the fragments counted.
    FxViewStatistics count(uint32_t color)
    {
        settings_.countOverdraw = 1;
        check(fxView_SetSettings(view_, &settings_), "settings");
        render(color);
        FxViewStatistics statistics{};
        statistics.structSize = sizeof statistics;
        check(fxView_GetStatistics(view_, &statistics), "statistics");
        settings_.countOverdraw = 0;
        check(fxView_SetSettings(view_, &settings_), "settings");
        return statistics;
    }

    std::string hash() const
    {
        uint64_t value = 0;
        check(fxScene_GetStateHash(scene_, &value), "hash");
        char text[32];
        std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(value));
        return text;
    }

private:
    void render(uint32_t color)
    {
        const auto camera = render::perspectiveView({{0.0, 0.4, 14.6}, {0.0, 0.4, 0.0}}, 0.75f,
                                                    float(options_.width) / float(options_.height), 0.1f);
        FxFrameDef frame = fxDefaultFrameDef();
        std::copy_n(glm::value_ptr(camera.origin), 3, frame.origin);
        std::copy_n(glm::value_ptr(camera.view), 16, frame.view);
        std::copy_n(glm::value_ptr(camera.projection), 16, frame.projection);
        frame.colorTexture = color;
        frame.width = options_.width;
        frame.height = options_.height;
        check(fxView_Render(view_, &frame), "render");
    }

    Options options_;
    render::GlDevice& device_;
    render::GlLoader loader_;
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    FxView* view_ = nullptr;
    FxViewSettings settings_;
};

void measure(Options options)
{
    if (options.isSmall)
        options.frames = 4, options.width = 120, options.height = 75;
    auto gl = render::createEglContext({});
    if (!gl)
        fail(gl.status().message());
    auto device = render::GlDevice::create((*gl)->loader(), std::pmr::get_default_resource());
    if (!device)
        fail(device.status().message());
    auto color = render::GlTexture::create(**device, options.width, options.height, GL_RGBA32F, "picture");
    if (!color)
        fail(color.status().message());

    PaperCase paper(options, **gl, **device);
    std::vector<FrameTime> times;
    for (int i = 0; i < 10; ++i)
        paper.frame(color->name());
    const FxViewStatistics first = paper.count(color->name());
    for (int i = 0; i < options.frames; ++i)
        times.push_back(paper.frame(color->name()));
    const FxViewStatistics last = paper.count(color->name());

    const auto column = [&](auto member, double share) {
        std::vector<double> values;
        for (const FrameTime& t : times)
            values.push_back(member(t));
        return percentile(values, share);
    };
    const auto total = [](const FrameTime& t) { return t.total(); };
    double mean = 0.0;
    for (const FrameTime& t : times)
        mean += t.total() / double(times.size());
    const double pixels = double(options.width) * options.height;
    const auto coverage = [&](const FxViewStatistics& s) { return double(s.coveredPixels) / pixels; };
    const auto overdraw = [](const FxViewStatistics& s) {
        return double(s.shadedFragments) / std::max(double(s.coveredPixels), 1.0);
    };
    Machine machine = readMachine();
    machine.glRenderer = (*device)->limits().renderer;
    printJsonLine(withMachine({{"name", "paper_frame"},
                               {"variant", options.form + (options.detail ? "+detail" : "")},
                               {"count", 270},
                               {"blobs", last.blobs},
                               {"width", options.width},
                               {"height", options.height},
                               {"frames", options.frames},
                               {"ms_update", column([](const FrameTime& t) { return t.update; }, 0.5)},
                               {"ms_submit", column([](const FrameTime& t) { return t.submit; }, 0.5)},
                               {"ms_finish", column([](const FrameTime& t) { return t.finish; }, 0.5)},
                               {"ms_frame_median", column(total, 0.5)},
                               {"ms_frame_p95", column(total, 0.95)},
                               {"ms_frame_mean", mean},
                               {"frames_per_second", 1000.0 / mean},
                               {"coverage", std::min(coverage(first), coverage(last))},
                               {"overdraw", std::min(overdraw(first), overdraw(last))},
                               {"hash", paper.hash()}},
                              machine));
    const bool asStated =
        std::min(coverage(first), coverage(last)) >= 0.5 && std::min(overdraw(first), overdraw(last)) >= 8.0;
    if (!asStated)
        fail(
            "the picture is not the paper's case: at least half of it must be covered, by at least 8 layers");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command.add_option("--frames", options->frames, "Of which the median is taken")
        ->check(CLI::Range(1, 1'000'000));
    command.add_option("--form", options->form, "Of the billboards: planar, constant or kernel")
        ->check(oneOf({"planar", "constant", "kernel"}));
    command.add_flag("--detail", options->detail, "Procedural detail");
    addSizeOption(command, options->width, options->height);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement paperFrameBench()
{
    return {"paper-frame",
            "The case of the paper [UBT96], an explosion of 270 blobs: time of each stage of a frame",
            addOptions};
}

} // namespace fx::cli
