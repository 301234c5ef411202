// fx bench layer-scale: what drawing media at 1/2 and 1/4 of the picture's size saves and costs: a cloud seen
// from outside and from inside, alone and among pillars before a wall. Prints one JSON object a case and
// scale: least wall time and processor time of a frame, fragments estimated and counted, and errors against
// full size relative to the brightest value. Fails when the estimate is no estimate or the picture is another
// one.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "foundation/random/philox.h"
#include "foundation/snapshot/blob_kind.h"
#include "foundation/snapshot/frame_snapshot.h"
#include "fxsdk/cli/support/json_line.h"
#include "fxsdk/techniques.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/platform/gl_context.h"
#include "rendering/stage/stage_camera.h"
#include "rendering/view/view_renderer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

constexpr float kNear = 0.1f;        ///< [m]
constexpr double kWorstError = 0.15; ///< p99 at 1/4, of the brightest value

struct Options
{
    int width = 480;
    int height = 300;
    int blobs = 1000;
    int repeat = 5;
    bool isSmall = false;
};

struct Case
{
    const char* name;
    double eye; ///< [m] before the middle of the cloud, whose radius is 3 m
    bool hasPillars;
};
constexpr Case kCases[] = {{"outside", 8.0, false},
                           {"outside-pillars", 8.0, true},
                           {"inside", 0.5, false},
                           {"inside-pillars", 0.5, true}};

struct Cost
{
    double wallMs = 1e30;
    double processorMs = 1e30; ///< of all threads
};

/// Glowing smoke in a ball of 3 m, optical depth across about 3.
base::FrameSnapshot cloud(const base::SnapshotSchema& schema, size_t count)
{
    namespace column = base::blob_column;
    base::FrameSnapshot snapshot(&schema, std::pmr::get_default_resource());
    snapshot.begin(0, 1);
    auto& group = snapshot.addGroup(schema.find(base::kBlobKind.name), count);
    for (size_t c = 0; c < column::Count; ++c)
        std::fill_n(group.editColumn(c).begin(), count, 0.0f);
    for (size_t i = 0; i < count; ++i) {
        const auto u = base::randomUnit4(3, 0, i, base::RandomPurpose::Position);
        const auto v = base::randomUnit4(3, 1, i, base::RandomPurpose::Attributes);
        const auto set = [&](size_t c, float value) { group.editColumn(c)[i] = value; };
        const float z = 2.0f * u[0] - 1.0f;
        const float angle = 6.2831853f * u[1];
        const float r = 3.0f * std::cbrt(u[2]);
        set(column::PositionX, r * std::sqrt(1.0f - z * z) * std::cos(angle));
        set(column::PositionY, r * z);
        set(column::PositionZ, r * std::sqrt(1.0f - z * z) * std::sin(angle));
        set(column::Radius, 0.3f + 0.4f * u[3]);
        set(column::CrossSection, 85.0f * v[0] / float(count) * 2.0f);
        for (size_t k = 0; k < 3; ++k)
            set(column::EmissionR + k, 2.0f * v[1]);
        group.editIds()[i] = i;
    }
    group.editInfo().count = uint32_t(count);
    group.editConstants()[base::blob_constant::Layer] = float(uint32_t(base::MediaLayer::Smoke));
    return snapshot;
}

class Drawing
{
public:
    explicit Drawing(const Options& options)
        : options_(options), gl_(taken(render::createEglContext({}))),
          device_(taken(render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource()))),
          color_(texture(GL_RGBA32F)), depth_(texture(GL_DEPTH_COMPONENT32F))
    {
        preset::registerKinds(schema_);
        snapshot_.emplace_back(cloud(schema_, size_t(options.blobs)));
        view_ =
            std::make_unique<render::ViewRenderer>(device_.get(), &schema_, std::pmr::get_default_resource());
        view_->settings().dazzle.enabled = false;
        view_->settings().exposureEv100 = 0.0f;
        std::vector<float> stored; // pillars 3 m away, each 40th of the width apart, before a wall
        for (int i = 0; i < options.width * options.height; ++i)
            stored.push_back(1.0f -
                             kNear / ((i % options.width) * 40 / options.width % 2 == 0 ? 3.0f : 15.0f));
        device_->gl.TextureSubImage2D(depth_.name(), 0, 0, 0, options.width, options.height,
                                      GL_DEPTH_COMPONENT, GL_FLOAT, stored.data());
    }

    const std::string& name() const { return device_->limits().renderer; }

    Cost draw(const Case& scene, int divisor)
    {
        view_->settings().layerDivisor = divisor;
        Cost least;
        for (int i = 0; i < options_.repeat + 1; ++i) { // the first may compile
            const Cost cost = drawOnce(scene);
            if (i > 0)
                least = {std::min(least.wallMs, cost.wallMs), std::min(least.processorMs, cost.processorMs)};
        }
        return least;
    }

    /// With `fragments` counted, which costs time of its own.
    render::FrameStatistics count(const Case& scene)
    {
        view_->settings().countOverdraw = true;
        drawOnce(scene);
        view_->settings().countOverdraw = false;
        return view_->statistics();
    }
    std::vector<float> read()
    {
        return render::readTexture(*device_, color_.name(), options_.width, options_.height, 4);
    }

private:
    render::GlTexture texture(GLenum format)
    {
        return taken(render::GlTexture::create(*device_, options_.width, options_.height, format, "picture"));
    }

    Cost drawOnce(const Case& scene)
    {
        const float black[4] = {0.0f, 0.0f, 0.0f, 0.0f};
        device_->gl.ClearTexImage(color_.name(), 0, GL_RGBA, GL_FLOAT, black);
        device_->gl.Finish();
        render::FrameRequest request;
        request.camera = render::perspectiveView({{0.0, 0.0, scene.eye}, {0.0, 0.0, -20.0}, {0, 1, 0}}, 1.0f,
                                                 float(options_.width) / float(options_.height), kNear);
        request.targets.color = color_.name();
        request.targets.depth = scene.hasPillars ? depth_.name() : 0;
        request.targets.width = options_.width;
        request.targets.height = options_.height;
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t processor = std::clock();
        if (const base::Status status = view_->render({&snapshot_[0], nullptr}, request); !status)
            fail(status.message());
        device_->gl.Finish();
        return {std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
                1e3 * double(std::clock() - processor) / double(CLOCKS_PER_SEC)};
    }

    Options options_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_;
    render::GlTexture color_, depth_;
    base::SnapshotSchema schema_;
    std::vector<base::FrameSnapshot> snapshot_;
    std::unique_ptr<render::ViewRenderer> view_;
};

/// Sorted differences where there is a medium, relative to the brightest value.
std::vector<double> errorsOf(const std::vector<float>& picture, const std::vector<float>& exact)
{
    const float most = *std::max_element(exact.begin(), exact.end());
    std::vector<double> errors;
    for (size_t i = 0; i < exact.size(); ++i)
        if (exact[i] > 1e-3f * most)
            errors.push_back(double(std::abs(picture[i] - exact[i]) / most));
    std::sort(errors.begin(), errors.end());
    return errors;
}

void measure(Options options)
{
    if (options.isSmall)
        options.width = 240, options.height = 150, options.blobs = 1000, options.repeat = 1;
    if (options.width < 8 || options.height < 8)
        fail("--size: 8x8 or more");
    Drawing drawing(options);
    Machine machine = readMachine();
    machine.glRenderer = drawing.name();
    bool asStated = true;
    for (const Case& scene : kCases) {
        std::vector<float> exact;
        for (const int divisor : {1, 2, 4}) {
            const Cost cost = drawing.draw(scene, divisor);
            const std::vector<float> picture = drawing.read();
            if (divisor == 1)
                exact = picture;
            const std::vector<double> errors = errorsOf(picture, exact);
            const render::FrameStatistics counted = drawing.count(scene);
            const double ratio = double(counted.estimatedFragments) / double(counted.shadedFragments);
            const double p99 = errors[errors.size() * 99 / 100];
            asStated = asStated && p99 < kWorstError && ratio > 0.95 && (scene.hasPillars || ratio < 1.6);
            const nlohmann::json line = {{"name", "layer_scale"},
                                         {"scene", scene.name},
                                         {"layer_scale", 1.0 / divisor},
                                         {"blobs", options.blobs},
                                         {"width", options.width},
                                         {"height", options.height},
                                         {"ms_frame", cost.wallMs},
                                         {"ms_processor", cost.processorMs},
                                         {"fragments_estimated", counted.estimatedFragments},
                                         {"fragments_counted", counted.shadedFragments},
                                         {"error_p50", errors[errors.size() / 2]},
                                         {"error_p99", p99},
                                         {"error_max", errors.back()}};
            printJsonLine(withMachine(line, machine));
        }
    }
    if (!asStated)
        fail("the estimate or the picture is not what it is said to be");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    addSizeOption(command, options->width, options->height);
    command.add_option("--blobs", options->blobs, "Of the cloud")->check(CLI::Range(1, 10'000'000));
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement layerScaleBench()
{
    return {
        "layer-scale",
        "A cloud drawn at 1/2 and 1/4 of the picture's size: time, fragments and errors against full size",
        addOptions};
}

} // namespace fx::cli
