#include "fxsdk/cli/render/picture_renderer.h"

#include "rendering/reference/path/path_renderer.h"
#include "rendering/reference/render/reference_renderer.h"

#include <limits>
#include <numbers>
#include <utility>

namespace fx::cli {
namespace {

using render::ExrPrecision;

/// Adds RGBA of four channels from `first`.
template <class Renderer>
void addLayer(render::ExrImage& io, std::vector<std::vector<float>>& outPixels, const Renderer& renderer,
              const char* name, uint32_t first)
{
    outPixels.push_back(renderer.interleaved(first));
    render::addRgba(io, name, outPixels.back(), ExrPrecision::Float);
}

class ReferencePicture final : public PictureRenderer
{
public:
    ReferencePicture(const ReferenceArguments& arguments, const ReferencePlan& plan, int width, int height,
                     const render::ReferencePast* past)
        : arguments_(arguments)
    {
        settings_.outputs = past != nullptr;
        if (past)
            settings_.past = *past;
        settings_.width = width;
        settings_.height = height;
        settings_.samples = arguments.samples;
        settings_.isSingle = plan.isSingle;
        settings_.scattering = plan.scattering;
        settings_.skyRings = arguments.skyRings;
        settings_.integral = plan.integral;
    }

    base::Status build(const render::ReferenceScene& scene, double exposure, base::TaskRunner& tasks) override
    {
        settings_.exposure = exposure;
        return renderer_.build(scene, settings_, tasks);
    }
    uint64_t key() const override { return renderer_.key(); }
    uint32_t tileCount() const override { return renderer_.tileCount(); }
    void restore(uint32_t tile, std::span<const float> values) override { renderer_.restore(tile, values); }
    base::Status render(render::TileJournal* journal, const render::RenderCallbacks& callbacks) override
    {
        return renderer_.render(journal, callbacks);
    }
    void addChannels(render::ExrImage& io, std::vector<std::vector<float>>& outPixels) const override
    {
        namespace channel = render::reference_channel;
        for (const auto& [name, first] : {std::pair<const char*, uint32_t>{"", channel::Color},
                                          {"background", channel::Background},
                                          {"fire", channel::Fire},
                                          {"smoke", channel::Smoke},
                                          {"dust", channel::Dust}})
            addLayer(io, outPixels, renderer_, name, first);
        render::addPlane(io, "depth.Z", renderer_.pixels(channel::Depth), ExrPrecision::Float);
        render::addPlane(io, "opticalDepth.Y", renderer_.pixels(channel::OpticalDepth), ExrPrecision::Float);
        if (!settings_.outputs)
            return;
        render::addPlane(io, "id", renderer_.pixels(channel::InstanceId), ExrPrecision::Whole);
        render::addPlane(io, "motion.X", renderer_.pixels(channel::MotionX), ExrPrecision::Float);
        render::addPlane(io, "motion.Y", renderer_.pixels(channel::MotionY), ExrPrecision::Float);
        render::addPlane(io, "firstDepth.Z", renderer_.pixels(channel::FirstDepth), ExrPrecision::Float);
        render::addPlane(io, "meanDepth.Z", renderer_.pixels(channel::Depth), ExrPrecision::Float);
    }
    void addStatistics(nlohmann::json& io, double) const override
    {
        io["renderer"] = "reference";
        io["integrator"] = render::schemeName(settings_.integral.scheme);
        io["scattering"] = arguments_.scattering;
        if (settings_.scattering == render::ScatteringMode::Single)
            io["sky_directions"] = 4 * arguments_.skyRings * arguments_.skyRings;
        io["precision"] = arguments_.precision;
        io["rays"] = renderer_.work().rays;
        io["hits"] = renderer_.work().hits;
    }
    uint64_t nonFinite() const override { return renderer_.work().nonFinite; }

private:
    const ReferenceArguments& arguments_;
    render::ReferenceSettings settings_;
    render::ReferenceRenderer renderer_;
};

class PathPicture final : public PictureRenderer
{
public:
    PathPicture(const ReferenceArguments& arguments, int width, int height, std::optional<uint64_t> seed)
    {
        constexpr uint32_t kDefaultSamples = 64;
        constexpr uint32_t kMaxSamples = 65536; // where an error is asked for
        settings_.width = width;
        settings_.height = height;
        settings_.error = arguments.error.value_or(0.0);
        settings_.samples = arguments.paths.value_or(settings_.error > 0.0 ? kMaxSamples : kDefaultSamples);
        settings_.path.bounces = arguments.bounces.value_or(std::numeric_limits<uint32_t>::max());
        settings_.sunRadius = 0.5 * arguments.sunAngle * std::numbers::pi / 180.0;
        settings_.seed = seed.value_or(1);
    }

    base::Status build(const render::ReferenceScene& scene, double exposure, base::TaskRunner& tasks) override
    {
        settings_.exposure = exposure;
        return renderer_.build(scene, settings_, tasks);
    }
    uint64_t key() const override { return renderer_.key(); }
    uint32_t tileCount() const override { return renderer_.tileCount(); }
    void restore(uint32_t tile, std::span<const float> values) override
    {
        renderer_.restore(tile, values);
        isResumed_ = true;
    }
    base::Status render(render::TileJournal* journal, const render::RenderCallbacks& callbacks) override
    {
        return renderer_.render(journal, callbacks);
    }
    void addChannels(render::ExrImage& io, std::vector<std::vector<float>>& outPixels) const override
    {
        namespace channel = render::path_channel;
        addLayer(io, outPixels, renderer_, "", channel::Color);
        constexpr const char* kNames[] = {"variance.R", "variance.G", "variance.B"};
        for (uint32_t c = 0; c < 3; ++c)
            render::addPlane(io, kNames[c], renderer_.pixels(channel::Variance + c), ExrPrecision::Float);
        render::addPlane(io, "samples.Y", renderer_.pixels(channel::Samples), ExrPrecision::Float);
    }
    void addStatistics(nlohmann::json& io, double seconds) const override
    {
        const double error = renderer_.standardError();
        const render::PathWork work = renderer_.work();
        io["renderer"] = "path";
        io["bounces"] = settings_.path.bounces == std::numeric_limits<uint32_t>::max()
                            ? nlohmann::json(nullptr)
                            : nlohmann::json(settings_.path.bounces);
        io["paths"] = work.paths;
        io["collisions"] = work.collisions;
        io["standard_error"] = error;
        io["efficiency"] = error > 0.0 && !isResumed_ ? nlohmann::json(1.0 / (error * error * seconds))
                                                      : nlohmann::json(nullptr);
    }
    uint64_t nonFinite() const override { return renderer_.work().nonFinite; }

private:
    render::PathPictureSettings settings_;
    render::PathRenderer renderer_;
    bool isResumed_ = false; ///< the time of the earlier run is not known
};

} // namespace

std::unique_ptr<PictureRenderer> makeReferencePicture(const ReferenceArguments& arguments,
                                                      const ReferencePlan& plan, int width, int height,
                                                      const render::ReferencePast* past)
{
    return std::make_unique<ReferencePicture>(arguments, plan, width, height, past);
}

std::unique_ptr<PictureRenderer> makePathPicture(const ReferenceArguments& arguments, int width, int height,
                                                 std::optional<uint64_t> seed)
{
    return std::make_unique<PathPicture>(arguments, width, height, seed);
}

} // namespace fx::cli
