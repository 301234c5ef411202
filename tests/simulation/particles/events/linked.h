/// @file linked.h
/// Effects whose emitters cause births in each other, for tests.
#pragma once

#include "tests/simulation/particles/core/sprites.h"

#include <utility>
#include <vector>

namespace fx::test {

/// Creates an effect from emitters. An emitter that causes births in another emitter must precede it.
template <class... Defs>
std::shared_ptr<sim::EffectDef> linkedEffect(std::unique_ptr<Defs>... defs)
{
    auto effect = std::make_shared<sim::EffectDef>();
    effect->hasGround = false;
    (effect->solvers.push_back(std::move(defs)), ...);
    for (uint32_t i = 0; i < effect->solvers.size(); ++i)
        effect->order.push_back(i);
    return effect;
}

/// An emitter of sprites without motion. Births are caused only by events, at the positions of the events.
inline std::unique_ptr<sim::EmitterDef> fedEmitter(float lifetime = 1000.0f)
{
    auto def = std::make_unique<sim::EmitterDef>();
    def->fed = true;
    def->appearance.kind = sim::AppearanceKind::Sprite;
    def->lifetime = {lifetime, lifetime};
    def->forces.gravity = 0;
    return def;
}

inline sim::EventRule ruleOf(sim::EventKind on, uint32_t target, uint32_t count = 1)
{
    sim::EventRule rule;
    rule.on = on;
    rule.target = target;
    rule.fewest = rule.most = count;
    return rule;
}

struct Seen
{
    glm::vec3 position;
    float age;
};

/// The particles in the group of the solver with the index `solver`, by row.
inline std::vector<Seen> particlesOf(const base::FrameSnapshot& snapshot, uint32_t solver)
{
    namespace column = base::particle_column;
    std::vector<Seen> seen;
    for (size_t g = 0; g < snapshot.groupCount(); ++g) {
        const base::SnapshotGroup& group = snapshot.group(g);
        if (group.info().solver != solver)
            continue;
        for (uint32_t i = 0; i < group.info().count; ++i)
            if (group.column(column::Radius)[i] > 0)
                seen.push_back({{group.column(column::PositionX)[i], group.column(column::PositionY)[i],
                                 group.column(column::PositionZ)[i]},
                                group.column(column::Age)[i]});
    }
    return seen;
}

} // namespace fx::test
