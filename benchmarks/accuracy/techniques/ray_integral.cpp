/// @file ray_integral.cpp
/// The error of the ray integral against its time: every scheme on the same rays.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/ray_settings.h"
#include "rendering/reference/integral/accuracy_cases.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace fx::cli {
namespace {

using render::IntegralSettings;

constexpr uint32_t kWidth = 480, kHeight = 300; // [pixel]
constexpr uint32_t kEvery = 29; // packets of 4 x 4 pixels: 310 of 9000, spread over the picture

class RayIntegralAccuracy final : public CountedAccuracy
{
public:
    RayIntegralAccuracy(const std::string& scene, double opticalDepth)
        : scene_(scene), opticalDepth_(opticalDepth),
          picture_(render::ballOfBlobs<float>(opticalDepth, kWidth, kHeight, kEvery)),
          settings_(schemeSettings({{"tau", opticalDepth}, {"blobs", 270}, {"precision", "float"}})),
          lights_(picture_.packets())
    {}

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    std::optional<MeasuredWork> work(size_t setting) override
    {
        render::PacketIntegrator<float> integrator(integralSettings(setting));
        picture_.integrate(integrator, 0, 1, lights_.data()); // its memory is made before
        return measureWork([&] { picture_.integrate(integrator, 0, picture_.packets(), lights_.data()); });
    }

protected:
    double items() const override { return double(picture_.packets() * render::kPacketRays); }

    void judge(size_t setting, AccuracySample& outSample) override
    {
        if (reference_.empty())
            makeReference();
        storeErrors(errors(), outSample);
        outSample.work = counters(setting);
    }

private:
    IntegralSettings integralSettings(size_t setting) const
    {
        IntegralSettings settings;
        settings.scheme = *render::parseScheme(settings_[setting].name);
        return settings;
    }

    void makeReference()
    {
        reference_ = render::referenceLight(
            render::ballOfBlobs<double>(opticalDepth_, kWidth, kHeight, kEvery), IntegralSettings());
        for (const std::array<double, 3>& light : reference_)
            brightest_ = std::max({brightest_, light[0], light[1], light[2]});
    }

    /// Of all channels that are not dark, as render::integralError() takes them.
    std::vector<double> errors() const
    {
        std::vector<double> errors;
        for (size_t ray = 0; ray < reference_.size(); ++ray)
            for (size_t c = 0; c < 3; ++c)
                if (reference_[ray][c] > 1e-6 * brightest_) {
                    const auto& radiance = lights_[ray / render::kPacketRays].radiance[c];
                    errors.push_back(double(radiance[ray % render::kPacketRays]) / reference_[ray][c] - 1.0);
                }
        return errors;
    }

    nlohmann::json counters(size_t setting)
    {
        render::PacketIntegrator<float> integrator(integralSettings(setting));
        integrator.countWork(true);
        picture_.integrate(integrator, 0, picture_.packets(), lights_.data());
        return toJson(integrator.work());
    }

    std::string scene_;
    double opticalDepth_;
    render::PacketPicture<float> picture_;
    std::vector<AccuracySetting> settings_;
    std::vector<render::PacketLight<float>> lights_;
    std::vector<std::array<double, 3>>
        reference_; ///< made when it is needed: counting instructions needs none
    double brightest_ = 0;
};

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<RayIntegralAccuracy>(scene,
                                                 std::atof(scene.c_str() + std::string("tau-").size()));
}

} // namespace

AccuracyTechniqueEntry rayIntegralAccuracy()
{
    return {"ray-integral",
            "light through 270 overlapping blobs, over schemes",
            "ray",
            ShownError::P99,
            {"tau-0.1", "tau-1", "tau-10", "tau-100"},
            4,
            false,
            make};
}

} // namespace fx::cli
