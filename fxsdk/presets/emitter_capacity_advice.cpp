// What an emitter's capacity has to hold and what it takes.
#include "fxsdk/presets/emitter_advice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fx::preset {

namespace {

constexpr uint64_t kMuchMemory = uint64_t(1) << 30; // [byte]
constexpr uint64_t kFewPoints = uint64_t(1) << 22;  // of at most 250 bytes: less than that much memory

/// The largest value of a curve.
float peakOf(const base::ScalarCurve& curve)
{
    float peak = 0.0f;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        peak = std::max(peak, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return peak;
}

/// Births of an emitter's own within any `seconds`, at most.
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

/// How often the event happens in a particle's life; at a collision, once.
double timesOf(const sim::EventRule& rule, const base::Range& lifetime)
{
    if (rule.on != sim::EventKind::Age)
        return 1.0;
    const base::Ticks life = base::toTicks(0.5 * double(lifetime.min + lifetime.max));
    if (life < rule.age)
        return lifetime.max > lifetime.min ? 0.5 : 0.0;
    return rule.every > 0 ? std::min(double((life - rule.age) / rule.every) + 1.0, double(sim::kMostAges))
                          : 1.0;
}

/// Births in the emitters of one preset, those that events cause included, as they are to be expected.
class BirthCount
{
public:
    explicit BirthCount(const std::vector<const sim::EmitterDef*>& emitters) : emitters_(emitters) {}

    /// Within any `seconds` of emitter number `index`.
    double within(double seconds, size_t index) const
    {
        const sim::EmitterDef& emitter = *emitters_[index];
        double births = ownBirths(emitter.emission, seconds);
        for (size_t cause = 0; emitter.fed && cause < emitters_.size(); ++cause)
            for (const sim::EventRule& rule : emitters_[cause]->events)
                if (rule.target == index)
                    births += causedBy(cause, rule, seconds);
        const double life = std::max(double(emitter.lifetime.min), 1e-3);
        return std::min(births, double(emitter.maxParticles) * (seconds / life + 1.0));
    }
    /// Alive at once, if there were room for all.
    double alive(size_t index) const
    {
        const sim::EmitterDef& emitter = *emitters_[index];
        double births = ownBirths(emitter.emission, double(emitter.lifetime.max));
        for (size_t cause = 0; emitter.fed && cause < emitters_.size(); ++cause)
            for (const sim::EventRule& rule : emitters_[cause]->events)
                if (rule.target == index)
                    births += causedBy(cause, rule, double(emitter.lifetime.max));
        return births;
    }

private:
    double causedBy(size_t cause, const sim::EventRule& rule, double seconds) const
    {
        const double count = 0.5 * (double(rule.fewest) + double(rule.most)) * double(rule.probability);
        if (rule.on == sim::EventKind::Host)
            return count; // how often is the host's affair
        const base::Range& life = emitters_[cause]->lifetime;
        double events = within(seconds, cause) * timesOf(rule, life);
        if (rule.every > 0) // no more than all who live at once can cause
            events = std::min(events, within(double(life.max), cause) *
                                          (seconds / base::toSeconds(rule.every) + 1.0));
        return count * (events > 0.0 ? std::max(events, 1.0) : 0.0);
    }

    const std::vector<const sim::EmitterDef*>& emitters_;
};

std::string mebibytes(uint64_t bytes)
{
    return std::to_string((bytes + (uint64_t(1) << 19)) >> 20) + " MiB";
}

void adviseMemory(const PresetValue& element, const sim::EmitterDef& emitter)
{
    const bool hasTrail = emitter.trail.lifetime > 0.0f;
    if (uint64_t(emitter.maxParticles) * (hasTrail ? emitter.trail.maxPoints : 1) < kFewPoints)
        return; // to count exactly takes longer than all else
    const uint64_t bytes = emitter.bytes();
    if (bytes > kMuchMemory)
        element.warning("maxParticles", "takes about " + mebibytes(bytes) +
                                            " of memory for each instance; lower maxParticles" +
                                            (hasTrail ? " or maxPoints of the trail" : ""));
}

} // namespace

void adviseCapacity(const PresetValue& root, const sim::EffectDef& effect)
{
    std::vector<const sim::EmitterDef*> emitters;
    for (size_t i = 0; i < root.size("emitters"); ++i)
        emitters.push_back(dynamic_cast<const sim::EmitterDef*>(effect.solvers[i].get()));
    const BirthCount count(emitters);
    for (size_t i = 0; i < emitters.size(); ++i) {
        const PresetValue element = root.element("emitters", i);
        const double alive = count.alive(i);
        if (alive > double(emitters[i]->maxParticles))
            element.warning("maxParticles", (emitters[i]->fed ? "about " : "up to ") +
                                                std::to_string(uint64_t(alive)) + " particles can be alive" +
                                                (emitters[i]->fed ? ", those of events counted," : ",") +
                                                " but " + std::to_string(emitters[i]->maxParticles) +
                                                " is the capacity: births beyond it are dropped");
        adviseMemory(element, *emitters[i]);
    }
}

} // namespace fx::preset
