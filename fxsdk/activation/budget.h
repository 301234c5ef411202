/// @file budget.h
/// Selects the most significant instances that fit into a budget, with hysteresis.
#pragma once

#include <cstdint>
#include <span>

namespace fx::activation {

/// Limits of the cost of all instances together; 0: no limit.
struct Budget
{
    uint64_t particles = 0;
    double milliseconds = 0;           ///< [ms] of simulation in a step, as estimated
    uint64_t bytes = 0;                ///< [byte] of particles, as estimated
    double nanosecondsPerParticle = 0; ///< [ns] of a step; 0: measured

    bool any() const { return particles > 0 || milliseconds > 0 || bytes > 0; }
};

/// An instance that requests simulation.
struct Candidate
{
    double significance = 0; ///< [1] larger is more important
    uint64_t serial = 0;     ///< order of creation: decides between equals
    uint64_t particles = 0;
    uint64_t bytes = 0; ///< [byte]
    uint32_t key = 0;
    bool runs = false;    ///< is simulated now
    bool must = false;    ///< cannot be turned away
    bool granted = false; ///< the answer
};

/// Hysteresis: the significance of an active instance is multiplied by this, so that equal ones do not
/// alternate.
constexpr double kReluctance = 1.25;

/// Sorts `candidates` by significance and grants those that fit, in that order; mandatory ones come first.
/// The most significant one is always granted. Equal inputs give equal results.
void share(const Budget& budget, double nanosecondsPerParticle, std::span<Candidate> candidates);

} // namespace fx::activation
