/// @file marker_solver.h
/// The simulation of markers. Each marker rises at a constant speed.
#pragma once

#include "simulation/solver/solver.h"

#include <glm/vec3.hpp>

#include <string>

namespace fx::test {

/// One marker.
struct MarkerDef final : sim::SolverDef
{
    std::string name;
    glm::vec3 position{0.0f};  ///< [m] position at the start
    glm::vec3 luminance{1.0f}; ///< [cd/m2]
    float side = 1.0f;         ///< [m] side of the square
    float rise = 0.0f;         ///< [m/s] speed along +Y

    std::unique_ptr<sim::Solver> create(const base::SnapshotSchema& schema, const sim::Quality& quality,
                                        std::pmr::memory_resource* memory) const override;
    uint32_t capacity() const override { return 1; }
    bool publishes(const base::KindDesc& kind) const override;
    double workOf(const sim::StepLoad&) const override { return 1.0; }
};

} // namespace fx::test
