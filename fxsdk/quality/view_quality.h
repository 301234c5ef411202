/// @file view_quality.h
/// Gives each frame of a view the settings that the controller chose, and the controller the times.
///
/// Threads: [GL thread]. Steady state allocates nothing.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/quality/budget_controller.h"
#include "rendering/view/view_renderer.h"

#include <optional>

namespace fx::quality {

/// The host's budget.
struct BudgetOptions
{
    double milliseconds = 0; ///< [ms] 0: quality is what the settings say
    render::TimingClock clock = render::TimingClock::Gpu;
};

class ViewQuality
{
public:
    /// Without a calibration so far takes the built-in one.
    base::Status setOptions(const BudgetOptions& options);
    const BudgetOptions& options() const { return options_; }
    /// Exchanges the scalability levels; what was learned is forgotten. Strong guarantee.
    void setCalibration(Calibration calibration);

    /// For measurements: this setting whatever it costs; frames are timed, the controller learns nothing.
    void force(const std::optional<Knobs>& knobs) { forced_ = knobs; }

    /// Lowers the renderer's settings for one frame, which follows; end() gives them back.
    void begin(render::ViewRenderer& renderer, double deltaTime, bool hold);
    void end(render::ViewRenderer& renderer);
    /// Takes what has been measured so far; begin() and end() do so too.
    void collect(render::ViewRenderer& renderer);

    /// Off: there is no budget. Gpu or Host as asked for; nothing when GL has no clock, and quality is fixed.
    std::optional<render::TimingClock> clock() const { return clock_; }
    /// Whether the controller chose the settings of the last frame.
    bool isControlled() const
    {
        return controller_ && !forced_ && clock_ && *clock_ != render::TimingClock::Off;
    }
    /// Null before a calibration. Its last element stands for what no technique can change.
    const BudgetController* controller() const { return controller_ ? &*controller_ : nullptr; }
    const Choice& choice() const { return chosen_; } ///< of the last frame
    bool wasHeld() const { return held_; }
    std::span<const double> weights() const { return weights_; } ///< of the last frame
    /// The last frame that has finished; nothing before one has.
    const std::optional<render::GroupTimes>& times() const { return times_; }

private:
    void control(render::ViewRenderer& renderer, double deltaTime);
    void weigh(const render::ViewRenderer& renderer);

    BudgetOptions options_;
    std::optional<BudgetController> controller_;
    std::optional<Knobs> forced_;
    std::optional<render::TimingClock> clock_ = render::TimingClock::Off;
    std::array<double, kMaxTechniques> weights_{};
    Choice chosen_{};
    bool held_ = false;
    std::optional<render::GroupTimes> times_;
    std::optional<render::ViewSettings> asked_; ///< by the host, between begin() and end()
};

} // namespace fx::quality
