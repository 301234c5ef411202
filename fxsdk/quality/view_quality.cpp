#include "fxsdk/quality/view_quality.h"

#include "fxsdk/quality/calibration_file.h"

#include <utility>

namespace fx::quality {

namespace {

using render::PassGroup;
using render::TimingClock;

constexpr uint64_t kNotToLearn = uint64_t(1) << 63;
static_assert(kMostLadders * 4 < 63 && kMostSteps <= 16); // a choice fits into a tag

uint64_t toTag(const Choice& choice)
{
    uint64_t tag = 0;
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

constexpr const char* techniqueOf(PassGroup group)
{
    constexpr const char* kNames[render::kPassGroups] = {"other", "media", "shimmer", "dazzle"};
    return kNames[size_t(group)];
}

} // namespace

base::Status ViewQuality::setOptions(const BudgetOptions& options)
{
    if (options.milliseconds > 0.0 && !controller_) {
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
    std::vector<Ladder>& ladders = calibration.ladders;
    ladders.push_back({"other", {{1.0, 0.0, {}}}});
    std::array<size_t, render::kPassGroups> ladderOf{};
    for (size_t group = 0; group < ladderOf.size(); ++group) {
        ladderOf[group] = ladders.size() - 1;
        for (size_t i = 0; i < ladders.size(); ++i)
            if (ladders[i].technique == techniqueOf(PassGroup(group)))
                ladderOf[group] = i;
    }
    BudgetController controller(std::move(ladders));
    controller_.emplace(std::move(controller));
    ladderOf_ = ladderOf;
    chosen_ = controller_->choice();
    times_.reset();
}

void ViewQuality::begin(render::ViewRenderer& renderer, double deltaTime, bool hold)
{
    clock_ = TimingClock::Off;
    asked_ = renderer.settings();
    if (forced_ || (controller_ && options_.milliseconds > 0.0)) {
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
    renderer.setTiming(*clock_, toTag(chosen_) | (hold || forced_ ? kNotToLearn : 0));
}

void ViewQuality::control(render::ViewRenderer& renderer, double deltaTime)
{
    weigh(renderer.covered());
    chosen_ = controller_->choose({options_.milliseconds, deltaTime, held_, weights_});
    for (size_t i = 0; i < controller_->ladders().size(); ++i)
        apply(controller_->ladders()[i].steps[chosen_[i]].knobs, renderer.settings());
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
        std::array<double, kMostLadders> milliseconds{};
        for (size_t group = 0; group < render::kPassGroups; ++group)
            milliseconds[ladderOf_[group]] += times.milliseconds[group];
        controller_->observe(fromTag(times.tag), milliseconds);
    }
}

void ViewQuality::weigh(const render::ScreenShare& covered)
{
    weights_ = {};
    for (size_t i = 0; i < controller_->ladders().size(); ++i) {
        const std::string& technique = controller_->ladders()[i].technique;
        weights_[i] = technique == "media"     ? covered.media
                      : technique == "shimmer" ? covered.hot
                      : technique == "dazzle"  ? covered.media // glare is about as large as what is bright
                                               : 0.0;
    }
}

} // namespace fx::quality
