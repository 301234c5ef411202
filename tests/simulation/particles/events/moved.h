/// @file moved.h
/// Emitters whose particles stay in world space when their instance moves, for tests.
#pragma once

#include "simulation/emitters/emitter_solver.h"
#include "tests/simulation/particles/events/linked.h"

#include <memory>
#include <vector>

namespace fx::test {

/// An emitter of `rate` sprites per second that do not move after birth.
inline std::unique_ptr<sim::EmitterDef> dropper(float rate)
{
    auto def = rateEmitter(rate);
    def->appearance.kind = sim::AppearanceKind::Sprite;
    def->forces.gravity = 0;
    def->inWorld = true;
    return def;
}

inline base::Placement at(double x, double y = 0.0, double z = 0.0)
{
    base::Placement placement;
    placement.position = {x, y, z};
    return placement;
}

inline base::Placement turnedAboutZ(float radians)
{
    base::Placement placement;
    placement.rotation = glm::angleAxis(radians, glm::vec3(0, 0, 1));
    return placement;
}

/// World positions of the elements that solver 0 publishes.
inline std::vector<glm::dvec3> worldPositions(const base::FrameSnapshot& snapshot, uint32_t solver = 0)
{
    std::vector<glm::dvec3> found;
    for (size_t g = 0; g < snapshot.groupCount(); ++g)
        if (snapshot.group(g).info().solver == solver) {
            const base::Placement& p = snapshot.group(g).info().placement;
            for (const Seen& seen : particlesOf(snapshot, solver))
                found.push_back(p.position + glm::dvec3(p.rotation * (p.scale * seen.position)));
        }
    return found;
}

} // namespace fx::test
