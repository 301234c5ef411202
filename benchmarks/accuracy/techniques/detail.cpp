/// @file detail.cpp
/// How true detail of fields is: what it takes from the whole extinction, what OpenGL makes of it beside the
/// ray integral of the same field, what is left of it in small pictures, and how it lives.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/detail_motion.h"
#include "benchmarks/scenes/lit_media.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace fx::cli {
namespace {

constexpr double kClear = 0.99;   ///< [1] transmittance from which on a pixel is empty
constexpr double kCovered = 0.01; ///< [1] opacity from which on a pixel is covered
constexpr int kShrink = 4;        ///< of the small picture

enum class Question
{
    Extinction, ///< of all medium, with against without detail
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
constexpr std::array<DetailSetting, 6> kSettings{
    {{"extinction", "", Question::Extinction, render::Composition::Volume, 128, 0.02},
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
        : scene_(scene), subject_(detailSubjects()[0]), side_(isSmall ? 24 : 64), frames_(isSmall ? 3 : 12)
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
    base::Status measurePicture(const DetailSetting& setting, AccuracySample& out);
    base::Status measureSmall(const DetailSetting& setting, AccuracySample& out);
    base::Status measureMotion(const Stop& stop, AccuracySample& out);

    std::string scene_;
    DetailSubject subject_;
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
    const auto large = drawn(setting, kShrink * side_, out);
    if (!large.ok())
        return large.status();
    const auto small = drawn(setting, side_, out);
    if (!small.ok())
        return small.status();
    std::vector<double> errors;
    double squares = 0.0, light = 0.0;
    for (int y = 0; y < side_; ++y)
        for (int x = 0; x < side_; ++x) {
            const float* const own = &small->pixels[4 * (size_t(y) * size_t(side_) + size_t(x))];
            std::array<double, 4> mean{};
            for (int k = 0; k < kShrink * kShrink; ++k) {
                const size_t i = size_t(kShrink * y + k / kShrink) * size_t(kShrink * side_) +
                                 size_t(kShrink * x + k % kShrink);
                for (size_t c = 0; c < 4; ++c)
                    mean[c] += double(large->pixels[4 * i + c]) / (kShrink * kShrink);
            }
            if (mean[3] < kCovered)
                continue;
            for (size_t c = 0; c < 3; ++c) {
                errors.push_back(double(own[c]) - mean[c]);
                squares += errors.back() * errors.back();
                light += mean[c] * mean[c];
            }
        }
    const double relative = std::sqrt(squares / std::max(light, 1e-30));
    const double scale = std::sqrt(std::max(light, 1e-30) / double(std::max<size_t>(errors.size(), 1)));
    for (double& error : errors)
        error /= scale;
    storeErrors(std::move(errors), out);
    out.work = {{"error_rms", relative}};
    char note[96];
    std::snprintf(note, sizeof note, "RMSE %.2f %% of the RMS, limit %.0f %%", 1e2 * relative,
                  1e2 * setting.limit);
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
