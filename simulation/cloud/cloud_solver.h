/// @file cloud_solver.h
/// A medium that does not move: balls from a list, the same at all times.
#pragma once

#include "foundation/snapshot/blob_kind.h"
#include "simulation/cloud/ball_list.h"
#include "simulation/solver/solver.h"

#include <memory>
#include <string>

namespace fx::sim {

struct CloudDef final : SolverDef
{
    std::string name;
    std::shared_ptr<const BallList> balls;
    glm::vec3 position{0.0f};                         ///< [m] of the list's own origin
    float scale = 1.0f;                               ///< [1] multiplies lengths, > 0
    float density = 1.0f;                             ///< [1] multiplies the extinction, >= 0
    float anisotropy = 0.0f;                          ///< [1] mean cosine of the scattering angle
    float fireShare = 0.0f;                           ///< [1] part accounted to the fire layer
    base::MediaLayer layer = base::MediaLayer::Smoke; ///< of the rest

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return balls ? uint32_t(balls->size()) : 0; }
    bool publishes(const base::KindDesc& kind) const override { return kind == base::kBlobKind; }
    Influence influence() const override { return {}; }
    CatchUp catchUp() const override { return CatchUp::Analytic; }
    float reach(float gravity, float wind, float seconds) const override;
};

} // namespace fx::sim
