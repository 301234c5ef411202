/// @file view_quality.h
/// Applies the levels chosen by the controller to each frame of a view, and passes frame times to the
/// controller.
///
/// Threads: [GL thread]. Repeated frames allocate no memory.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/quality/budget_controller.h"
#include "rendering/view/view_renderer.h"

#include <optional>

namespace fx::quality {

/// The host's time budget.
struct BudgetOptions
{
    double milliseconds = 0; ///< [ms] time budget of a frame; 0: settings are used unchanged
    render::TimingClock clock = render::TimingClock::Gpu;
};

class ViewQuality
{
public:
    /// Sets the options of the budget. If no calibration was set, the built-in calibration is used.
    base::Status setOptions(const BudgetOptions& options);
    const BudgetOptions& options() const { return options_; }
    /// Replaces the scalability levels and resets the cost model. Strong guarantee.
    void setCalibration(Calibration calibration);

    /// Forces the settings of `knobs`, for measurements. Frames are timed, but the cost model does not
    /// change. Empty: settings are no longer forced.
    void force(const std::optional<Knobs>& knobs) { forced_ = knobs; }

    /// Lowers the renderer's settings for the next frame. end() restores the settings.
    void begin(render::ViewRenderer& renderer, double deltaTime, bool hold);
    void end(render::ViewRenderer& renderer);
    /// Collects the available frame times. begin() and end() also call this function.
    void collect(render::ViewRenderer& renderer);

    /// The clock in use. Off: there is no budget. Empty: GL has no timestamps, and quality is fixed.
    std::optional<render::TimingClock> clock() const { return clock_; }
    /// True if the controller chose the settings of the last frame.
    bool isControlled() const
    {
        return hasCalibration() && !forced_ && clock_ && *clock_ != render::TimingClock::Off;
    }
    /// Returns the controller for the composition of the last frame, or null before a calibration is set.
    /// The controller's last technique represents passes with constant cost.
    const BudgetController* controller() const
    {
        return hasCalibration() ? &*controllers_[active_] : nullptr;
    }
    const Choice& choice() const { return chosen_; } ///< levels of the last frame
    bool wasHeld() const { return held_; }
    std::span<const double> weights() const { return weights_; } ///< weights of the last frame
    /// Times of the last finished frame; empty before the first finished frame.
    const std::optional<render::GroupTimes>& times() const { return times_; }

private:
    void control(render::ViewRenderer& renderer, double deltaTime);
    void weigh(const render::ViewRenderer& renderer);

    BudgetOptions options_;
    bool hasCalibration() const { return controllers_[0].has_value(); }
    std::optional<BudgetController>& active() { return controllers_[active_]; }

    /// One controller for each composition that a host can request. Either all controllers are set, or no
    /// controller is set.
    std::array<std::optional<BudgetController>, render::kCompositionCount> controllers_;
    size_t active_ = 0;
    std::optional<Knobs> forced_;
    std::optional<render::TimingClock> clock_ = render::TimingClock::Off;
    std::array<double, kMaxTechniques> weights_{};
    Choice chosen_{};
    bool held_ = false;
    std::optional<render::GroupTimes> times_;
    std::optional<render::ViewSettings> asked_; ///< settings of the host, saved between begin() and end()
};

} // namespace fx::quality
