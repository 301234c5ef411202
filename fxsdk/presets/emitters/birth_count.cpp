#include "fxsdk/presets/emitters/birth_count.h"

#include <algorithm>
#include <cmath>

namespace fx::preset {

namespace {

/// The largest value of a curve.
float peakOf(const base::ScalarCurve& curve)
{
    float peak = 0.0f;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        peak = std::max(peak, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return peak;
}

} // namespace

double ownBirths(const sim::Emission& emission, double seconds)
{
    double births = double(emission.rate) * double(peakOf(emission.rateOverTime)) *
                    std::min(seconds, double(emission.duration));
    for (const sim::Burst& burst : emission.bursts) {
        const double within = burst.cycles == 1 ? 1.0 : std::floor(seconds / double(burst.interval)) + 1.0;
        births += double(burst.count) * (burst.cycles == 0 ? within : std::min(within, double(burst.cycles)));
    }
    return births;
}

double timesOf(const sim::EventRule& rule, const base::Range& lifetime)
{
    if (rule.on != sim::EventKind::Age)
        return 1.0;
    const base::Ticks life = base::toTicks(0.5 * double(lifetime.min + lifetime.max));
    if (life < rule.age)
        return lifetime.max > lifetime.min ? 0.5 : 0.0;
    return rule.every > 0 ? std::min(double((life - rule.age) / rule.every) + 1.0, double(sim::kMaxEventAges))
                          : 1.0;
}

BirthCount::BirthCount(const std::vector<const sim::EmitterDef*>& emitters)
    : emitters_(emitters), causes_(emitters.size())
{
    for (size_t cause = 0; cause < emitters.size(); ++cause) {
        lives_.push_back(double(emitters[cause]->lifetime.max));
        for (const sim::EventRule& rule : emitters[cause]->events)
            if (rule.target != sim::kNoTarget)
                causes_[rule.target].push_back({cause, &rule});
    }
    std::sort(lives_.begin(), lives_.end());
    lives_.erase(std::unique(lives_.begin(), lives_.end()), lives_.end());
    known_.resize(emitters.size() * lives_.size());
}

size_t BirthCount::lifeOf(size_t index) const
{
    const double life = double(emitters_[index]->lifetime.max);
    return size_t(std::lower_bound(lives_.begin(), lives_.end(), life) - lives_.begin());
}

double BirthCount::wanted(size_t life, size_t index)
{
    double births = ownBirths(emitters_[index]->emission, lives_[life]);
    for (const Cause& cause : causes_[index])
        births += causedBy(cause.emitter, *cause.rule, life);
    return births;
}

double BirthCount::within(size_t life, size_t index)
{
    std::optional<double>& known = known_[index * lives_.size() + life];
    if (!known) {
        const sim::EmitterDef& emitter = *emitters_[index];
        const double shortest = std::max(double(emitter.lifetime.min), 1e-3);
        const double births = wanted(life, index);
        known = std::min(births, double(emitter.maxParticles) * (lives_[life] / shortest + 1.0));
    }
    return *known;
}

double BirthCount::causedBy(size_t cause, const sim::EventRule& rule, size_t life)
{
    const double count = 0.5 * (double(rule.fewest) + double(rule.most)) * double(rule.probability);
    if (rule.on == sim::EventKind::Host)
        return count; // how often is the host's affair
    double events = within(life, cause) * timesOf(rule, emitters_[cause]->lifetime);
    if (rule.every > 0) // at most as many as all living particles can cause
        events = std::min(events,
                          within(lifeOf(cause), cause) * (lives_[life] / base::toSeconds(rule.every) + 1.0));
    return count * (events > 0.0 ? std::max(events, 1.0) : 0.0);
}

} // namespace fx::preset
