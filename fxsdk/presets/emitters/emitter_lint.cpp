#include "fxsdk/presets/emitters/emitter_parts_preset.h"

#include "fxsdk/presets/emitters/emitter_technique.h"
#include "simulation/gpu_programs/gpu_program.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace fx::preset {

namespace {

bool isSet(const PresetValue& value, const char* member)
{
    glm::vec3 given(0.0f);
    value.read(member, given);
    return given != glm::vec3(0.0f);
}

std::string nameOf(const PresetValue& value, const char* member, std::string absent)
{
    value.read(member, absent);
    return absent;
}

/// True when an obstacle of the emitter is of that shape.
bool meets(const PresetValue& element, std::string_view shape)
{
    for (size_t i = 0; i < element.size("collisions"); ++i)
        if (nameOf(element.element("collisions", i), "shape", "") == shape)
            return true;
    return false;
}

/// True when particles meet something: obstacles, the ground or points that kill.
bool meetsAnything(const PresetValue& element, const sim::EmitterDef& emitter)
{
    const PresetValue forces = element.child("forces");
    bool kills = false;
    for (size_t i = 0; i < forces.size("attractors"); ++i)
        kills = kills || isSet(forces.element("attractors", i), "killRadius");
    return kills || element.size("collisions") > 0 || emitter.forces.bounce >= 0.0f;
}

constexpr const char* kNeedsDrag =
    "particles follow the air by their drag alone, and this emitter has none: add \"drag\" to its forces";

void lintAir(const PresetValue& forces)
{
    if (isSet(forces, "drag") || isSet(forces, "quadraticDrag"))
        return;
    for (const char* member : {"wind", "gust", "curlStrength", "updraft"})
        if (isSet(forces, member))
            forces.warning(member, "has no effect; " + std::string(kNeedsDrag));
    for (size_t i = 0; i < forces.size("vortices"); ++i) {
        const PresetValue vortex = forces.element("vortices", i);
        if (!isSet(vortex, "hold"))
            vortex.warning("", "this vortex has no effect; " + std::string(kNeedsDrag) +
                                   ", or \"hold\" to the vortex");
    }
    for (size_t i = 0; i < forces.size("vectorFields"); ++i) {
        const PresetValue field = forces.element("vectorFields", i);
        if (nameOf(field, "acts", "air") == "air")
            field.warning("", "this field of air has no effect; " + std::string(kNeedsDrag) +
                                  ", or \"acts\": \"acceleration\" to the field");
    }
}

void lintObstacle(const PresetValue& value, bool hasGround)
{
    const std::string shape = nameOf(value, "shape", "");
    const bool isEmpty = value.has("size") && !isSet(value, "size") && !isSet(value, "margin");
    if ((shape == "sphere" || shape == "box") && isEmpty)
        value.warning("size", "a " + shape + " of size 0 is met by nothing; give it a size above 0");
    if (shape == "ground" && !hasGround)
        value.warning("shape", "the preset says \"ground\": false, so that there is none to meet; take one "
                               "of the two out");
}

void lintEvents(const PresetValue& element, const sim::EmitterDef& emitter)
{
    for (size_t i = 0; i < element.size("events"); ++i) {
        const PresetValue event = element.element("events", i);
        if (nameOf(event, "on", "") == "collision" && !meetsAnything(element, emitter))
            event.warning("on", "never happens: the emitter's particles meet nothing; add \"collisions\", or "
                                "\"bounce\" to its forces");
    }
}

void lintCompute(const PresetValue& element, const sim::EmitterDef& emitter)
{
    sim::EmitterDef any;
    any.compute = sim::ComputeOn::Gpu;
    any.appearance.kind = sim::AppearanceKind::Sprite;
    const bool canAny = sim::gpuObstacle(any).empty(); // this build at all
    const std::string_view why = sim::gpuObstacle(emitter);
    if (canAny && emitter.compute == sim::ComputeOn::Gpu && !why.empty())
        element.warning("compute", "found \"gpu\", but the CPU computes this emitter: " + std::string(why) +
                                       "; change that, or leave \"compute\" out");
}

void lintUpdraft(const PresetValue& root)
{
    for (size_t i = 0; root.size("gas") == 0 && i < root.size("emitters"); ++i) {
        const PresetValue forces = root.element("emitters", i).child("forces");
        if (isSet(forces, "updraft"))
            forces.warning("updraft", "has no effect without \"gas\" in the preset; add a gas, or take "
                                      "\"updraft\" out");
    }
}

void lintWind(const PresetValue& root, const sim::EffectDef& effect)
{
    if (!isSet(root, "wind") || effect.solvers.size() != root.size("emitters") || effect.solvers.empty())
        return; // gases and fragments feel it
    for (size_t i = 0; i < root.size("emitters"); ++i) {
        const PresetValue forces = root.element("emitters", i).child("forces");
        if (isSet(forces, "drag") || isSet(forces, "quadraticDrag"))
            return;
    }
    root.warning("wind", "has no effect; particles follow the air by their drag alone, and no emitter has "
                         "any: add \"drag\" to the forces of one");
}

} // namespace

void lintForces(const PresetValue& element, bool hasGround)
{
    const PresetValue forces = element.child("forces");
    lintAir(forces);
    for (size_t i = 0; i < element.size("collisions"); ++i)
        lintObstacle(element.element("collisions", i), hasGround);
    float bounce = -1.0f;
    forces.read("bounce", bounce);
    for (const char* shape : {"ground", "scene"})
        if (bounce >= 0.0f && meets(element, shape))
            forces.warning("bounce", "has no effect on the " + std::string(shape) +
                                         ", which stands among the collisions as well; give \"bounce\" "
                                         "there alone");
    if (bounce < 0.0f && isSet(forces, "friction"))
        forces.warning("friction", "has no effect without a bounce; add \"bounce\" to the forces, or give "
                                   "\"friction\" to one of the collisions");
}

void lintEmitters(const PresetValue& root, const sim::EffectDef& effect)
{
    const std::vector<const sim::EmitterDef*> emitters = sim::emittersOf(effect);
    for (size_t i = 0; i < root.size("emitters"); ++i) {
        const PresetValue element = root.element("emitters", i);
        const sim::EmitterDef& emitter = *emitters[i];
        lintForces(element, effect.hasGround);
        lintShape(element);
        lintAppearance(element, emitter);
        lintEvents(element, emitter);
        lintCompute(element, emitter);
        if (emitter.appearance.kind == sim::AppearanceKind::None && emitter.events.empty() &&
            !emitter.light.given && !(emitter.trail.lifetime > 0.0f) && !meets(element, "hook"))
            element.child("appearance")
                .warning("kind",
                         "found \"none\" without a trail, a light or events: nothing of this emitter is "
                         "ever seen; add one of them, or another kind");
    }
    lintWind(root, effect);
    lintUpdraft(root);
    lintCapacity(root, effect);
}

} // namespace fx::preset
