/// @file billboards.cpp
/// Blobs drawn one after the other, as the GPU draws them, against the integral through all of them. The same
/// formula texts as the shaders', on the processor, so that no OpenGL is needed.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/ray_settings.h"
#include "benchmarks/scenes/cards.h"
#include "rendering/reference/integral/ray_integrator.h"
#include "rendering/reference/integral/reference_integral.h"
#include "shaders/formulas/formula.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fx::cli {
namespace {

constexpr int kWidth = 72, kHeight = 45; // [pixel] over a field 2.4 m wide, parallel rays along z

struct CardRay
{
    float x, y, farthest; ///< [m]
};

enum class Form
{
    Planar,
    Constant,
    Kernel,
    Integral
};

/// What shaders/blobs/blob_ray.glsl does for one fragment.
float opticalDepth(Form form, const Card& card, float h, float farthest)
{
    if (form == Form::Planar)
        return card.z > 0.0f && card.z < farthest
                   ? formula::fxKernelOpticalDepth(card.crossSection, card.radius, h, 0.0f, -card.radius,
                                                   card.radius)
                   : 0.0f;
    if (form == Form::Constant)
        return formula::fxUniformBallOpticalDepth(card.crossSection, card.radius, h, card.z, 0.0f, farthest);
    return formula::fxKernelOpticalDepth(card.crossSection, card.radius, h, card.z, 0.0f, farthest);
}

/// Blobs laid over one another in the order of the list.
std::array<float, 3> drawn(Form form, const std::vector<Card>& cards, const CardRay& ray,
                           uint64_t& ioFragments)
{
    std::array<float, 3> light = {};
    for (const Card& card : cards) {
        const float dx = card.x - ray.x, dy = card.y - ray.y;
        const float h2 = dx * dx + dy * dy;
        if (h2 >= card.radius * card.radius)
            continue;
        ++ioFragments;
        const float alpha = 1.0f - std::exp(-opticalDepth(form, card, std::sqrt(h2), ray.farthest));
        for (size_t c = 0; c < 3; ++c)
            light[c] = light[c] * (1.0f - alpha) + alpha * card.emission[c];
    }
    return light;
}

template <class T>
std::vector<render::RayBlob<T>> blobsOfRay(const std::vector<Card>& cards, const CardRay& ray)
{
    std::vector<render::RayBlob<T>> blobs;
    for (size_t i = 0; i < cards.size(); ++i) {
        const Card& card = cards[i];
        const T dx = T(card.x) - T(ray.x), dy = T(card.y) - T(ray.y), r = T(card.radius);
        const T chord2 = r * r - (dx * dx + dy * dy);
        const T center = T(card.crossSection) * T(1.04445431404056) / (r * r * r); // kernel-optical-depth (1)
        if (chord2 > T(0))
            blobs.push_back({T(card.z),
                             chord2,
                             r,
                             center,
                             {T(card.emission[0]), T(card.emission[1]), T(card.emission[2])},
                             uint32_t(i)});
    }
    return blobs;
}

class BillboardAccuracy final : public CountedAccuracy
{
public:
    explicit BillboardAccuracy(const std::string& scene);

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    std::optional<MeasuredWork> work(size_t setting) override;

protected:
    double items() const override { return double(rays_.size()); }
    void judge(size_t setting, AccuracySample& outSample) override;

private:
    void makeReference();
    std::vector<double> errors() const;

    std::string scene_;
    std::vector<AccuracySetting> settings_;
    std::vector<Card> cards_; ///< in drawing order
    std::vector<CardRay> rays_;
    std::vector<std::array<float, 3>> lights_;
    std::vector<std::array<double, 3>> reference_;
    nlohmann::json counters_;
};

BillboardAccuracy::BillboardAccuracy(const std::string& scene) : scene_(scene)
{
    const uint32_t count = uint32_t(std::atoi(scene.c_str() + scene.rfind('-') + 1));
    const bool isWrong = scene.find("wrong") != std::string::npos;
    cards_ = scene.rfind("isolated", 0) == 0 ? isolatedCards(count) : overlappingCards(count);
    std::stable_sort(cards_.begin(), cards_.end(),
                     [isWrong](const Card& a, const Card& b) { return isWrong ? a.z < b.z : a.z > b.z; });
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float px = (float(x) + 0.5f - 0.5f * kWidth) * 2.4f / kWidth;
            const float py = (float(y) + 0.5f - 0.5f * kHeight) * 2.4f / kWidth;
            // a wall behind the left half; the ground rises through the blobs of the right half
            rays_.push_back({px, py, px < 0.0f ? std::numeric_limits<float>::infinity() : 2.0f + 0.8f * py});
        }
    lights_.resize(rays_.size());
    const nlohmann::json parameters = {{"blobs", count},
                                       {"order", isWrong ? "front to back" : "back to front"}};
    settings_ = {{"kernel", "default", parameters},
                 {"planar", "low", parameters},
                 {"constant", "", parameters},
                 {"gauss-5", "high", parameters}};
}

std::optional<MeasuredWork> BillboardAccuracy::work(size_t setting)
{
    constexpr Form kForms[] = {Form::Kernel, Form::Planar, Form::Constant, Form::Integral};
    const Form form = kForms[setting];
    if (form != Form::Integral) {
        uint64_t fragments = 0;
        const MeasuredWork measured = measureWork([&] {
            for (size_t i = 0; i < rays_.size(); ++i)
                lights_[i] = drawn(form, cards_, rays_[i], fragments);
        });
        counters_ = {{"rays", rays_.size()}, {"fragments", fragments}};
        return measured;
    }
    render::RayIntegrator<float> integrator({});
    const MeasuredWork measured = measureWork([&] {
        for (size_t i = 0; i < rays_.size(); ++i) {
            const render::RayWindow<float> window{0.0f, rays_[i].farthest, {}};
            lights_[i] = integrator.integrate(blobsOfRay<float>(cards_, rays_[i]), window).radiance;
        }
    });
    counters_ = toJson(integrator.work());
    return measured;
}

void BillboardAccuracy::makeReference()
{
    const auto exponential = [](double x) { return std::exp(x); };
    for (const CardRay& ray : rays_) {
        const std::vector<render::RayBlob<double>> blobs = blobsOfRay<double>(cards_, ray);
        const render::RayWindow<double> window{0.0, double(ray.farthest), {}};
        render::ReferenceIntegral<double, decltype(exponential)> integral(
            blobs, window, 2, false, 1e-11, [](double x) { return std::sqrt(x); }, exponential);
        reference_.push_back(integral.light());
    }
}

/// Of channels above a thousandth of the brightest: what the eye compares.
std::vector<double> BillboardAccuracy::errors() const
{
    double brightest = 0;
    for (const std::array<double, 3>& light : reference_)
        brightest = std::max({brightest, light[0], light[1], light[2]});
    std::vector<double> errors;
    for (size_t i = 0; i < reference_.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            if (reference_[i][c] > 1e-3 * brightest)
                errors.push_back(double(lights_[i][c]) / reference_[i][c] - 1.0);
    return errors;
}

void BillboardAccuracy::judge(size_t, AccuracySample& outSample)
{
    if (reference_.empty())
        makeReference();
    storeErrors(errors(), outSample);
    outSample.work = counters_;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<BillboardAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry billboardsAccuracy()
{
    return {"billboards",
            "planar, constant and kernel billboards against the integral",
            "ray",
            ShownError::P99,
            {"isolated-1", "isolated-10", "isolated-270", "overlapping-10", "overlapping-270",
             "sorted-wrong-10", "sorted-wrong-270"},
            7,
            false,
            make};
}

} // namespace fx::cli
