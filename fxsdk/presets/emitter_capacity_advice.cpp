// What an emitter's capacity has to hold and what it takes.
#include "fxsdk/presets/emitter_advice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

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

/// Births in the emitters of one preset, those that events cause included, as they are to be expected. Each
/// emitter is asked for the births within the longest lives of others, which are few: each answer is found
/// once, so that the work grows with the rules times the different lives, however rules lead from emitter to
/// emitter. Events make no circle.
class BirthCount
{
public:
    explicit BirthCount(const std::vector<const sim::EmitterDef*>& emitters)
        : emitters_(emitters), causes_(emitters.size())
    {
        for (size_t cause = 0; cause < emitters.size(); ++cause) {
            lives_.push_back(double(emitters[cause]->lifetime.max));
            for (const sim::EventRule& rule : emitters[cause]->events)
                causes_[rule.target].push_back({cause, &rule});
        }
        std::sort(lives_.begin(), lives_.end());
        lives_.erase(std::unique(lives_.begin(), lives_.end()), lives_.end());
        known_.resize(emitters.size() * lives_.size());
    }

    /// Alive at once, if there were room for all.
    double alive(size_t index) { return wanted(lifeOf(index), index); }

private:
    struct Cause
    {
        size_t emitter;
        const sim::EventRule* rule;
    };

    /// Number of the emitter's longest life in `lives_`.
    size_t lifeOf(size_t index) const
    {
        const double life = double(emitters_[index]->lifetime.max);
        return size_t(std::lower_bound(lives_.begin(), lives_.end(), life) - lives_.begin());
    }

    /// Births of emitter number `index` within any time of life number `life`, if there were room for all.
    double wanted(size_t life, size_t index)
    {
        double births = ownBirths(emitters_[index]->emission, lives_[life]);
        for (const Cause& cause : causes_[index])
            births += causedBy(cause.emitter, *cause.rule, life);
        return births;
    }

    /// The same with the room that there is.
    double within(size_t life, size_t index)
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

    double causedBy(size_t cause, const sim::EventRule& rule, size_t life)
    {
        const double count = 0.5 * (double(rule.fewest) + double(rule.most)) * double(rule.probability);
        if (rule.on == sim::EventKind::Host)
            return count; // how often is the host's affair
        double events = within(life, cause) * timesOf(rule, emitters_[cause]->lifetime);
        if (rule.every > 0) // no more than all who live at once can cause
            events = std::min(events, within(lifeOf(cause), cause) *
                                          (lives_[life] / base::toSeconds(rule.every) + 1.0));
        return count * (events > 0.0 ? std::max(events, 1.0) : 0.0);
    }

    const std::vector<const sim::EmitterDef*>& emitters_;
    std::vector<std::vector<Cause>> causes_;   ///< of births in each emitter
    std::vector<double> lives_;                ///< [s] longest ones of all emitters, ascending, each once
    std::vector<std::optional<double>> known_; ///< of within(), by emitter and life
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
    BirthCount count(emitters);
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
