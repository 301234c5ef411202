/// @file effect_def.h
/// The immutable definition of an effect, built from a preset and shared by all its instances.
#pragma once

#include "foundation/time/ticks.h"
#include "simulation/solver/drawing_hints.h"
#include "simulation/solver/preview_def.h"
#include "simulation/solver/solver.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fx::sim {

/// Estimated cost of an instance at medium quality, with steps of 1/60 s.
struct EffectCost
{
    double stepWork = 0;  ///< [unit of base::WorkBudget] work of the most expensive step
    double startWork = 0; ///< [unit of base::WorkBudget] work of the prewarm
    uint64_t memory = 0;  ///< [byte] memory of solvers and snapshots
};

struct EffectDef
{
    std::string name;
    /// hash of the preset, equal for equal presets; 0 if the effect was not built from a preset
    uint64_t fingerprint = 0;
    base::Ticks duration = 0; ///< lifetime of the effect; 0: the effect ends when its solvers have finished
    base::Ticks prewarm = 0;  ///< time that is simulated before the first visible step
    uint32_t subSteps = 1;    ///< number of steps of the effect per step of the scene, 1..16
    glm::vec3 wind{0.0f};     ///< [m/s] wind in local space
    bool hasGround = true;    ///< true: the plane y = 0 of the instance stops particles
    std::optional<CatchUp> offscreen; ///< policy of hidden instances; empty: the policy of the solvers
    /// [m] Upper bound of the local distance of elements from the origin; 0: the bound is computed from the
    /// solvers.
    float bound = 0;
    std::vector<std::unique_ptr<const SolverDef>> solvers;
    /// Order of all solvers in which events of one solver cause births only in later solvers; empty: any
    /// order.
    std::vector<uint32_t> order;
    std::vector<std::string> hostEvents; ///< names of the host's events
    std::vector<std::string> cues;       ///< names that rules give to events for the host
    EffectCost cost;                     ///< cost estimated by the loader of presets
    DrawingHints hints;
    PreviewDef preview;

    /// True if the effect depends on the host's geometry.
    bool collides() const
    {
        return std::any_of(solvers.begin(), solvers.end(), [](const auto& def) { return def->collides(); });
    }

    /// True if the effect depends on the placement of the instance, even without geometry.
    bool dependsOnPlacement() const
    {
        return std::any_of(solvers.begin(), solvers.end(),
                           [](const auto& def) { return def->dependsOnPlacement(); });
    }

    /// True if one of the effect's solvers publishes groups of `kind`.
    bool publishes(const base::KindDesc& kind) const
    {
        return std::any_of(solvers.begin(), solvers.end(),
                           [&](const auto& def) { return def->publishes(kind); });
    }

    bool bendsLight() const
    {
        return std::any_of(solvers.begin(), solvers.end(), [](const auto& def) { return def->bendsLight(); });
    }

    /// See SolverDef::startsInMotion().
    bool startsInMotion() const
    {
        return std::any_of(solvers.begin(), solvers.end(),
                           [](const auto& def) { return def->startsInMotion(); });
    }

    /// Sum of the influences of all solvers. The influences are added, because solvers may cause births in
    /// each other.
    Influence influence() const
    {
        Influence sum;
        for (const auto& def : solvers)
            sum.add(def->influence());
        return sum;
    }

    /// Policy of hidden instances. The result is the policy in the preset if there is one, else the most
    /// restrictive policy of the solvers.
    CatchUp catchUp() const
    {
        if (offscreen)
            return *offscreen;
        CatchUp most = CatchUp::Analytic;
        for (const auto& def : solvers)
            most = std::max(most, def->catchUp());
        return most;
    }

    /// [m] Radius about the local origin within which all elements stay; infinite if unknown.
    float reach(float gravity, float windSpeed) const
    {
        if (bound > 0)
            return bound;
        const float seconds = duration > 0 ? float(base::toSeconds(duration)) : 1e6f;
        float most = 0;
        std::array<BirthReach, 32> few; // no allocation where instances are created
        std::vector<BirthReach> many(solvers.size() > few.size() ? solvers.size() : 0);
        const std::span<BirthReach> births =
            many.empty() ? std::span(few).first(solvers.size()) : std::span<BirthReach>(many);
        for (size_t i = 0; i < solvers.size(); ++i) {
            const size_t solver = order.empty() ? i : order[i]; // causes first
            most = std::max(
                most, solvers[solver]->reachFrom({gravity, windSpeed, seconds}, births[solver], births));
        }
        return most;
    }

    /// [byte] Memory of the solvers of an instance that has its own simulation, without snapshots.
    uint64_t bytes() const
    {
        uint64_t sum = 0;
        for (const auto& def : solvers)
            sum += def->bytes();
        return sum;
    }

    /// Maximum number of simultaneously alive elements, at medium quality.
    uint64_t capacity() const
    {
        uint64_t sum = 0;
        for (const auto& def : solvers)
            sum += def->capacity();
        return sum;
    }
};

} // namespace fx::sim
