// fx bench slices: what the planes of one light cost: a sun and a light at a point, over a cloud of 100, 1000
// and 10,000 balls and 8 to 128 planes. Prints one JSON object a case: least wall time of the dispatch that
// fills the planes, and the largest difference to those of the processor, as a share of the largest depth.
// Fails when that is above 1e-5, or when the same input gives other bits.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/slice_forms.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/gl/gl_texture.h"
#include "rendering/lights/slices/light_list.h"
#include "rendering/lights/slices/light_slices_pass.h"
#include "rendering/lights/slices/slice_depths.h"
#include "rendering/platform/gl_context.h"

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

namespace fx::cli {
namespace {

using render::MediumCaster;
using render::SliceResolution;

constexpr double kWorstError = 1e-5; ///< of the largest depth

struct Options
{
    int texels = 128;
    int repeat = 5;
    bool isSmall = false;
};

/// Balls that overlap as much as those of smoke do, however many there are.
std::vector<MediumCaster> smoke(uint32_t count)
{
    std::vector<MediumCaster> casters = lightCloud(count, 3.0);
    const float size = std::cbrt(100.0f / float(count));
    for (MediumCaster& caster : casters)
        caster.radius *= size;
    return casters;
}

/// A list with one light alone.
class OneLight
{
public:
    OneLight(bool isPoint, const SliceResolution& resolution, std::span<const MediumCaster> casters)
    {
        settings_.lighting.groundAlbedo = 0.0f;
        settings_.lighting.sunDirection = glm::normalize(glm::vec3(0.3f, 0.8f, 0.5f));
        settings_.lighting.sunIlluminance = glm::vec3(isPoint ? 0.0f : 1e5f);
        settings_.slices.resolution = resolution;
        settings_.hostLights.count = isPoint ? 1 : 0;
        settings_.hostLights.lights[0].position = {0.5, 2.0, 0.0};
        settings_.hostLights.lights[0].intensity = glm::vec3(100.0f);
        list.build({&settings_, glm::dvec3(0.0), {}, casters});
    }

    render::LightList list{std::pmr::get_default_resource()};

private:
    render::ViewSettings settings_;
};

class Filling
{
public:
    Filling()
        : gl_(taken(render::createEglContext({}))),
          device_(taken(render::GlDevice::create(gl_->loader(), std::pmr::get_default_resource()))),
          backend_(*device_, std::pmr::get_default_resource())
    {}

    const std::string& renderer() const { return device_->limits().renderer; }

    /// [ms] of the fastest of some fillings.
    double fill(const render::LightList& list, std::span<const MediumCaster> casters, int repeat)
    {
        std::vector<glm::vec4> blocks;
        for (const MediumCaster& caster : casters) {
            blocks.emplace_back(caster.center, caster.radius);
            blocks.emplace_back(caster.crossSection, 0.0f, 0.0f, 0.0f);
        }
        const auto upload = [&](std::span<const std::byte> bytes, const char* name) {
            render::GlBuffer buffer = taken(render::GlBuffer::create(*device_, bytes.size(), name));
            device_->gl.NamedBufferSubData(buffer.name(), 0, GLsizeiptr(bytes.size()), bytes.data());
            return buffer;
        };
        casters_ = upload(std::as_bytes(std::span(blocks)), "casters");
        stacks_ = upload(std::as_bytes(list.stackBlocks()), "stacks");
        atlas_ = taken(
            render::GlTexture::create(*device_, list.atlasWidth(), list.atlasHeight(), GL_RG32F, "planes"));
        double least = 1e30;
        for (int i = 0; i < repeat + 1; ++i) { // the first compiles
            const double ms = fillOnce(list, uint32_t(casters.size()));
            least = i > 0 ? std::min(least, ms) : least;
        }
        return least;
    }

    std::vector<float> read()
    {
        return render::readTexture(*device_, atlas_.name(), atlas_.width(), atlas_.height(), 2);
    }

private:
    double fillOnce(const render::LightList& list, uint32_t count)
    {
        graph_.begin();
        const auto casters = graph_.importBuffer({"casters", casters_.bytes()}, casters_.name());
        const auto stacks = graph_.importBuffer({"stacks", stacks_.bytes()}, stacks_.name());
        const auto atlas = graph_.importTexture(
            {"planes", atlas_.width(), atlas_.height(), render::Format::RG32F}, atlas_.name());
        graph_.keep(render::LightSlicesPass::addTo(graph_, {casters, stacks, atlas, count,
                                                            uint32_t(list.stackBlocks().size()),
                                                            list.mostTexels(), list.mostPlanes()})
                        .atlas);
        graph_.compile();
        device_->gl.Finish();
        const auto start = std::chrono::steady_clock::now();
        if (backend_.beginFrame(graph_))
            graph_.execute(backend_);
        const base::Status status = backend_.endFrame();
        device_->gl.Finish();
        if (!status)
            fail(status.message());
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }

    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::GlDevice> device_;
    render::GlBackend backend_;
    render::FrameGraph graph_{std::pmr::get_default_resource()};
    render::GlBuffer casters_, stacks_;
    render::GlTexture atlas_;
};

/// Largest difference to the planes of the processor, as a share of the largest depth.
double errorOf(const render::LightList& list, const std::vector<float>& atlas,
               std::span<const MediumCaster> casters)
{
    render::SliceDepths depths(std::pmr::get_default_resource());
    depths.build(list.stacks()[0], casters);
    const glm::vec4& tiles = list.stackBlocks()[0].tiles;
    const int side = int(tiles.z);
    double worst = 0.0, most = 0.0;
    for (int k = 0; k < int(tiles.w); ++k)
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                const int column = int(tiles.x) + side * (k % render::kSliceTileColumns) + x;
                const int row = int(tiles.y) + side * (k / render::kSliceTileColumns) + y;
                const float got = atlas[2 * (size_t(row) * size_t(list.atlasWidth()) + size_t(column))];
                worst = std::max(worst, double(std::abs(got - depths.at(k, x, y))));
                most = std::max(most, double(depths.at(k, x, y)));
            }
    return worst / most;
}

void measureCase(Filling& filling, const Options& options, const Machine& machine, bool isPoint,
                 uint32_t count, int planes)
{
    const std::vector<MediumCaster> casters = smoke(count);
    const int asked = isPoint ? 2 * planes : planes; // a list gives points half
    const OneLight light(isPoint, {options.texels, asked}, casters);
    const double ms = filling.fill(light.list, casters, options.repeat);
    const std::vector<float> atlas = filling.read();
    (void)filling.fill(light.list, casters, 1);
    if (filling.read() != atlas)
        fail("the same light and media give other planes");
    const double error = errorOf(light.list, atlas, casters);
    const SliceResolution& used = light.list.stacks()[0].resolution;
    const nlohmann::json line = {
        {"name", "slices"},
        {"light", isPoint ? "point" : "parallel"},
        {"blobs", count},
        {"planes", used.planes},
        {"texels", used.texels},
        {"ms_light", ms},
        {"bytes", size_t(used.planes) * size_t(used.texels) * size_t(used.texels) * 8},
        {"error_of_largest_depth", error}};
    printJsonLine(withMachine(line, machine));
    if (!(error <= kWorstError))
        fail("the planes are not those of the processor");
}

void measure(Options options)
{
    std::vector<uint32_t> counts{100, 1000, 10000};
    std::vector<int> planes{8, 16, 32, 64, 128};
    if (options.isSmall) {
        options.texels = 32;
        options.repeat = 1;
        counts.pop_back();
        planes = {8, 32};
    }
    Filling filling;
    Machine machine = readMachine();
    machine.glRenderer = filling.renderer();
    for (const bool isPoint : {false, true})
        for (const uint32_t count : counts)
            for (const int k : planes)
                measureCase(filling, options, machine, isPoint, count, k);
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    command
        .add_option("--texels", options->texels, "Along a side of a plane of the sun; a point has half of it")
        ->check(CLI::Range(8, 512));
    command.add_option("--repeat", options->repeat, "Fillings of which the least time is taken")
        ->check(CLI::Range(1, 1'000'000));
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement slicesBench()
{
    return {"slices",
            "Milliseconds a light for planes of optical depth across it, over balls of medium and planes",
            addOptions};
}

} // namespace fx::cli
