// What the choice of settings promises, for thousands of random scalability levels, loads and budgets.
#include "foundation/random/philox.h"
#include "fxsdk/quality/scalability_choice.h"

#include <gtest/gtest.h>

#include <array>

namespace fx::quality {

namespace {

/// Numbers in [0, 1) from a counter.
class Draw
{
public:
    explicit Draw(uint32_t stream) : stream_(stream) {}
    double operator()() { return double(base::toUnitFloat(base::philox({next_++, stream_, 0, 0}, 7)[0])); }

private:
    uint32_t stream_;
    uint32_t next_ = 0;
};

struct Case
{
    std::vector<ScalabilityLevels> techniqueLevels;
    CostModel costs;
    std::array<double, kMaxTechniques> weights{};
    ChoiceInputs inputs() const { return {techniqueLevels, &costs, weights}; }
};

Case randomCase(uint32_t stream)
{
    Draw draw(stream);
    Case made;
    const size_t count = 1 + size_t(draw() * kMaxTechniques);
    for (size_t i = 0; i < count; ++i) {
        ScalabilityLevels levels{"random", {}};
        const size_t steps = 1 + size_t(draw() * kMaxSteps);
        double cost = draw() < 0.3 ? 0.0 : draw();
        double error = 0.0;
        for (size_t k = 0; k < steps; ++k, cost += 0.01 + draw())
            levels.steps.push_back({cost, 0.0, {}});
        for (size_t k = steps - 1; k-- > 0;)
            levels.steps[k].error = error += 0.001 + draw() * draw();
        made.techniqueLevels.push_back(levels);
        made.costs.observe(i, 1.0, draw() * 5.0);
        made.weights[i] = draw() < 0.2 ? 0.0 : draw();
    }
    return made;
}

constexpr uint32_t kCases = 3000;

} // namespace

TEST(ScalabilityChoice, costRisesAndErrorFallsWithEveryStep)
{
    for (uint32_t stream = 0; stream < kCases; ++stream) {
        const Case made = randomCase(stream);
        for (size_t i = 0; i < made.techniqueLevels.size(); ++i) {
            Choice choice{};
            for (uint8_t k = 1; k < made.techniqueLevels[i].steps.size(); ++k) {
                const Choice before = choice;
                choice[i] = k;
                EXPECT_GT(predictedMilliseconds(made.inputs(), choice),
                          predictedMilliseconds(made.inputs(), before));
                EXPECT_LE(estimatedError(made.inputs(), choice), estimatedError(made.inputs(), before));
            }
        }
    }
}

TEST(ScalabilityChoice, neverExceedsItsTimeUnlessTheLowestDoes)
{
    for (uint32_t stream = 0; stream < kCases; ++stream) {
        const Case made = randomCase(stream);
        Draw draw(stream + 100'000);
        const double budget = 40.0 * draw();
        const double lowest = predictedMilliseconds(made.inputs(), {});
        const Choice choice = climb(made.inputs(), {}, highest(made.techniqueLevels), budget);
        if (lowest > budget) {
            EXPECT_EQ(choice, Choice{});
        } else {
            EXPECT_LE(predictedMilliseconds(made.inputs(), choice), budget * (1.0 + 1e-12));
        }
    }
}

TEST(ScalabilityChoice, leavesNoStepThatWouldStillFit)
{
    for (uint32_t stream = 0; stream < kCases; ++stream) {
        const Case made = randomCase(stream);
        const double budget = 10.0;
        const Choice choice = climb(made.inputs(), {}, highest(made.techniqueLevels), budget);
        for (size_t i = 0; i < made.techniqueLevels.size(); ++i) {
            if (choice[i] + 1u >= made.techniqueLevels[i].steps.size())
                continue;
            Choice higher = choice;
            ++higher[i];
            EXPECT_GT(predictedMilliseconds(made.inputs(), higher), budget * (1.0 - 1e-12));
        }
    }
}

TEST(ScalabilityChoice, staysBelowWhatItIsAllowed)
{
    for (uint32_t stream = 0; stream < kCases; ++stream) {
        const Case made = randomCase(stream);
        Choice most = highest(made.techniqueLevels);
        for (uint8_t& step : most)
            step = uint8_t(step / 2);
        EXPECT_EQ(climb(made.inputs(), {}, most, 1e9), most);
    }
}

TEST(ScalabilityChoice, aStepThatHelpsLittleDoesNotHideTheGreatOneBehindIt)
{
    CostModel costs;
    costs.observe(0, 1.0, 1.0);
    costs.observe(1, 1.0, 1.0);
    const std::vector<ScalabilityLevels> techniqueLevels = {
        {"a", {{0.0, 1.0, {}}, {0.9, 0.99, {}}, {1.0, 0.0, {}}}}, {"b", {{0.0, 0.5, {}}, {1.0, 0.0, {}}}}};
    const std::array<double, 2> weights = {1.0, 1.0};
    const Choice choice = climb({techniqueLevels, &costs, weights}, {}, highest(techniqueLevels), 1.0);
    EXPECT_EQ(choice[0], 2);
    EXPECT_EQ(choice[1], 0);
}

TEST(Knobs, neverRaiseWhatTheHostHasLowered)
{
    render::ViewSettings settings;
    settings.form = render::BillboardForm::Constant;
    settings.detail = false;
    settings.shimmer.strength = 0.0f;
    apply({{"billboards", float(render::BillboardForm::Kernel)},
           {"detail", 1.0f},
           {"particles", 1.0f},
           {"shimmer", 1.0f}},
          settings);
    EXPECT_EQ(settings.form, render::BillboardForm::Constant);
    EXPECT_FALSE(settings.detail);
    EXPECT_EQ(settings.shimmer.strength, 0.0f);
    const Knobs far{{"lodBias", 2.0f}, {"dazzle", 1.0f}};
    settings.lod.bias = 8.0f;
    settings.dazzle.enabled = false;
    apply(far, settings);
    EXPECT_EQ(settings.lod.bias, 8.0f);
    EXPECT_FALSE(settings.dazzle.enabled);
    settings = {};
    apply(far, settings);
    EXPECT_EQ(settings.lod.bias, 2.0f);
    EXPECT_TRUE(settings.dazzle.enabled);
    apply({{"dazzle", 0.0f}}, settings);
    EXPECT_FALSE(settings.dazzle.enabled);
    settings = {};
    apply({{"billboards", float(render::BillboardForm::Planar)},
           {"detail", 0.0f},
           {"particles", 0.25f},
           {"shimmer", 0.0f}},
          settings);
    EXPECT_EQ(settings.form, render::BillboardForm::Planar);
    EXPECT_FALSE(settings.detail);
    EXPECT_EQ(settings.particleShare, 0.25f);
    EXPECT_EQ(settings.shimmer.strength, 0.0f);
}

} // namespace fx::quality
