// The functions of fx_view.h that concern the frame budget.
#include "fxsdk/api/text.h"
#include "fxsdk/api/versioned_struct.h"
#include "fxsdk/api/view_object.h"
#include "fxsdk/quality/calibration_file.h"

#include <utility>

namespace {

using fx::base::Status;
using fx::quality::ViewQuality;

uint32_t timingOf(const ViewQuality& quality)
{
    if (!quality.clock())
        return FX_TIMING_UNAVAILABLE;
    switch (*quality.clock()) {
    case fx::render::TimingClock::Gpu:
        return FX_TIMING_GPU;
    case fx::render::TimingClock::Host:
        return FX_TIMING_CPU;
    case fx::render::TimingClock::Off:
        break;
    }
    return FX_TIMING_OFF;
}

FxQualityReport reportOf(const ViewQuality& quality)
{
    FxQualityReport report{};
    report.timing = timingOf(quality);
    if (!quality.isControlled())
        return report;
    const fx::quality::BudgetController& controller = *quality.controller();
    report.budgetMilliseconds = float(quality.options().milliseconds);
    report.hasMeasured = quality.times() ? 1 : 0;
    report.measuredMilliseconds = quality.times() ? float(quality.times()->total()) : 0.0f;
    report.predictedMilliseconds = float(controller.predicted());
    report.estimatedError = float(controller.error());
    report.saturated = controller.isSaturated() ? 1 : 0;
    report.held = quality.wasHeld() ? 1 : 0;
    report.techniques = uint32_t(controller.techniqueLevels().size());
    report.switches = controller.switches();
    return report;
}

FxQualityChoice choiceOf(const ViewQuality& quality, uint32_t index)
{
    const fx::quality::BudgetController& controller = *quality.controller();
    const fx::quality::ScalabilityLevels& levels = controller.techniqueLevels()[index];
    const uint32_t step = quality.choice()[index];
    FxQualityChoice choice{};
    choice.step = step;
    choice.steps = uint32_t(levels.steps.size());
    choice.cost = float(levels.steps[step].cost);
    choice.error = float(levels.steps[step].error);
    choice.weight = float(quality.weights()[index]);
    choice.predictedMilliseconds = float(levels.steps[step].cost * controller.costs().scale(index));
    fx::api::copyText(levels.technique, choice.technique, sizeof choice.technique);
    fx::api::copyText(toText(levels.steps[step].knobs), choice.setting, sizeof choice.setting);
    return choice;
}

Status checkText(const char* text, size_t length)
{
    if (!text && length == 0)
        return {};
    fx::api::Checks check;
    check.notNull(text, "text");
    check.that(length > 0, "length is 0");
    return check.status();
}

} // namespace

FxResult fxView_SetQualityCalibration(FxView* view, const char* text, size_t length, const char* displayName)
{
    return fx::api::insideView("fxView_SetQualityCalibration", view, [&]() -> Status {
        if (Status status = checkText(text, length); !status)
            return status;
        auto calibration =
            text ? fx::quality::readCalibration({text, length}, displayName ? displayName : "calibration")
                 : fx::quality::builtInCalibration();
        if (!calibration)
            return calibration.status();
        view->prepared.reset();
        view->quality.setCalibration(std::move(*calibration));
        return {};
    });
}

FxResult fxView_GetQualityReport(FxView* view, FxQualityReport* ioReport)
{
    return fx::api::insideView("fxView_GetQualityReport", view, [&]() -> Status {
        return fx::api::writeStruct(reportOf(view->quality), ioReport, "ioReport");
    });
}

FxResult fxView_GetQualityChoice(FxView* view, uint32_t index, FxQualityChoice* ioChoice)
{
    return fx::api::insideView("fxView_GetQualityChoice", view, [&]() -> Status {
        if (!view->quality.isControlled() || index >= view->quality.controller()->techniqueLevels().size())
            return fx::api::invalid("the last frame chose for fewer techniques than index");
        return fx::api::writeStruct(choiceOf(view->quality, index), ioChoice, "ioChoice");
    });
}
