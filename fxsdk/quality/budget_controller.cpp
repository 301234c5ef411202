#include "fxsdk/quality/budget_controller.h"

#include <algorithm>
#include <utility>

namespace fx::quality {

BudgetController::BudgetController(std::vector<ScalabilityLevels> techniqueLevels)
    : techniqueLevels_(std::move(techniqueLevels))
{
    reset();
}

void BudgetController::reset()
{
    costs_.reset();
    choice_ = highest(techniqueLevels_);
    memory_ = {};
    calm_ = 0;
    predicted_ = error_ = 0.0;
    saturated_ = false;
    switches_ = 0;
}

void BudgetController::observe(const Choice& choice, std::span<const double> milliseconds)
{
    for (size_t i = 0; i < std::min(techniqueLevels_.size(), milliseconds.size()); ++i)
        costs_.observe(i, techniqueLevels_[i].steps[choice[i]].cost, milliseconds[i]);
}

const Choice& BudgetController::choose(const Frame& frame)
{
    const ChoiceInputs in{techniqueLevels_, &costs_, frame.weights};
    pass(frame.deltaTime);
    if (frame.hold) {
        calm_ = 0;
    } else if (predictedMilliseconds(in, choice_) > kLimit * frame.budget) {
        fall(in, kTarget * frame.budget);
    } else {
        ++calm_;
        rise(in, kTarget * frame.budget);
    }
    predicted_ = predictedMilliseconds(in, choice_);
    error_ = estimatedError(in, choice_);
    saturated_ = predictedMilliseconds(in, {}) > kLimit * frame.budget;
    return choice_;
}

void BudgetController::pass(double seconds)
{
    for (Memory& memory : memory_) {
        memory.sinceFall += seconds;
        memory.sinceRise += seconds;
        if (memory.sinceRise > kProbation && memory.sinceFall > kProbation && memory.patience > 1 &&
            memory.sinceRise > kProbation * memory.patience)
            memory.patience /= 2; // it has stood the test
    }
}

void BudgetController::fall(const ChoiceInputs& in, double target)
{
    calm_ = 0;
    const Choice wanted = climb(in, {}, choice_, target);
    for (size_t i = 0; i < techniqueLevels_.size(); ++i) {
        if (wanted[i] == choice_[i])
            continue;
        Memory& memory = memory_[i];
        if (memory.sinceRise < kProbation)
            memory.patience = std::min(2 * memory.patience, kMaxPatience);
        memory.sinceFall = 0.0;
    }
    take(wanted);
}

void BudgetController::rise(const ChoiceInputs& in, double target)
{
    if (calm_ < kCalmFrames)
        return;
    Choice most = choice_;
    for (size_t i = 0; i < techniqueLevels_.size(); ++i)
        if (calm_ >= kCalmFrames * memory_[i].patience && memory_[i].sinceFall >= kRestSeconds &&
            most[i] + 1u < techniqueLevels_[i].steps.size())
            ++most[i];
    const Choice wanted = climb(in, choice_, most, target);
    if (wanted == choice_)
        return;
    for (size_t i = 0; i < techniqueLevels_.size(); ++i)
        if (wanted[i] != choice_[i])
            memory_[i].sinceRise = 0.0;
    calm_ = 0;
    take(wanted);
}

void BudgetController::take(const Choice& choice)
{
    switches_ += choice != choice_ ? 1 : 0;
    choice_ = choice;
}

} // namespace fx::quality
