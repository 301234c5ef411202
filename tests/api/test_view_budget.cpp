// Quality by frame budget, as a host sees it.
#include "fxsdk/api/context.h"
#include "tests/api/counting_new.h"
#include "tests/api/view_fixture.h"

#include <cmath>
#include <cstring>

using fx::test::newCallsOfThisThread;

namespace {

FxQualityReport reportOf(FxView* view)
{
    FxQualityReport report{};
    report.structSize = sizeof report;
    EXPECT_EQ(fxView_GetQualityReport(view, &report), FX_OK) << fxGetLastErrorMessage();
    return report;
}

FxQualityChoice choiceOf(FxView* view, const char* technique)
{
    const uint32_t count = reportOf(view).techniques;
    for (uint32_t i = 0; i < count; ++i) {
        FxQualityChoice choice{};
        choice.structSize = sizeof choice;
        EXPECT_EQ(fxView_GetQualityChoice(view, i, &choice), FX_OK) << fxGetLastErrorMessage();
        if (std::strcmp(choice.technique, technique) == 0)
            return choice;
    }
    ADD_FAILURE() << technique << " is not among " << count;
    return {};
}

class ViewBudget : public fx::test::ViewApiTest
{
protected:
    ViewBudget() { update(60); }

    void setBudget(float milliseconds, uint32_t clock = FX_BUDGET_CLOCK_CPU)
    {
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0; // it adapts from frame to frame
        settings.budgetMilliseconds = milliseconds;
        settings.budgetClock = clock;
        ASSERT_EQ(fxView_SetSettings(view_, &settings), FX_OK) << fxGetLastErrorMessage();
    }

    std::vector<float> drawn(uint32_t holdQuality = 0)
    {
        fillPicture();
        FxFrameDef def = frame();
        def.holdQuality = holdQuality;
        EXPECT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        return picture();
    }
};

} // namespace

TEST_F(ViewBudget, withoutABudgetNothingIsTimedAndWithAWideOneThePictureIsTheSame)
{
    setBudget(0.0f);
    const std::vector<float> fixed = drawn();
    EXPECT_EQ(reportOf(view_).timing, uint32_t(FX_TIMING_OFF));
    EXPECT_EQ(reportOf(view_).techniques, 0u);
    setBudget(10'000.0f);
    for (int k = 0; k < 5; ++k)
        EXPECT_EQ(drawn(), fixed);
    const FxQualityReport report = reportOf(view_);
    EXPECT_EQ(report.timing, uint32_t(FX_TIMING_CPU));
    EXPECT_EQ(report.hasMeasured, 1u);
    EXPECT_GT(report.measuredMilliseconds, 0.0f);
    EXPECT_GT(report.predictedMilliseconds, 0.0f);
    EXPECT_EQ(report.estimatedError, 0.0f);
    EXPECT_EQ(report.saturated, 0u);
    EXPECT_EQ(report.switches, 0u);
    EXPECT_EQ(choiceOf(view_, "media").step + 1, choiceOf(view_, "media").steps);
    EXPECT_GT(choiceOf(view_, "media").predictedMilliseconds, 0.0f);
    EXPECT_GT(choiceOf(view_, "media").weight, 0.1f);
}

TEST_F(ViewBudget, aBudgetThatCannotBeMetGoesToTheLowestAndSaysSo)
{
    setBudget(0.0f);
    const std::vector<float> fixed = drawn();
    const uint32_t blobs = statistics().blobs;
    setBudget(1e-3f);
    for (int k = 0; k < 3; ++k)
        (void)drawn();
    const FxQualityReport report = reportOf(view_);
    EXPECT_EQ(report.saturated, 1u);
    EXPECT_GT(report.estimatedError, 0.0f);
    EXPECT_EQ(report.switches, 1u);
    EXPECT_EQ(choiceOf(view_, "media").step, 0u);
    EXPECT_EQ(choiceOf(view_, "shimmer").step, 0u);
    EXPECT_GT(std::strlen(choiceOf(view_, "media").setting), 0u);
    EXPECT_LT(statistics().blobs, blobs);
    const std::vector<float> low = drawn();
    EXPECT_NE(low, fixed);
    double lowSum = 0, fixedSum = 0; // but it is the same effect
    for (size_t i = 0; i < low.size(); ++i) {
        lowSum += double(low[i]);
        fixedSum += double(fixed[i]);
    }
    EXPECT_NEAR(lowSum / fixedSum, 1.0, 0.25);
    setBudget(0.0f); // the settings were the host's all the time
    EXPECT_EQ(drawn(), fixed);
}

TEST_F(ViewBudget, heldFramesChangeNothing)
{
    setBudget(1e-3f);
    for (int k = 0; k < 5; ++k) {
        (void)drawn(1);
        EXPECT_EQ(reportOf(view_).switches, 0u);
        EXPECT_EQ(reportOf(view_).held, 1u);
    }
    (void)drawn();
    (void)drawn();
    EXPECT_EQ(reportOf(view_).switches, 1u);
    EXPECT_EQ(reportOf(view_).held, 0u);
}

TEST_F(ViewBudget, aSceneThatMakesUpForMoreThanItMayHoldsQuality)
{
    setBudget(1e-3f);
    ASSERT_EQ(fxScene_Update(scene_, 10.0), FX_OK);
    (void)drawn();
    (void)drawn();
    EXPECT_EQ(reportOf(view_).held, 1u);
    EXPECT_EQ(reportOf(view_).switches, 0u);
    update(1);
    (void)drawn();
    (void)drawn();
    EXPECT_EQ(reportOf(view_).switches, 1u);
}

TEST_F(ViewBudget, theGpuClockComesLateAndTellsATime)
{
    setBudget(10'000.0f, FX_BUDGET_CLOCK_GPU);
    for (int k = 0; k < 8; ++k) {
        (void)drawn();
        host_->gl.Finish();
    }
    const FxQualityReport report = reportOf(view_);
    if (report.timing == FX_TIMING_UNAVAILABLE)
        GTEST_SKIP() << "this OpenGL has no timestamps";
    EXPECT_EQ(report.timing, uint32_t(FX_TIMING_GPU));
    EXPECT_EQ(report.hasMeasured, 1u);
    EXPECT_GT(report.measuredMilliseconds, 0.0f);
    EXPECT_LT(report.measuredMilliseconds, 10'000.0f);
    EXPECT_GT(choiceOf(view_, "media").predictedMilliseconds, 0.0f);
}

TEST_F(ViewBudget, withoutTimestampsTheTimeIsUnavailableAndQualityIsFixed)
{
    setBudget(0.0f);
    const std::vector<float> fixed = drawn();
    context_->device->gl.monitor.hook = [](const char* name) {
        return std::strcmp(name, "glGetQueryiv") != 0;
    };
    setBudget(1e-3f, FX_BUDGET_CLOCK_GPU);
    for (int k = 0; k < 3; ++k)
        EXPECT_EQ(drawn(), fixed);
    context_->device->gl.monitor.hook = nullptr;
    EXPECT_EQ(reportOf(view_).timing, uint32_t(FX_TIMING_UNAVAILABLE));
    EXPECT_EQ(reportOf(view_).hasMeasured, 0u);
    EXPECT_EQ(reportOf(view_).techniques, 0u);
}

TEST_F(ViewBudget, aWarmFrameUnderABudgetAllocatesNothing)
{
    for (const uint32_t clock : {FX_BUDGET_CLOCK_CPU, FX_BUDGET_CLOCK_GPU}) {
        setBudget(1e-3f, clock);
        const FxFrameDef def = frame();
        for (int k = 0; k < 90; ++k) {
            update(1);
            ASSERT_EQ(fxView_Render(view_, &def), FX_OK) << fxGetLastErrorMessage();
        }
        for (int k = 0; k < 20; ++k) {
            update(1);
            const uint64_t before = newCallsOfThisThread();
            ASSERT_EQ(fxView_Render(view_, &def), FX_OK);
            EXPECT_EQ(newCallsOfThisThread() - before, 0u) << "frame " << k;
            EXPECT_EQ(statistics().allocations, 0u) << "frame " << k;
        }
    }
}

TEST_F(ViewBudget, aCalibrationOfTheHostsIsUsedAndABadOneChangesNothing)
{
    const std::string one = R"({"version": 1, "techniques": [{"name": "media", "steps": [
        {"cost": 0.3, "error": 0.5, "setting": {"particles": 0.5}},
        {"cost": 1, "error": 0, "setting": {"particles": 1}}]}]})";
    setBudget(1e-3f);
    ASSERT_EQ(fxView_SetQualityCalibration(view_, one.data(), one.size(), "mine.json"), FX_OK)
        << fxGetLastErrorMessage();
    (void)drawn();
    (void)drawn();
    EXPECT_EQ(reportOf(view_).techniques, 2u); // media, other
    EXPECT_STREQ(choiceOf(view_, "media").setting, "particles 0.5");

    const std::string bad = R"({"version": 1, "techniques": [{"name": "media", "steps": []}]})";
    EXPECT_EQ(fxView_SetQualityCalibration(view_, bad.data(), bad.size(), "bad.json"), FX_ERROR_SCHEMA);
    EXPECT_NE(std::strstr(fxGetLastErrorMessage(), "bad.json:1:"), nullptr) << fxGetLastErrorMessage();
    EXPECT_EQ(fxView_SetQualityCalibration(view_, nullptr, 3, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_SetQualityCalibration(view_, one.data(), 0, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_SetQualityCalibration(nullptr, one.data(), one.size(), nullptr),
              FX_ERROR_INVALID_ARGUMENT);
    EXPECT_STREQ(choiceOf(view_, "media").setting, "particles 0.5");
    EXPECT_EQ(fxView_SetQualityCalibration(view_, nullptr, 0, nullptr), FX_OK);
    (void)drawn();
    EXPECT_EQ(reportOf(view_).techniques, 5u) << "media, light slices, shimmer, dazzle, other";
}

TEST_F(ViewBudget, theReportsRefuseWhatTheyCannotFill)
{
    FxQualityReport report{};
    EXPECT_EQ(fxView_GetQualityReport(view_, nullptr), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetQualityReport(nullptr, &report), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(fxView_GetQualityReport(view_, &report), FX_ERROR_VERSION);
    FxQualityChoice choice{};
    choice.structSize = sizeof choice;
    EXPECT_EQ(fxView_GetQualityChoice(view_, 0, &choice), FX_ERROR_INVALID_ARGUMENT); // no budget
    setBudget(5.0f);
    (void)drawn();
    EXPECT_EQ(fxView_GetQualityChoice(view_, 0, &choice), FX_OK);
    EXPECT_EQ(fxView_GetQualityChoice(view_, reportOf(view_).techniques, &choice), FX_ERROR_INVALID_ARGUMENT);
    choice.structSize = 3;
    EXPECT_EQ(fxView_GetQualityChoice(view_, 0, &choice), FX_ERROR_VERSION);
}
