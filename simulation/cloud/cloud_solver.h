/// @file cloud_solver.h
/// A medium that does not move: balls from a list, the same at all times.
#pragma once

#include "simulation/cloud/ball_list.h"
#include "simulation/solver/still_medium.h"

#include <memory>

namespace fx::sim {

struct CloudDef final : StillMediumDef
{
    std::shared_ptr<const BallList> balls;

    std::unique_ptr<Solver> create(const base::SnapshotSchema& schema, const Quality& quality,
                                   std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return balls ? uint32_t(balls->size()) : 0; }
    bool publishes(const base::KindDesc& kind) const override { return kind == base::kBlobKind; }
    float reach(float gravity, float wind, float seconds) const override;
};

} // namespace fx::sim
