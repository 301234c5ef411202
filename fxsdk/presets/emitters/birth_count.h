/// @file birth_count.h
/// How many particles the emitters of a preset are to be expected to give birth to.
#pragma once

#include "simulation/emitters/emitter_def.h"

#include <optional>
#include <vector>

namespace fx::preset {

/// Births of an emitter's own within any `seconds`, at most.
double ownBirths(const sim::Emission& emission, double seconds);

/// How often the event happens in a particle's life; at a collision, once.
double timesOf(const sim::EventRule& rule, const base::Range& lifetime);

/// Births in the emitters of one preset, those that events cause included, as they are to be expected. Each
/// emitter is asked for the births within the longest lives of others, which are few: each answer is found
/// once, so that the work grows with the rules times the different lives, however rules lead from emitter to
/// emitter. Events make no circle.
class BirthCount
{
public:
    explicit BirthCount(const std::vector<const sim::EmitterDef*>& emitters);

    /// Alive at once, if there were room for all.
    double alive(size_t index) { return wanted(lifeOf(index), index); }

private:
    struct Cause
    {
        size_t emitter;
        const sim::EventRule* rule;
    };

    /// Number of the emitter's longest life in `lives_`.
    size_t lifeOf(size_t index) const;
    /// Births of emitter number `index` within any time of life number `life`, if there were room for all.
    double wanted(size_t life, size_t index);
    /// The same with the room that there is.
    double within(size_t life, size_t index);
    double causedBy(size_t cause, const sim::EventRule& rule, size_t life);

    const std::vector<const sim::EmitterDef*>& emitters_;
    std::vector<std::vector<Cause>> causes_;   ///< of births in each emitter
    std::vector<double> lives_;                ///< [s] longest ones of all emitters, ascending, each once
    std::vector<std::optional<double>> known_; ///< of within(), by emitter and life
};

} // namespace fx::preset
