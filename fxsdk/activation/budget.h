/// @file budget.h
/// Selects the most significant instances that fit into a budget, with hysteresis.
#pragma once

#include <cstdint>
#include <span>

namespace fx::activation {

/// Limits of the total cost of all instances. A limit of 0 means no limit.
struct Budget
{
    uint64_t particles = 0;
    double milliseconds = 0;           ///< [ms] limit of the estimated simulation time of a step
    uint64_t bytes = 0;                ///< [byte] limit of the estimated memory of particles
    double nanosecondsPerParticle = 0; ///< [ns] estimated time per particle and step; 0: the time is measured

    bool any() const { return particles > 0 || milliseconds > 0 || bytes > 0; }
};

/// An instance that requests simulation.
struct Candidate
{
    double significance = 0; ///< [1] significance; a larger value is more important
    uint64_t serial = 0;     ///< order of creation; decides between equal significances
    uint64_t particles = 0;
    uint64_t bytes = 0; ///< [byte]
    uint32_t key = 0;
    bool runs = false;    ///< whether the instance is simulated now
    bool must = false;    ///< true: the instance is simulated in any case
    bool granted = false; ///< result: whether the instance is simulated
};

/// Hysteresis: the significance of an active instance is multiplied by this factor. Instances of equal
/// significance therefore do not alternate.
constexpr double kReluctance = 1.25;

/// Sorts `candidates`: mandatory candidates first, then by decreasing significance. Grants, in this order,
/// each candidate that fits into the remaining budget. Mandatory candidates are always granted. The most
/// significant candidate is always granted. Equal inputs give equal results.
void share(const Budget& budget, double nanosecondsPerParticle, std::span<Candidate> candidates);

} // namespace fx::activation
