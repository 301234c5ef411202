#include "tests/quality/scripted_load.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>

namespace fx::quality::test {

namespace {

constexpr int kSecond = 60; ///< [frame]
constexpr uint8_t kStart = 3;
using Times = std::array<double, kTechniques>;

/// [1] of each technique in units of the normal load.
Times loadAt(int frame)
{
    Times load;
    load.fill(frame >= 1500 && frame < 2500 ? 2.5 : 1.0);
    if (frame >= 3500 && frame < 3900)
        load[0] = 8.0;
    if (frame >= 4500 && frame < 4510)
        load.fill(4.0);
    return load;
}

double unit(uint64_t seed, int frame, uint32_t what)
{
    return double(base::toUnitFloat(base::philox({uint32_t(frame), what, 0, 0}, seed)[0]));
}

double gauss(uint64_t seed, int frame, uint32_t what)
{
    const double u = 1.0 - unit(seed, frame, 2 * what);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * unit(seed, frame, 2 * what + 1));
}

/// Time of each technique: 10 % of noise, and 2 % of frames in which everything takes 1.6 times as long.
Times timesOf(const Script& script, int frame, const Choice& choice, bool noisy)
{
    static const std::vector<ScalabilityLevels> kTechniqueLevels = sixTechniques();
    const double spike = noisy && unit(script.seed, frame, 100) < 0.02 ? 1.6 : 1.0;
    Times times = loadAt(frame);
    for (uint32_t i = 0; i < kTechniques; ++i) {
        times[i] *= 2.2 * kTechniqueLevels[i].steps[choice[i]].cost;
        if (noisy)
            times[i] *= spike * std::clamp(1.0 + 0.1 * gauss(script.seed, frame, i), 0.7, 1.5);
    }
    return times;
}

double sum(const Times& times)
{
    return std::accumulate(times.begin(), times.end(), 0.0);
}

/// Watches one run.
class Judge
{
public:
    explicit Judge(const Script& script) : script_(script) {}

    void see(int frame, const Choice& choice, double milliseconds)
    {
        outcome_.over += milliseconds > kBudget ? 1 : 0;
        outcome_.switches += frame > 0 && choice != history_.back() ? 1 : 0;
        history_.push_back(choice);
        for (size_t i = 0; i < kTechniques; ++i)
            outcome_.meanError += sixTechniques_[i].steps[choice[i]].error / kFrames;
        if (sum(timesOf(script_, frame, choice, false)) > kBudget) {
            for (const int change : loadChanges())
                if (frame >= change && frame < change + 100)
                    outcome_.worstRecovery = std::max(outcome_.worstRecovery, frame - change + 1);
        }
    }

    Outcome finish()
    {
        for (size_t i = 0; i < kTechniques; ++i)
            countReturns(i);
        return outcome_;
    }

private:
    static bool jumpsBetween(int from, int to)
    {
        for (const int change : loadChanges())
            if (change > from - kSecond && change <= to)
                return true;
        return false;
    }

    void countReturns(size_t technique)
    {
        std::vector<int> at; // frames of its changes
        for (int f = 1; f < kFrames; ++f)
            if (history_[size_t(f)][technique] != history_[size_t(f) - 1][technique])
                at.push_back(f);
        const auto value = [&](int frame) { return history_[size_t(frame)][technique]; };
        for (size_t k = 1; k < at.size(); ++k) {
            const bool returned = value(at[k]) == value(at[k - 1] - 1) && at[k] - at[k - 1] < kSecond;
            outcome_.returns += returned && !jumpsBetween(at[k - 1], at[k]) ? 1 : 0;
            outcome_.flickers +=
                returned && k > 1 && value(at[k - 1]) == value(at[k - 2] - 1) && at[k] - at[k - 2] < kSecond
                    ? 1
                    : 0;
        }
    }

    const Script& script_;
    std::vector<ScalabilityLevels> sixTechniques_ = sixTechniques();
    std::vector<Choice> history_;
    Outcome outcome_;
};

Choice everything(uint8_t step)
{
    Choice choice{};
    std::fill_n(choice.begin(), kTechniques, step);
    return choice;
}

} // namespace

std::vector<ScalabilityLevels> sixTechniques()
{
    const double milliseconds[] = {0.0, 0.25, 0.45, 0.8, 1.3, 2.2};
    const double errors[] = {1.0, 0.3, 0.12, 0.04, 0.012, 0.0};
    std::vector<ScalabilityLevels> techniqueLevels(kTechniques, ScalabilityLevels{"scripted", {}});
    for (ScalabilityLevels& levels : techniqueLevels)
        for (size_t k = 0; k < std::size(errors); ++k)
            levels.steps.push_back({milliseconds[k] / 2.2, errors[k], {}});
    return techniqueLevels;
}

std::vector<int> loadChanges()
{
    return {0, 1500, 2500, 3500, 3900, 4500, 4510};
}

Outcome playController(const Script& script)
{
    struct Pending
    {
        Choice choice;
        Times times;
        bool teaches;
    };
    constexpr std::array<double, kTechniques> kWeights = {1, 1, 1, 1, 1, 1};
    BudgetController controller(sixTechniques());
    std::deque<Pending> late;
    Judge judge(script);
    for (int frame = 0; frame < kFrames; ++frame) {
        if (int(late.size()) >= script.delay) {
            if (late.front().teaches)
                controller.observe(late.front().choice, late.front().times);
            late.pop_front();
        }
        const bool hold = script.isCatchUp && script.isCatchUp(frame);
        const Choice choice = controller.choose({kBudget, kFrameTime, hold, kWeights});
        const Times times = timesOf(script, frame, choice, true);
        late.push_back({choice, times, !hold});
        judge.see(frame, choice, sum(times));
    }
    return judge.finish();
}

Outcome playFixed(const Script& script)
{
    Judge judge(script);
    for (int frame = 0; frame < kFrames; ++frame)
        judge.see(frame, everything(kStart), sum(timesOf(script, frame, everything(kStart), true)));
    return judge.finish();
}

Outcome playNaive(const Script& script)
{
    Judge judge(script);
    uint8_t step = kStart;
    for (int frame = 0; frame < kFrames; ++frame) {
        const double total = sum(timesOf(script, frame, everything(step), true));
        judge.see(frame, everything(step), total);
        if (total > kBudget)
            step = uint8_t(std::max(0, step - 1));
        else if (kBudget > 1.15 * total)
            step = uint8_t(std::min(5, step + 1));
    }
    return judge.finish();
}

} // namespace fx::quality::test
