// fx bench detail: what detail of fields costs. Effects of the library with detail, drawn in turn without it,
// with 64 voxels and three octaves, with 128 and five, and ball by ball with the detail of each ball. Prints
// one JSON object a scene, size and setting: least time of a frame and of a pixel, its ratio to the field
// without detail in the same round, reads of the noise texture of a covered pixel, bytes of textures, bytes
// of a particle for its coordinates. Fails when nothing was drawn, or when detail changes nothing.
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/detail_scene.h"
#include "foundation/snapshot/material_kind.h"
#include "fxsdk/cli/render/blob_snapshot.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/gl/gl_buffer.h"
#include "rendering/gl/gl_device.h"
#include "rendering/passes/blob_instance.h"
#include "shaders/shader_library.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {
namespace {

struct Options
{
    int repeat = 5;
    bool isSmall = false;
};

struct Setting
{
    const char* name;
    render::Composition composition;
    int voxels;
    bool isDetailed; ///< the coordinates of balls are drawn
};
/// The first two are what the following are compared with.
constexpr Setting kSettings[] = {{"off-64", render::Composition::Volume, 64, false},
                                 {"off-128", render::Composition::Volume, 128, false},
                                 {"field-64", render::Composition::Volume, 64, true},
                                 {"field-128", render::Composition::Volume, 128, true},
                                 {"balls", render::Composition::Sorted, 128, true}};

/// Counts how often the march through fields reads the texture of noise. The program is changed for that, so
/// that the count is of the work that is timed.
class NoiseCounter
{
public:
    explicit NoiseCounter(render::GlDevice& device)
        : device_(device), reads_(taken(render::GlBuffer::create(device, sizeof(uint32_t), "noise reads")))
    {
        device_.setSourceOverride([](std::string_view name, std::string_view defines) {
            return name == "field/field_march.frag.glsl" ? counting(name, defines) : std::nullopt;
        });
        device_.forgetPrograms();
        const uint32_t none = 0;
        device_.gl.NamedBufferSubData(reads_.name(), 0, sizeof none, &none);
        device_.gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, kBinding, reads_.name(), 0, sizeof none);
    }
    ~NoiseCounter()
    {
        device_.setSourceOverride({});
        device_.forgetPrograms();
    }

    /// Reads since the object was created.
    uint32_t reads()
    {
        uint32_t count = 0;
        device_.gl.GetNamedBufferSubData(reads_.name(), 0, sizeof count, &count);
        return count;
    }

private:
    static constexpr uint32_t kBinding = 15; ///< no program of the view uses it

    static std::optional<std::string> counting(std::string_view name, std::string_view defines)
    {
        constexpr std::string_view kRead = "float lumpAt(vec3 u) { return";
        std::optional<std::string> text = shaders::assemble(name, defines);
        if (!text)
            return text;
        const size_t at = text->find(kRead);
        if (at == std::string::npos)
            fail("field/field_detail.glsl has no lumpAt() of one line any more");
        text->replace(at, kRead.size(),
                      "layout(std430, binding = 15) buffer NoiseReads { uint noiseReads; };\n"
                      "float lumpAt(vec3 u) { atomicAdd(noiseReads, 1u); return");
        return text;
    }

    render::GlDevice& device_;
    render::GlBuffer reads_;
};

/// One scene and size.
struct Painter
{
    Painter(const DetailScene& from, int width, int height)
        : scene(from), blobs(from.reference(0).blobs),
          renderer(taken(SnapshotRenderer::create(from.schema(), detailViewSettings(), width, height)))
    {}

    /// Draws the scene without anything that the view has kept of the picture before.
    /// @return [ms]
    double draw(const Setting& setting)
    {
        render::ViewSettings& settings = renderer->settings();
        settings.composition = setting.composition;
        settings.voxels = setting.voxels;
        smooth.emplace(snapshotOfBlobs(blobs, scene.schema(), ++frames));
        settings.exposureEv100 = 14.5f + 1e-4f * float(frames); // nothing of the frame before is kept
        const SceneMoment moment =
            setting.isDetailed ? scene.moment() : SceneMoment{{&*smooth, nullptr}, 1.0};
        if (const base::Status status = renderer->render(moment, scene.camera(), 1.0); !status)
            fail(status.message());
        return renderer->millisecondsRender();
    }
    std::vector<float> picture() { return renderer->read().color.pixels; }

    const DetailScene& scene;
    std::vector<render::MediumBlob> blobs;
    std::unique_ptr<SnapshotRenderer> renderer;
    std::optional<base::FrameSnapshot> smooth; ///< of the last frame
    uint64_t frames = 0;
};

void report(Painter& painter, size_t k, const std::vector<std::vector<double>>& times, int width, int height,
            const Machine& machine)
{
    const Setting& setting = kSettings[k];
    std::vector<double> ratios;
    for (size_t i = 0; i < times[k].size(); ++i)
        ratios.push_back(times[k][i] / times[setting.voxels == 64 ? 0 : 1][i]);
    std::sort(ratios.begin(), ratios.end());
    painter.draw(setting);
    const render::FrameStatistics& drawn = painter.renderer->statistics();
    const std::vector<float> picture = painter.picture();
    size_t covered = 0;
    for (size_t i = 3; i < picture.size(); i += 4)
        covered += picture[i] > 0.01f;
    if (covered == 0)
        fail("nothing was drawn");
    uint32_t reads = 0;
    if (setting.composition == render::Composition::Volume) {
        NoiseCounter counter(painter.renderer->device());
        painter.draw(setting);
        reads = counter.reads();
        if (setting.isDetailed != (reads > 0))
            fail("the noise is read without detail, or is not with it");
    }
    const double least = *std::min_element(times[k].begin(), times[k].end());
    const size_t perParticle = base::material_column::Count * sizeof(float);
    printJsonLine(withMachine({{"name", "detail"},
                               {"scene", painter.scene.subject().name},
                               {"setting", setting.name},
                               {"count", painter.blobs.size()},
                               {"width", width},
                               {"height", height},
                               {"ms_frame", least},
                               {"ns_pixel", 1e6 * least / (double(width) * double(height))},
                               {"ns_covered_pixel", 1e6 * least / double(covered)},
                               {"noise_reads_covered_pixel", double(reads) / double(covered)},
                               {"time_ratio", ratios[ratios.size() / 2]},
                               {"bytes_textures", drawn.textureBytes},
                               {"bytes_particle_snapshot", perParticle + sizeof(uint64_t)},
                               {"bytes_particle_gpu", sizeof(render::BlobMaterial)}},
                              machine));
}

void measureSize(const DetailScene& scene, int width, int height, const Options& options)
{
    Painter painter(scene, width, height);
    Machine machine = readMachine();
    machine.glRenderer = painter.renderer->rendererName();
    std::vector<std::vector<double>> times(std::size(kSettings));
    for (int round = -1; round < options.repeat; ++round) // the first may compile
        for (size_t k = 0; k < std::size(kSettings); ++k) {
            const double milliseconds = painter.draw(kSettings[k]);
            if (round >= 0)
                times[k].push_back(milliseconds);
        }
    painter.draw(kSettings[1]);
    const std::vector<float> smooth = painter.picture();
    painter.draw(kSettings[3]);
    const std::vector<float> detailed = painter.picture();
    double change = 0.0;
    for (size_t i = 3; i < smooth.size(); i += 4)
        change += std::abs(double(detailed[i] - smooth[i]));
    if (change < 1e-3 * double(smooth.size()))
        fail("the picture is the same without detail");
    for (size_t k = 0; k < std::size(kSettings); ++k)
        report(painter, k, times, width, height, machine);
}

void measure(Options options)
{
    if (options.isSmall)
        options.repeat = 1;
    for (const DetailSubject& subject : detailSubjects().first(options.isSmall ? 1 : 2)) {
        const auto scene = taken(DetailScene::create(subject));
        if (options.isSmall) {
            measureSize(*scene, 96, 54, options);
            continue;
        }
        measureSize(*scene, 640, 360, options);
        measureSize(*scene, 1280, 720, options);
    }
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement detailBench()
{
    return {"detail", "Time and memory of detail of fields, beside fields without it and detail of each ball",
            addOptions};
}

} // namespace fx::cli
