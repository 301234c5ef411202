/// @file effect_def.h
/// What a preset says, ready to run: the immutable definition that all its instances share.
#pragma once

#include "foundation/time/ticks.h"
#include "simulation/solver.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace fx::sim {

struct EffectDef
{
    std::string name;
    uint64_t fingerprint = 0; ///< of all that the preset says: equal for equal presets; 0 when there was none
    base::Ticks duration = 0; ///< end of the effect's life; 0 for "until its solvers have finished"
    uint32_t subSteps = 1;    ///< steps of the effect per step of the scene, 1..16
    glm::vec3 wind{0.0f};     ///< [m/s] local
    bool hasGround = true;    ///< particles stay above the instance's y = 0
    std::vector<std::unique_ptr<const SolverDef>> solvers;

    /// True when the host's geometry changes what it does.
    bool collides() const
    {
        return std::any_of(solvers.begin(), solvers.end(), [](const auto& def) { return def->collides(); });
    }
};

} // namespace fx::sim
