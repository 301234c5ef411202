#include "benchmarks/calibrate/calibrate_levels.h"

#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/support/interrupt.h"
#include "fxsdk/quality/calibration_file.h"
#include "rendering/frame/composition_names.h"

#include <algorithm>
#include <cmath>

namespace fx::cli {
namespace {

using quality::Knobs;

constexpr double kMinStep = 0.9;  ///< a step costs at most so much of the one above it
constexpr double kFarAway = 12.0; ///< times the distance: an effect of a dozen pixels

/// A moment of a preset that calls for a technique.
struct Moment
{
    const char* preset;
    double seconds;
    double away = 1.0; ///< distance of the camera over that from which the effect fills the picture
};

struct Subject
{
    const char* technique;
    std::vector<Knobs> settings; ///< the first is the best
    std::vector<Moment> moments;
    bool countsOff;          ///< the last setting leaves the technique out: it costs nothing
    bool withDazzle = false; ///< otherwise there is no glare: it would hide differences
    std::optional<render::Composition> composition = {}; ///< nothing: levels of all, measured in sorted media
};

/// "media volume".
std::string nameOf(const Subject& subject)
{
    const std::string own(subject.composition ? render::nameOf(*subject.composition) : "");
    return own.empty() ? subject.technique : subject.technique + (" " + own);
}

Knobs mediaKnobs(render::BillboardForm form, bool detail, float particles)
{
    return {{"billboards", float(form)}, {"detail", detail ? 1.0f : 0.0f}, {"particles", particles}};
}

Subject media()
{
    Subject subject{"media",
                    {},
                    {{"library:explosion", 0.5},
                     {"library:smoke-column", 4.0},
                     {"library:campfire", 2.5},
                     {"library:dust-burst", 1.0},
                     {"library:explosion", 0.5, kFarAway},
                     {"library:smoke-column", 4.0, kFarAway}},
                    false};
    for (const float particles : {1.0f, 0.5f, 0.25f, 0.125f})
        for (const auto form :
             {render::BillboardForm::Kernel, render::BillboardForm::Constant, render::BillboardForm::Planar})
            for (const bool detail : {true, false})
                subject.settings.push_back(mediaKnobs(form, detail, particles));
    for (const float bias : {1.0f, 4.0f, 16.0f})
        for (const float particles : {1.0f, 0.5f, 0.25f})
            for (const bool detail : {true, false}) {
                Knobs knobs = mediaKnobs(render::BillboardForm::Kernel, detail, particles);
                knobs.set("lodBias", bias);
                subject.settings.push_back(knobs);
            }
    for (const float particles : {1.0f, 0.5f}) // fewer look-ups of light, and scattered once alone
        for (const bool multiple : {true, false}) {
            Knobs knobs = mediaKnobs(render::BillboardForm::Kernel, true, particles);
            knobs.set("lightSamples", 1.0f);
            knobs.set("multiple", multiple ? 1.0f : 0.0f);
            subject.settings.push_back(knobs);
        }
    return subject;
}

/// Media of views that ask for a composition in which no order is seen: less of it, and the sorted one.
Subject summedMedia(render::Composition composition)
{
    Subject subject{"media",
                    {},
                    {{"library:explosion", 0.5}, {"library:smoke-column", 4.0}, {"library:dust-burst", 1.0}},
                    false,
                    false,
                    composition};
    const bool isVolume = composition == render::Composition::Volume;
    subject.settings.push_back({{"composition", float(composition)}});
    for (const float voxels : {72.0f, 64.0f, 48.0f, 32.0f})
        if (isVolume)
            subject.settings.push_back({{"composition", float(composition)}, {"voxels", voxels}});
    for (const float slabs : {16.0f, 6.0f})
        if (slabs < 16.0f || isVolume)
            subject.settings.push_back(
                {{"composition", float(render::Composition::Slabs)}, {"slabs", slabs}});
    for (const float particles : {1.0f, 0.5f, 0.25f, 0.125f})
        for (const bool detail : {true, false}) {
            Knobs knobs = mediaKnobs(render::BillboardForm::Kernel, detail, particles);
            knobs.set("composition", float(render::Composition::Sorted));
            subject.settings.push_back(knobs);
        }
    return subject;
}

Subject lightSlices()
{
    Subject subject{"light slices",
                    {},
                    {{"library:explosion", 0.5}, {"library:smoke-column", 4.0}, {"library:dust-burst", 1.0}},
                    false};
    for (const float planes : {32.0f, 24.0f, 16.0f, 8.0f, 4.0f})
        subject.settings.push_back({{"slicePlanes", planes}});
    return subject;
}

Subject dazzle()
{
    return {"dazzle",
            {{{"dazzle", 1.0f}}, {{"dazzle", 0.0f}}},
            {{"library:explosion", 0.2}, {"library:gas-fire", 2.5}, {"library:campfire", 2.5}},
            true,
            true};
}

Subject shimmer()
{
    return {"shimmer",
            {{{"shimmer", 1.0f}}, {{"shimmer", 0.0f}}},
            {{"library:campfire", 2.5}, {"library:gas-fire", 2.5}},
            true};
}

/// One preset at one moment, and all its settings drawn again and again.
class MomentMeasurement
{
public:
    MomentMeasurement(const Subject& subject, const Moment& moment, const CalibrateRules& rules)
        : subject_(subject), moment_(moment), rules_(rules)
    {}

    base::Status start()
    {
        auto scene = sceneOfPreset(moment_.preset);
        if (!scene.ok())
            return scene.status();
        file_ = std::move(*scene);
        file_.view.dazzle.enabled = subject_.withDazzle;
        file_.view.composition = subject_.composition.value_or(render::Composition::Sorted);
        const base::Ticks tick = base::toTicks(moment_.seconds);
        if (base::Status status = frameEffect(file_, tick, {}); !status)
            return status;
        scene_file::CameraPath& camera = file_.camera;
        camera.position = camera.target + moment_.away * (camera.position - camera.target);
        auto stage = QualityStage::create(file_, rules_.width, rules_.height);
        if (!stage.ok())
            return stage.status();
        stage_ = std::move(*stage);
        clock = rules_.clock.value_or(stage_->bestClock());
        if (base::Status status = stage_->setBudget(0.0, clock); !status)
            return status;
        if (base::Status status = stage_->simulate(tick); !status)
            return status;
        return stage_->look(file_.camera);
    }

    /// Adds the time of one frame, and in the first round the error, to every point.
    base::Status round(bool first, std::vector<double>& ioSeconds, std::vector<PictureDifference>& ioErrors)
    {
        for (size_t k = 0; k < subject_.settings.size(); ++k) {
            stage_->view().quality.force(subject_.settings[k]);
            if (base::Status status = stage_->draw(); !status)
                return status;
            ioSeconds[k] += 1e-3 * milliseconds();
            if (!first)
                continue;
            const std::vector<float> picture = stage_->picture();
            if (k == 0)
                best_ = picture;
            const PictureDifference found = compare(picture, best_, stage_->background());
            ioErrors[k].difference += found.light > 0.0 ? found.difference / found.light : 0.0;
            ioErrors[k].light += 1.0;
        }
        return {};
    }

    std::string rendererName() const { return stage_->rendererName(); }
    StageClock clock = StageClock::Wall;

private:
    /// Of the technique's passes in the last frame.
    double milliseconds() const
    {
        const render::PassGroups& groups = stage_->view().renderer.passGroups();
        double sum = stage_->times().milliseconds[groups.find(subject_.technique)];
        const size_t own = subject_.composition ? groups.find(render::nameOf(*subject_.composition)) : 0;
        return own > 0 ? sum + stage_->times().milliseconds[own] : sum;
    }

    const Subject& subject_;
    const Moment& moment_;
    const CalibrateRules& rules_;
    scene_file::SceneFile file_;
    std::unique_ptr<QualityStage> stage_;
    std::vector<float> best_;
};

AccuracyCurve emptyCurve(const Subject& subject)
{
    AccuracyCurve curve;
    curve.technique = nameOf(subject);
    curve.scene = "library";
    curve.item = "frame";
    curve.shown = ShownError::Mean;
    for (size_t k = 0; k < subject.settings.size(); ++k) {
        AccuracyPoint point;
        point.setting.name = toText(subject.settings[k]);
        point.setting.tier = k == 0 ? "high" : "";
        point.sample.items = double(subject.moments.size());
        curve.points.push_back(point);
    }
    return curve;
}

/// All moments, and of each all settings in turn, again and again.
base::Status measureSubject(const Subject& subject, const CalibrateRules& rules,
                            const std::function<void()>& roundDone, AccuracyCurve& ioCurve,
                            MeasuredCalibration& ioCalibration)
{
    const size_t count = subject.settings.size();
    std::vector<PictureDifference> errors(count);
    std::vector<std::vector<double>> seconds(rules.repetitions, std::vector<double>(count, 0.0));
    for (const Moment& moment : subject.moments) {
        MomentMeasurement measurement(subject, moment, rules);
        if (base::Status status = measurement.start(); !status)
            return status;
        ioCalibration.clock = measurement.clock;
        ioCalibration.renderer = measurement.rendererName();
        std::vector<double> warmUp(count, 0.0);
        if (base::Status status = measurement.round(true, warmUp, errors); !status)
            return status;
        for (std::vector<double>& round : seconds) {
            if (rules.stop && rules.stop())
                return interruptedStatus();
            if (base::Status status = measurement.round(false, round, errors); !status)
                return status;
            roundDone();
        }
    }
    for (size_t k = 0; k < count; ++k) {
        AccuracyPoint& point = ioCurve.points[k];
        point.sample.errorMean = errors[k].light > 0.0 ? errors[k].difference / errors[k].light : 0.0;
        for (const std::vector<double>& round : seconds)
            point.seconds.push_back(round[k]);
        point.sample.seconds = *std::min_element(point.seconds.begin(), point.seconds.end());
    }
    return {};
}

} // namespace

quality::ScalabilityLevels scalabilityLevelsOf(const AccuracyCurve& curve, const std::vector<Knobs>& knobs)
{
    std::vector<size_t> front;
    for (size_t k = 1; k < curve.points.size(); ++k)
        if (isOnFront(curve, k))
            front.push_back(k);
    std::stable_sort(front.begin(), front.end(),
                     [&](size_t a, size_t b) { return timeRatio(curve, a).best > timeRatio(curve, b).best; });
    const auto rounded = [](double x) { return std::round(x * 1e4) / 1e4; };
    std::vector<quality::ScalabilityLevel> falling = {{1.0, 0.0, knobs[0]}};
    for (const size_t k : front) {
        const quality::ScalabilityLevel step{rounded(timeRatio(curve, k).best), rounded(shownError(curve, k)),
                                             knobs[k]};
        if (falling.size() < quality::kMaxSteps && step.cost <= kMinStep * falling.back().cost &&
            step.error > falling.back().error)
            falling.push_back(step);
    }
    return {curve.technique, {falling.rbegin(), falling.rend()}, {}};
}

base::Result<MeasuredCalibration> measureLevels(const CalibrateRules& rules)
{
    MeasuredCalibration calibration;
    std::vector<Subject> subjects = {media(),
                                     summedMedia(render::Composition::Slabs),
                                     summedMedia(render::Composition::Volume),
                                     lightSlices(),
                                     shimmer(),
                                     dazzle()};
    std::erase_if(subjects, [&](const Subject& subject) {
        return !rules.technique.empty() && rules.technique != nameOf(subject);
    });
    if (subjects.empty())
        return base::Status(
            base::Code::InvalidArgument,
            "--technique: found '" + rules.technique +
                "'; allowed are media, 'media slabs', 'media volume', 'light slices', shimmer and "
                "dazzle");
    uint64_t all = 0;
    for (const Subject& subject : subjects)
        all += subject.moments.size() * rules.repetitions;
    uint64_t done = 0;
    const auto roundDone = [&] {
        ++done;
        if (rules.progress)
            rules.progress(done, all);
    };
    for (const Subject& subject : subjects) {
        MeasuredLevels measured{emptyCurve(subject), {}};
        if (base::Status status = measureSubject(subject, rules, roundDone, measured.curve, calibration);
            !status)
            return status;
        if (!(measured.curve.points[0].sample.seconds > 0.0))
            return base::Status(base::Code::GlFailed, std::string("the time of '") + subject.technique +
                                                          "' could not be measured; try --clock wall");
        if (subject.countsOff)
            measured.curve.points.back().seconds.assign(rules.repetitions, 0.0);
        measured.levels = scalabilityLevelsOf(measured.curve, subject.settings);
        measured.levels.technique = subject.technique;
        measured.levels.composition = subject.composition;
        calibration.techniqueLevels.push_back(std::move(measured));
    }
    return calibration;
}

} // namespace fx::cli
