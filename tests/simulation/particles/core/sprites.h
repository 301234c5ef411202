/// @file sprites.h
/// Emitters of sprites for tests.
#pragma once

#include "tests/simulation/stage.h"

#include <array>

namespace fx::test {

/// An emitter of sprites that are born in a disc and move upwards. The motion has a closed form.
inline std::unique_ptr<sim::EmitterDef> spriteEmitter(float rate, base::Range lifetime)
{
    auto def = rateEmitter(rate);
    def->appearance.kind = sim::AppearanceKind::Sprite;
    def->lifetime = lifetime;
    def->shape = sim::EmitterShape::Cone;
    def->size = {0.5f, 0, 0};
    def->angle = 0.6f;
    def->speed = {1.0f, 6.0f};
    def->radius = {0.02f, 0.06f};
    def->forces.drag = 0.8f;
    def->forces.wind = {1.0f, 0.0f, 0.25f};
    def->appearance.spin = {-2.0f, 2.0f};
    const std::array<base::CurveKey<1>, 3> keys{{{0.0f, {0.2f}}, {0.25f, {1.0f}}, {1.0f, {0.0f}}}};
    def->opacityOverLife = base::ScalarCurve(std::span<const base::CurveKey<1>>(keys));
    return def;
}

/// A module without effect. Emitters with this module integrate motion in steps.
class Idle final : public sim::TileOp
{
public:
    sim::TilePhase phase() const override { return sim::TilePhase::Force; }
    void run(const sim::TileContext&, const void*, sim::Tile&) const override {}
};

} // namespace fx::test
