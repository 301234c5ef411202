#include "fxsdk/quality/view_quality.h"

#include "fxsdk/quality/calibration_file.h"
#include "rendering/frame/composition_names.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>

namespace fx::quality {

namespace {

using render::TimingClock;

constexpr uint64_t kNotToLearn = uint64_t(1) << 63;
constexpr unsigned kCompositionBit = 60;
static_assert(kMaxTechniques * 4 <= kCompositionBit && kMaxSteps <= 16 && render::kCompositionCount <= 8);

uint64_t toTag(const Choice& choice, size_t composition)
{
    uint64_t tag = uint64_t(composition) << kCompositionBit;
    for (size_t i = 0; i < choice.size(); ++i)
        tag |= uint64_t(choice[i]) << (4 * i);
    return tag;
}

Choice fromTag(uint64_t tag)
{
    Choice choice{};
    for (size_t i = 0; i < choice.size(); ++i)
        choice[i] = uint8_t(tag >> (4 * i) & 15u);
    return choice;
}

/// The technique that the time of a group of passes belongs to: the one of its name, or whose levels are
/// those of the composition of this name; otherwise the last.
size_t techniqueIndexOf(std::span<const ScalabilityLevels> techniqueLevels, std::string_view group)
{
    const auto found = std::ranges::find_if(techniqueLevels, [&](const ScalabilityLevels& levels) {
        return levels.technique == group ||
               (levels.composition && render::nameOf(*levels.composition) == group);
    });
    return found == techniqueLevels.end() ? techniqueLevels.size() - 1
                                          : size_t(found - techniqueLevels.begin());
}

} // namespace

base::Status ViewQuality::setOptions(const BudgetOptions& options)
{
    if (options.milliseconds > 0.0 && !hasCalibration()) {
        base::Result<Calibration> calibration = builtInCalibration();
        if (!calibration)
            return calibration.status();
        setCalibration(std::move(*calibration));
    }
    options_ = options;
    return {};
}

void ViewQuality::setCalibration(Calibration calibration)
{
    decltype(controllers_) controllers;
    for (size_t i = 0; i < controllers.size(); ++i) {
        std::vector<ScalabilityLevels> levels = levelsFor(calibration, render::Composition(i));
        levels.push_back({"other", {{1.0, 0.0, {}}}, {}});
        controllers[i].emplace(std::move(levels));
    }
    std::swap(controllers_, controllers);
    chosen_ = active()->choice();
    times_.reset();
}

void ViewQuality::begin(render::ViewRenderer& renderer, double deltaTime, bool hold)
{
    clock_ = TimingClock::Off;
    asked_ = renderer.settings();
    active_ = size_t(asked_->composition);
    if (forced_ || (hasCalibration() && options_.milliseconds > 0.0)) {
        clock_ = options_.clock;
        if (clock_ == TimingClock::Gpu && !renderer.hasGpuClock())
            clock_.reset();
    }
    held_ = hold;
    if (forced_)
        apply(*forced_, renderer.settings());
    if (clock_ == TimingClock::Off || !clock_) {
        renderer.setTiming(TimingClock::Off, 0);
        return;
    }
    collect(renderer);
    if (!forced_)
        control(renderer, deltaTime);
    renderer.setTiming(*clock_, toTag(chosen_, active_) | (hold || forced_ ? kNotToLearn : 0));
}

void ViewQuality::control(render::ViewRenderer& renderer, double deltaTime)
{
    BudgetController& controller = *active();
    weigh(renderer);
    chosen_ = controller.choose({options_.milliseconds, deltaTime, held_, weights_});
    for (size_t i = 0; i < controller.techniqueLevels().size(); ++i)
        apply(controller.techniqueLevels()[i].steps[chosen_[i]].knobs, renderer.settings());
}

void ViewQuality::end(render::ViewRenderer& renderer)
{
    renderer.settings() = *asked_;
    asked_.reset();
    if (clock_ && clock_ != TimingClock::Off)
        collect(renderer);
}

void ViewQuality::collect(render::ViewRenderer& renderer)
{
    render::GroupTimes times;
    while (renderer.takeTimes(times)) {
        times_ = times;
        if (times.tag & kNotToLearn)
            continue;
        BudgetController& controller = *controllers_[times.tag >> kCompositionBit];
        std::array<double, kMaxTechniques> milliseconds{};
        const render::PassGroups& groups = renderer.passGroups();
        for (size_t group = 0; group < groups.count(); ++group)
            milliseconds[techniqueIndexOf(controller.techniqueLevels(), groups.name(group))] +=
                times.milliseconds[group];
        controller.observe(fromTag(times.tag), milliseconds);
    }
}

void ViewQuality::weigh(const render::ViewRenderer& renderer)
{
    weights_ = {};
    const auto& techniqueLevels = active()->techniqueLevels();
    for (const render::DrawTechnique* technique : renderer.techniques())
        for (size_t i = 0; technique->levels && i < techniqueLevels.size(); ++i)
            if (techniqueLevels[i].technique == technique->levels->name)
                weights_[i] = technique->levels->weight(renderer.covered());
}

} // namespace fx::quality
