/// @file birth_count.h
/// Expected numbers of births of the emitters of a preset.
#pragma once

#include "simulation/emitters/emitter_def.h"

#include <optional>
#include <vector>

namespace fx::preset {

/// Maximum number of births within any interval of `seconds`, without births by events.
double ownBirths(const sim::Emission& emission, double seconds);

/// Expected number of events of a rule during the life of a particle. Collisions count as one event.
double timesOf(const sim::EventRule& rule, const base::Range& lifetime);

/// Expected births in the emitters of one preset, including births by events. Births of an emitter are
/// computed once for each different lifetime and cached. The work is therefore proportional to the number of
/// rules times the number of different lifetimes. Events form no cycle.
class BirthCount
{
public:
    explicit BirthCount(const std::vector<const sim::EmitterDef*>& emitters);

    /// Expected number of living particles of emitter number `index`, with unlimited capacity.
    double alive(size_t index) { return wanted(lifeOf(index), index); }

private:
    struct Cause
    {
        size_t emitter;
        const sim::EventRule* rule;
    };

    /// Index in `lives_` of the longest lifetime of the emitter.
    size_t lifeOf(size_t index) const;
    /// Births of emitter number `index` within a time span of lifetime number `life`, with unlimited
    /// capacity.
    double wanted(size_t life, size_t index);
    /// The births of wanted(), limited by the capacity of the emitter.
    double within(size_t life, size_t index);
    double causedBy(size_t cause, const sim::EventRule& rule, size_t life);

    const std::vector<const sim::EmitterDef*>& emitters_;
    std::vector<std::vector<Cause>> causes_; ///< causes of births for each emitter
    std::vector<double> lives_; ///< [s] longest lifetimes of all emitters, ascending, without duplicates
    std::vector<std::optional<double>> known_; ///< cached results of within() for each emitter and lifetime
};

} // namespace fx::preset
