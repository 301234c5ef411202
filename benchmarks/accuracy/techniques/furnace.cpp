/// @file furnace.cpp
/// Blobs that all emit 1: whatever their depth and overlap, the light has to be 1 - exp(-tau).

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/ray_settings.h"
#include "foundation/random/philox.h"
#include "rendering/reference/integral/ray_integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::cli {
namespace {

double random(uint64_t seed, uint32_t i, uint32_t k)
{
    return double(base::toUnitFloat(base::philox({i, 0, 0, 0}, seed)[k]));
}

template <class T>
struct FurnaceRay
{
    std::vector<render::RayBlob<T>> blobs;
    double light = 0; ///< 1 - exp(-tau), of the numbers as T holds them
};

/// [1] optical depth of all blobs of the ray, chord by chord
template <class T>
double opticalDepth(const std::vector<render::RayBlob<T>>& blobs)
{
    double sum = 0;
    for (const render::RayBlob<T>& blob : blobs) {
        const double q2 = double(blob.chord2) / (double(blob.radius) * double(blob.radius));
        sum += double(blob.extinction) * 16.0 / 15.0 * q2 * q2 * std::sqrt(double(blob.chord2));
    }
    return sum;
}

/// Chords of any share of their blob, lying across each other the more the more there are.
template <class T>
FurnaceRay<T> makeRay(double depth, uint32_t count, uint64_t seed)
{
    FurnaceRay<T> ray;
    for (uint32_t i = 0; i < count; ++i) {
        const double half = 0.1 + 1.9 * random(seed, i, 0);
        const double radius = half * (1.0 + random(seed, i, 1));
        ray.blobs.push_back({T(2.0 + 10.0 * random(seed, i, 2) / count),
                             T(half * half),
                             T(radius),
                             T(0.2 + 0.8 * random(seed, i, 3)),
                             {T(1), T(1), T(1)},
                             i});
    }
    const double scale = depth / opticalDepth(ray.blobs);
    for (render::RayBlob<T>& blob : ray.blobs)
        blob.extinction = T(double(blob.extinction) * scale);
    ray.light = -std::expm1(-opticalDepth(ray.blobs));
    return ray;
}

template <class T>
class FurnaceAccuracy final : public CountedAccuracy
{
public:
    explicit FurnaceAccuracy(const std::string& scene)
        : scene_(scene),
          settings_(schemeSettings({{"precision", scene}, {"tau", {1e-3, 1e5}}, {"blobs", {1, 64}}}))
    {
        for (const uint32_t count : {1u, 2u, 4u, 8u, 16u, 32u, 64u})
            for (int step = -75; step <= 125; ++step) // 25 a decade
                rays_.push_back(makeRay<T>(std::pow(10.0, step / 25.0), count,
                                           uint64_t(count) * 1000 + uint64_t(step + 75)));
        lights_.resize(rays_.size());
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    std::optional<MeasuredWork> work(size_t setting) override
    {
        render::IntegralSettings settings;
        settings.scheme = *render::parseScheme(settings_[setting].name);
        render::RayIntegrator<T> integrator(settings);
        integrator.integrate(rays_.back().blobs, kWindow);
        integrator.clearWork();
        const MeasuredWork measured = measureWork([&] {
            for (size_t i = 0; i < rays_.size(); ++i)
                lights_[i] = integrator.integrate(rays_[i].blobs, kWindow);
        });
        counters_ = integrator.work();
        return measured;
    }

protected:
    double items() const override { return double(rays_.size()); }

    void judge(size_t, AccuracySample& outSample) override
    {
        double excess = 0; // light that was created
        std::vector<double> errors;
        for (size_t i = 0; i < rays_.size(); ++i) {
            errors.push_back(double(lights_[i].radiance[0]) / rays_[i].light - 1.0);
            excess = std::max(excess, errors.back());
        }
        storeErrors(std::move(errors), outSample);
        outSample.work = toJson(counters_);
        outSample.work["excess"] = excess;
    }

private:
    static constexpr render::RayWindow<T> kWindow{
        T(-10), std::numeric_limits<T>::infinity(), {T(0), T(0), T(0)}};

    std::string scene_;
    std::vector<AccuracySetting> settings_;
    std::vector<FurnaceRay<T>> rays_;
    std::vector<render::RayLight<T>> lights_;
    render::RayWork counters_;
};

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    if (scene == "double")
        return std::make_unique<FurnaceAccuracy<double>>(scene);
    return std::make_unique<FurnaceAccuracy<float>>(scene);
}

} // namespace

AccuracyTechniqueEntry furnaceAccuracy()
{
    return {"furnace",
            "blobs that emit 1 against 1 - exp(-tau), over schemes",
            "ray",
            ShownError::P99,
            {"float", "double"},
            2,
            false,
            make};
}

} // namespace fx::cli
