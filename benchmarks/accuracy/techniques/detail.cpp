/// @file detail.cpp
/// How true detail of fields is: what it takes from the whole extinction, what OpenGL makes of it beside the
/// ray integral of the same field, what is left of it in small pictures, and how it lives.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/detail_motion.h"
#include "benchmarks/scenes/detail_shrink.h"
#include "benchmarks/scenes/detail_sweep.h"
#include "benchmarks/scenes/lit_media.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace fx::cli {
namespace {

constexpr double kClear = 0.99; ///< [1] transmittance from which on a pixel is empty
constexpr int kSweepTimes = 24; ///< of the sweep of extinctions
constexpr int kSweepRays = 64;  ///< [ray] along a side of a picture of the sweep

enum class Question
{
    Extinction, ///< of all medium, with against without detail
    Sweep,      ///< the same at times of the effect's life, and the factor in frames that follow each other
    Picture,    ///< transmittance by OpenGL against that of the integral
    Small,      ///< a small picture against the mean of the pixels of a large one
    Motion      ///< pictures that follow each other
};

struct DetailSetting
{
    const char* name;
    const char* tier;
    Question question;
    render::Composition composition;
    int voxels;
    double limit; ///< [1] of the error
};
constexpr std::array<DetailSetting, 7> kSettings{
    {{"extinction", "", Question::Extinction, render::Composition::Volume, 128, 0.02},
     {"sweep", "", Question::Sweep, render::Composition::Volume, 128, 0.02},
     {"volume-64", "low", Question::Picture, render::Composition::Volume, 64, 0.02},
     {"volume-128", "default", Question::Picture, render::Composition::Volume, 128, 0.02},
     {"slabs-16", "", Question::Picture, render::Composition::Slabs, 128, 0.02},
     {"quarter", "", Question::Small, render::Composition::Volume, 128, 0.03},
     {"motion", "", Question::Motion, render::Composition::Volume, 128, 0.0}}};

/// [1] mean residual and worst of the prototype in docs/howto/field-detail.md; 0: none is known
struct MotionLimit
{
    std::string_view scene;
    double mean, worst;
};
constexpr MotionLimit kMotionLimits[] = {{"explosion-0.6", 0.054, 0.060}, {"explosion-1.5", 0.039, 0.041}};

int octavesOf(int voxels)
{
    return voxels < 96 ? 3 : render::kMaxDetailOctaves; // as rendering/compositions/volume
}

class DetailAccuracy final : public AccuracyTechnique
{
public:
    DetailAccuracy(const std::string& scene, bool isSmall)
        : scene_(scene), subject_(detailSubjects()[0]), isSmall_(isSmall), side_(isSmall ? 24 : 64),
          frames_(isSmall ? 3 : 12)
    {
        for (const DetailSubject& subject : detailSubjects())
            if (scene.starts_with(subject.name))
                subject_ = subject;
        for (const DetailSetting& setting : kSettings)
            settings_.push_back({setting.name, setting.tier, {{"limit", setting.limit}}});
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    using Stop = std::function<bool()>;
    base::Result<DetailScene*> still();
    const std::vector<float>& truth(int octaves, bool isParallel);
    /// RGBA by OpenGL.
    base::Result<Picture> drawn(const DetailSetting& setting, int side, AccuracySample& io);
    base::Status measureExtinction(AccuracySample& out);
    base::Status measureSweep(const Stop& stop, AccuracySample& out);
    base::Status measurePicture(const DetailSetting& setting, AccuracySample& out);
    base::Status measureSmall(const DetailSetting& setting, AccuracySample& out);
    base::Status measureMotion(const Stop& stop, AccuracySample& out);

    std::string scene_;
    DetailSubject subject_;
    bool isSmall_;
    int side_, frames_;
    std::vector<AccuracySetting> settings_;
    std::unique_ptr<DetailScene> still_;
    std::map<std::pair<int, bool>, std::vector<float>> truths_; ///< optical depths
};

base::Result<DetailScene*> DetailAccuracy::still()
{
    if (!still_) {
        auto scene = DetailScene::create(subject_);
        if (!scene.ok())
            return scene.status();
        still_ = std::move(*scene);
    }
    return still_.get();
}

const std::vector<float>& DetailAccuracy::truth(int octaves, bool isParallel)
{
    std::vector<float>& depths = truths_[{octaves, isParallel}];
    if (depths.empty()) {
        render::ReferenceScene scene = still_->reference(octaves);
        scene.camera = still_->camera(isParallel);
        depths = integratedDepth(scene, side_, side_);
    }
    return depths;
}

base::Result<Picture> DetailAccuracy::drawn(const DetailSetting& setting, int side, AccuracySample& io)
{
    render::ViewSettings view = detailViewSettings();
    view.composition = setting.composition;
    view.voxels = setting.voxels;
    auto renderer = SnapshotRenderer::create(still_->schema(), view, side, side);
    if (!renderer.ok())
        return renderer.status();
    for (int i = 0; i < 2; ++i) // the first may compile
        if (base::Status status = (*renderer)->render(still_->moment(), still_->camera(), subject_.time);
            !status)
            return status;
    io.seconds += 1e-3 * (*renderer)->millisecondsRender();
    io.items += double(side) * double(side);
    return (*renderer)->read().color;
}

/// By parallel rays, so that all of the volume counts alike.
base::Status DetailAccuracy::measureExtinction(AccuracySample& out)
{
    double depths[2] = {}, passing[2] = {};
    size_t covered = 0;
    const std::vector<float>& off = truth(0, true);
    const std::vector<float>& on = truth(render::kMaxDetailOctaves, true);
    for (size_t i = 0; i < off.size(); ++i) {
        const double tau[2] = {double(off[i]), double(on[i])};
        if (std::exp(-tau[0]) >= kClear)
            continue;
        ++covered;
        for (int k = 0; k < 2; ++k) {
            depths[k] += tau[k];
            passing[k] += std::exp(-tau[k]);
        }
    }
    const double ratio = depths[1] / depths[0];
    storeErrors({ratio - 1.0}, out);
    out.items = double(2 * off.size());
    out.work = {{"extinction_ratio", ratio},
                {"transmittance_off", passing[0] / double(covered)},
                {"transmittance_on", passing[1] / double(covered)}};
    char note[96];
    std::snprintf(note, sizeof note, "extinction %+.2f %%, transmittance %.3f -> %.3f", 1e2 * (ratio - 1.0),
                  passing[0] / double(covered), passing[1] / double(covered));
    out.note = note;
    return {};
}

base::Status DetailAccuracy::measureSweep(const Stop& stop, AccuracySample& out)
{
    const auto sweep =
        sweepExtinction(subject_, isSmall_ ? 3 : kSweepTimes, isSmall_ ? side_ : kSweepRays, stop);
    if (!sweep.ok())
        return sweep.status();
    const auto factors = factorsOfFrames(subject_, 2 * frames_, stop);
    if (!factors.ok())
        return factors.status();
    std::vector<double> errors;
    double worst = 0.0, step = 0.0, bend = 0.0;
    for (const double ratio : sweep->ratios) {
        errors.push_back(ratio - 1.0);
        worst = std::abs(ratio - 1.0) > std::abs(worst) ? ratio - 1.0 : worst;
    }
    for (size_t i = 1; i < factors->size(); ++i) {
        const double change = (*factors)[i] / (*factors)[i - 1] - 1.0;
        const double before = i > 1 ? (*factors)[i - 1] / (*factors)[i - 2] - 1.0 : change;
        step = std::max(step, std::abs(change));
        bend = std::max(bend, std::abs(change - before));
    }
    storeErrors(std::move(errors), out);
    out.items = double(sweep->ratios.size());
    out.work = {{"times", sweep->times},
                {"extinction_ratios", sweep->ratios},
                {"factors", *factors},
                {"factor_step_worst", step},
                {"factor_step_change_worst", bend}};
    char note[128];
    std::snprintf(note, sizeof note, "worst %+.2f %% of %zu times; factor %.3f, by at most %.3f %% a frame",
                  1e2 * worst, sweep->ratios.size(), factors->front(), 1e2 * step);
    out.note = note;
    return {};
}

base::Status DetailAccuracy::measurePicture(const DetailSetting& setting, AccuracySample& out)
{
    const std::vector<float>& depths = truth(octavesOf(setting.voxels), false);
    const std::vector<float>& smooth = truth(0, false);
    const auto picture = drawn(setting, side_, out);
    if (!picture.ok())
        return picture.status();
    std::vector<double> errors;
    double squares = 0.0, squaresSmooth = 0.0;
    for (size_t i = 0; i < depths.size(); ++i) {
        const double passing = std::exp(-double(depths[i]));
        if (!(passing < kClear))
            continue;
        errors.push_back(1.0 - double(picture->pixels[4 * i + 3]) - passing);
        squares += errors.back() * errors.back();
        const double without = std::exp(-double(smooth[i])) - passing;
        squaresSmooth += without * without;
    }
    const double count = double(std::max<size_t>(errors.size(), 1));
    const double rmse = std::sqrt(squares / count), none = std::sqrt(squaresSmooth / count);
    storeErrors(std::move(errors), out);
    out.work = {{"error_rms", rmse}, {"error_rms_without_detail", none}};
    char note[96];
    std::snprintf(note, sizeof note, "RMSE of transmittance %.4f of %.2f; without detail %.3f", rmse,
                  setting.limit, none);
    out.note = note;
    return {};
}

base::Status DetailAccuracy::measureSmall(const DetailSetting& setting, AccuracySample& out)
{
    render::ViewSettings view = detailViewSettings();
    view.composition = setting.composition;
    view.voxels = setting.voxels;
    auto errors = shrinkErrors(*still_, view, side_, out.seconds);
    if (!errors.ok())
        return errors.status();
    storeErrors(std::move(errors->values), out);
    out.items = double((1 + kShrink * kShrink) * side_ * side_);
    out.work = {{"error_rms", errors->light},
                {"bias_of_light", errors->bias},
                {"error_rms_transmittance", errors->transmittance},
                {"error_rms_emission", errors->emission},
                {"error_rms_sun", errors->sun},
                {"error_rms_sky", errors->sky},
                {"error_rms_unfaded", errors->unfaded},
                {"error_rms_unfaded_transmittance", errors->unfadedTransmittance}};
    char note[160];
    std::snprintf(note, sizeof note,
                  "RMSE %.2f %% of the RMS, limit %.0f %% (emission %.2f, sun %.2f, sky %.2f; opacity %.2f; "
                  "unfaded %.2f)",
                  1e2 * errors->light, 1e2 * setting.limit, 1e2 * errors->emission, 1e2 * errors->sun,
                  1e2 * errors->sky, 1e2 * errors->transmittance, 1e2 * errors->unfaded);
    out.note = note;
    return {};
}

base::Status DetailAccuracy::measureMotion(const Stop& stop, AccuracySample& out)
{
    auto scene = DetailScene::create(subject_);
    if (!scene.ok())
        return scene.status();
    const int side = 2 * side_;
    auto renderer = SnapshotRenderer::create((*scene)->schema(), detailViewSettings(), side, side);
    if (!renderer.ok())
        return renderer.status();
    const auto motion = motionResidual(**scene, **renderer, frames_, stop);
    if (!motion.ok())
        return motion.status();
    storeErrors(motion->frames, out);
    out.items = double(frames_) * double(side) * double(side);
    out.work = {{"residual_mean", motion->mean},
                {"residual_worst", motion->worst},
                {"births", motion->births},
                {"residual_at_births", motion->atBirths}};
    MotionLimit limit{};
    for (const MotionLimit& known : kMotionLimits)
        if (scene_.starts_with(known.scene))
            limit = known;
    char note[128];
    std::snprintf(note, sizeof note, "residual %.4f (worst %.4f; %u births %.4f) of %.3f (%.3f)",
                  motion->mean, motion->worst, motion->births, motion->atBirths, limit.mean, limit.worst);
    out.note = note;
    return {};
}

base::Result<AccuracySample> DetailAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (const auto scene = still(); !scene.ok())
        return scene.status();
    const DetailSetting& setting = kSettings[index];
    AccuracySample sample;
    base::Status status = setting.question == Question::Extinction ? measureExtinction(sample)
                          : setting.question == Question::Sweep    ? measureSweep(stop, sample)
                          : setting.question == Question::Picture  ? measurePicture(setting, sample)
                          : setting.question == Question::Small    ? measureSmall(setting, sample)
                                                                   : measureMotion(stop, sample);
    if (!status)
        return status;
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    return std::make_unique<DetailAccuracy>(scene, scene.ends_with("-small"));
}

} // namespace

AccuracyTechniqueEntry detailAccuracy()
{
    return {"detail",
            "detail of fields: its extinction, OpenGL against the ray integral of the same field, small "
            "pictures, motion",
            "pixel",
            ShownError::Mean,
            {"explosion-0.6", "explosion-1.5", "smoke-column", "explosion-0.6-small"},
            3,
            false,
            make};
}

} // namespace fx::cli
