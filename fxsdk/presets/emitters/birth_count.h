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

/// Expected births in the emitters of one preset, including births by events. Births of an emitter within a
/// lifetime are computed once for each different lifetime and cached, so the work is proportional to the
/// number of rules times the number of different lifetimes. Events form no cycle.
class BirthCount
{
public:
    explicit BirthCount(const std::vector<const sim::EmitterDef*>& emitters);

    /// Particles alive at once, with unlimited capacity.
    double alive(size_t index) { return wanted(lifeOf(index), index); }

private:
    struct Cause
    {
        size_t emitter;
        const sim::EventRule* rule;
    };

    /// Number of the emitter's longest life in `lives_`.
    size_t lifeOf(size_t index) const;
    /// Births of emitter number `index` within a time span of lifetime number `life`, with unlimited
    /// capacity.
    double wanted(size_t life, size_t index);
    /// The same, limited by the capacity.
    double within(size_t life, size_t index);
    double causedBy(size_t cause, const sim::EventRule& rule, size_t life);

    const std::vector<const sim::EmitterDef*>& emitters_;
    std::vector<std::vector<Cause>> causes_;   ///< of births in each emitter
    std::vector<double> lives_;                ///< [s] longest ones of all emitters, ascending, each once
    std::vector<std::optional<double>> known_; ///< of within(), by emitter and life
};

} // namespace fx::preset
