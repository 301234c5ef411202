/// @file outputs.cpp
/// How true the outputs of a view are: instance, motion and depths by OpenGL against those of the reference
/// renderer, in all compositions, and the depths of their layers beside them.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/chance.h"
#include "fxsdk/cli/render/blob_list_renderer.h"
#include "rendering/reference/render/reference_renderer.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <memory>
#include <optional>

namespace fx::cli {
namespace {

namespace channel = render::reference_channel;

constexpr int kWidth = 160, kHeight = 90;
constexpr double kFrame = 1.0 / 30.0; ///< [s]
constexpr double kTold = 0.05;        ///< [1] opacity from which on depths and motion are compared

enum class Value
{
    Instance,   ///< [1] pixels with another one
    Motion,     ///< [pixel]
    FirstDepth, ///< [1] of the radius of the scene, as the next two
    MeanDepth,
    LayerDepth,   ///< of the composition's own layers
    OpticalDepth, ///< [1] transmittance, as the next
    LayerOpticalDepth
};

struct OutputSetting
{
    const char* name;
    Value value;
};
constexpr OutputSetting kValues[] = {{"id", Value::Instance},
                                     {"motion", Value::Motion},
                                     {"first-depth", Value::FirstDepth},
                                     {"mean-depth", Value::MeanDepth},
                                     {"optical-depth", Value::OpticalDepth},
                                     {"layer-depth", Value::LayerDepth},
                                     {"layer-optical-depth", Value::LayerOpticalDepth}};
constexpr std::pair<const char*, render::Composition> kCompositions[] = {
    {"sorted", render::Composition::Sorted},
    {"slabs-16", render::Composition::Slabs},
    {"volume-96", render::Composition::Volume}};

/// Clouds beside and within each other, each an instance that moves as a whole.
std::vector<render::MediumBlob> cloudsOf(const std::string& scene)
{
    const bool isOne = scene == "ball";
    const size_t count = isOne ? 1 : 60, clouds = isOne ? 1 : 3;
    bench::Chance chance(11);
    std::vector<render::MediumBlob> blobs;
    for (size_t cloud = 0; cloud < clouds; ++cloud) {
        const double side = double(cloud) - 0.5 * double(clouds - 1);
        const glm::dvec3 middle(0.9 * side, 0.2 * side * side, -0.6 * side);
        for (size_t i = 0; i < count; ++i) {
            render::MediumBlob blob;
            const auto within = [&] { return isOne ? 0.0 : 0.7 * (2.0 * chance() - 1.0); };
            blob.center = middle + glm::dvec3(within(), within(), within());
            blob.radius = isOne ? 1.0 : 0.35 + 0.2 * chance();
            blob.crossSection = (isOne ? 2.0 : 0.5 + chance()) * blob.radius * blob.radius;
            blob.source = glm::dvec3(1.0);
            blob.instance = cloud + 1;
            blob.velocity = {1.0 - double(cloud), 0.5 * side, 1.5 * side};
            blobs.push_back(blob);
        }
    }
    return blobs;
}

render::ReferenceCamera cameraAt(double time)
{
    auto camera =
        render::ReferenceCamera::lookAt({0.6 * time, 0.3, 5.0}, {0.2 * time, 0.0, 0.0}, {0.0, 1.0, 0.0});
    camera.halfHeight = 0.4;
    return camera;
}

class OutputAccuracy final : public AccuracyTechnique
{
public:
    explicit OutputAccuracy(const std::string& scene) : scene_(scene), blobs_(cloudsOf(scene))
    {
        for (const auto& [composition, value] : kCompositions)
            for (const OutputSetting& one : kValues)
                settings_.push_back({std::string(composition) + "-" + one.name, "", {{"output", one.name}}});
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>&) override
    {
        if (!reference_)
            if (base::Status status = drawReference(); !status)
                return status;
        const size_t composition = setting / std::size(kValues);
        if (!pictures_[composition])
            if (base::Status status = draw(composition); !status)
                return status;
        AccuracySample sample;
        sample.items = double(kWidth) * kHeight;
        sample.seconds = seconds_[composition];
        storeErrors(errorsOf(*pictures_[composition], kValues[setting % std::size(kValues)].value), sample);
        return sample;
    }

private:
    base::Status drawReference()
    {
        render::ReferenceScene scene;
        scene.blobs = blobs_;
        scene.opaque.isEmpty = true;
        scene.camera = cameraAt(kFrame);
        render::ReferenceSettings settings;
        settings.width = kWidth;
        settings.height = kHeight;
        settings.outputs = true;
        settings.past = {cameraAt(0.0), kFrame};
        const auto tasks = base::makeSerialRunner();
        reference_.emplace();
        base::Status status = reference_->build(scene, settings, *tasks);
        return status ? reference_->render(nullptr, {}) : status;
    }

    base::Status draw(size_t composition)
    {
        render::ViewSettings settings;
        settings.exposureEv100 = 0.0f;
        settings.dazzle.enabled = false;
        settings.layerOutputs = true;
        settings.outputs = render::view_output::kAll;
        settings.composition = kCompositions[composition].second;
        auto renderer = BlobListRenderer::create(blobs_, settings, kWidth, kHeight);
        if (!renderer.ok())
            return renderer.status();
        for (const double time : {0.0, kFrame})
            if (base::Status status = (*renderer)->render(cameraAt(time), time); !status)
                return status;
        seconds_[composition] = 1e-3 * (*renderer)->pictures().millisecondsRender();
        pictures_[composition] = (*renderer)->pictures().read();
        return {};
    }

    std::vector<double> errorsOf(const FrameLayers& drawn, Value value) const
    {
        std::vector<double> errors;
        const auto& truth = *reference_;
        for (size_t i = 0; i < size_t(kWidth) * kHeight; ++i) {
            const double depth = truth.pixels(channel::OpticalDepth)[i];
            const double whole = std::exp(-depth);
            const auto distance = [&](const Picture& picture, uint32_t of) {
                if (1.0 - whole > kTold)
                    errors.push_back(double(picture.pixels[i]) - double(truth.pixels(of)[i]));
            };
            switch (value) {
            case Value::Instance:
                errors.push_back(
                    drawn.outputs.instance.pixels[i] == truth.pixels(channel::InstanceId)[i] ? 0.0 : 1.0);
                break;
            case Value::Motion:
                if (1.0 - whole > kTold)
                    errors.push_back(std::hypot(double(drawn.outputs.motion.pixels[2 * i]) -
                                                    double(truth.pixels(channel::MotionX)[i]),
                                                double(drawn.outputs.motion.pixels[2 * i + 1]) -
                                                    double(truth.pixels(channel::MotionY)[i])));
                break;
            case Value::FirstDepth:
                distance(drawn.outputs.firstDepth, channel::FirstDepth);
                break;
            case Value::MeanDepth:
                distance(drawn.outputs.meanDepth, channel::Depth);
                break;
            case Value::LayerDepth:
                distance(drawn.depth, channel::Depth);
                break;
            case Value::OpticalDepth:
                errors.push_back(std::exp(-double(drawn.outputs.opticalDepth.pixels[i])) - whole);
                break;
            case Value::LayerOpticalDepth:
                errors.push_back(std::exp(-double(drawn.opticalDepth.pixels[i])) - whole);
                break;
            }
        }
        return errors;
    }

    std::string scene_;
    std::vector<render::MediumBlob> blobs_;
    std::vector<AccuracySetting> settings_;
    std::optional<render::ReferenceRenderer> reference_;
    std::array<std::optional<FrameLayers>, std::size(kCompositions)> pictures_;
    std::array<double, std::size(kCompositions)> seconds_{};
};

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<OutputAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry outputsAccuracy()
{
    return {
        "outputs",
        "instance [share of wrong pixels], motion [pixel], depths [m] and transmittance of a view's outputs "
        "against the reference renderer",
        "pixel",
        ShownError::P99,
        {"ball", "clouds"},
        2,
        false,
        make};
}

} // namespace fx::cli
