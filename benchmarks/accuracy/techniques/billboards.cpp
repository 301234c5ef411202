/// @file billboards.cpp
/// Blobs drawn one after the other, as the GPU draws them, against the integral through all of them. The same
/// formula texts as the shaders', on the processor. Settings that are named after a composition are pictures
/// of a view, drawn by OpenGL: its own lists, shaders and rounding; their time is that of the whole frame.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/ray_settings.h"
#include "benchmarks/scenes/card_picture.h"
#include "benchmarks/scenes/explosion_cards.h"
#include "fxsdk/cli/support/interrupt.h"
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

/// What a view draws, instead of a Form.
struct GlSetting
{
    std::string_view name;
    render::Composition composition;
    int slabs = 16;
    int voxels = 96;
};
constexpr GlSetting kGlSettings[] = {{"sorted", render::Composition::Sorted},
                                     {"slabs-6", render::Composition::Slabs, 6},
                                     {"slabs-16", render::Composition::Slabs, 16},
                                     {"volume-64", render::Composition::Volume, 16, 64},
                                     {"volume-128", render::Composition::Volume, 16, 128}};
constexpr Form kForms[] = {Form::Kernel, Form::Planar, Form::Constant, Form::Integral};

class BillboardAccuracy final : public AccuracyTechnique
{
public:
    explicit BillboardAccuracy(const std::string& scene);

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;
    std::optional<MeasuredWork> work(size_t setting) override;

private:
    void makeRays(float field, bool hasGround);
    void makeReference();
    base::Status drawByGl(const GlSetting& setting, double& outSeconds);
    base::Status makePicture();
    double brightest() const;
    std::vector<double> errors(double least = 0.0) const;
    double visibleError() const;

    std::string scene_;
    std::vector<AccuracySetting> settings_;
    std::vector<Card> cards_; ///< in drawing order
    std::vector<CardRay> rays_;
    std::vector<std::array<float, 3>> lights_;
    std::vector<std::array<double, 3>> reference_;
    nlohmann::json counters_;
    base::Status status_; ///< of the scene
    float field_ = 2.4f;  ///< [m] that the width of the picture shows
    bool isWrong_ = false;
    std::unique_ptr<CardPicture> picture_; ///< made when it is needed
};

BillboardAccuracy::BillboardAccuracy(const std::string& scene) : scene_(scene)
{
    isWrong_ = scene.find("wrong") != std::string::npos;
    const bool isExplosion = scene.rfind("explosion", 0) == 0;
    const double number = std::atof(scene.c_str() + scene.rfind('-') + 1);
    if (isExplosion) {
        base::Result<std::vector<Card>> cards = explosionCards(number);
        status_ = cards.status();
        if (cards)
            cards_ = std::move(*cards);
        field_ = kExplosionField;
    } else {
        cards_ = scene.rfind("isolated", 0) == 0 ? isolatedCards(uint32_t(number))
                                                 : overlappingCards(uint32_t(number));
    }
    std::stable_sort(cards_.begin(), cards_.end(),
                     [this](const Card& a, const Card& b) { return isWrong_ ? a.z < b.z : a.z > b.z; });
    makeRays(field_, !isExplosion);
    const nlohmann::json parameters = {{"blobs", cards_.size()},
                                       {"order", isWrong_ ? "front to back" : "back to front"}};
    settings_ = {{"kernel", "default", parameters},
                 {"planar", "low", parameters},
                 {"constant", "", parameters},
                 {"gauss-5", "high", parameters}};
    for (const GlSetting& gl : kGlSettings)
        settings_.push_back({std::string(gl.name), "", parameters});
}

/// @param hasGround a wall behind the left half; the ground rises through the blobs of the right half
void BillboardAccuracy::makeRays(float field, bool hasGround)
{
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const float px = (float(x) + 0.5f - 0.5f * kWidth) * field / kWidth;
            const float py = (float(y) + 0.5f - 0.5f * kHeight) * field / kWidth;
            rays_.push_back(
                {px, py,
                 px < 0.0f || !hasGround ? std::numeric_limits<float>::infinity() : 2.0f + 0.8f * py});
        }
    lights_.resize(rays_.size());
}

base::Result<AccuracySample> BillboardAccuracy::run(size_t setting, const std::function<bool()>& stop)
{
    if (stop())
        return interruptedStatus();
    if (!status_)
        return status_;
    AccuracySample sample;
    if (setting < std::size(kForms)) {
        const MeasuredWork measured = *work(setting);
        sample.seconds = measured.seconds;
        sample.instructions = measured.instructions;
    } else if (base::Status status = drawByGl(kGlSettings[setting - std::size(kForms)], sample.seconds);
               !status) {
        return status;
    }
    sample.items = double(rays_.size());
    if (reference_.empty())
        makeReference();
    storeErrors(errors(), sample);
    sample.work = counters_;
    sample.work["p99_visible"] = visibleError();
    return sample;
}

base::Status BillboardAccuracy::makePicture()
{
    base::Result<std::unique_ptr<CardPicture>> made = CardPicture::create(kWidth, kHeight, field_);
    if (!made)
        return made.status();
    picture_ = std::move(*made);
    std::vector<float> surface;
    for (const CardRay& ray : rays_)
        surface.push_back(ray.farthest);
    picture_->setSurface(surface);
    return {};
}

/// A view sorts: to see the wrong order, each blob is drawn in a frame of its own. A sum is drawn in one.
base::Status BillboardAccuracy::drawByGl(const GlSetting& setting, double& outSeconds)
{
    if (!picture_)
        if (base::Status status = makePicture(); !status)
            return status;
    picture_->settings().composition = setting.composition;
    picture_->settings().slabs = setting.slabs;
    picture_->settings().voxels = setting.voxels;
    const bool isApart = isWrong_ && setting.composition == render::Composition::Sorted;
    const size_t atOnce = isApart ? 1 : cards_.size();
    outSeconds = 0;
    for (const bool isTimed : {false, true}) { // the first may compile
        picture_->clear();
        for (size_t i = 0; i < cards_.size(); i += atOnce) {
            double milliseconds = 0;
            const base::FrameSnapshot snapshot = picture_->snapshotOf(std::span(cards_).subspan(i, atOnce));
            if (base::Status status = picture_->draw(snapshot, &milliseconds); !status)
                return status;
            outSeconds += isTimed ? 1e-3 * milliseconds : 0.0;
        }
    }
    const std::vector<float> light = picture_->read();
    for (size_t i = 0; i < lights_.size(); ++i)
        lights_[i] = {light[3 * i], light[3 * i + 1], light[3 * i + 2]};
    counters_ = {{"rays", rays_.size()}};
    return {};
}

std::optional<MeasuredWork> BillboardAccuracy::work(size_t setting)
{
    if (setting >= std::size(kForms))
        return measureWork([] {}); // what a driver does is not counted
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

double BillboardAccuracy::brightest() const
{
    double brightest = 0;
    for (const std::array<double, 3>& light : reference_)
        brightest = std::max({brightest, light[0], light[1], light[2]});
    return brightest;
}

/// Of channels above a thousandth of the brightest: what the eye compares.
/// @param least [1] of the brightest: errors of darker channels are relative to it
std::vector<double> BillboardAccuracy::errors(double least) const
{
    const double most = brightest();
    std::vector<double> errors;
    for (size_t i = 0; i < reference_.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            if (reference_[i][c] > 1e-3 * most)
                errors.push_back((double(lights_[i][c]) - reference_[i][c]) /
                                 std::max(reference_[i][c], least * most));
    return errors;
}

/// 99th percentile of errors over the larger of a channel and 5 % of the brightest: what a picture shows.
double BillboardAccuracy::visibleError() const
{
    std::vector<double> visible = errors(0.05);
    for (double& error : visible)
        error = std::abs(error);
    std::sort(visible.begin(), visible.end());
    return visible.empty() ? 0.0 : visible[visible.size() * 99 / 100];
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<BillboardAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry billboardsAccuracy()
{
    return {"billboards",
            "planar, constant and kernel billboards and compositions against the integral",
            "ray",
            ShownError::P99,
            {"isolated-1", "isolated-10", "isolated-270", "overlapping-10", "overlapping-270",
             "sorted-wrong-10", "sorted-wrong-270", "explosion-0.6"},
            8,
            false,
            make};
}

} // namespace fx::cli
