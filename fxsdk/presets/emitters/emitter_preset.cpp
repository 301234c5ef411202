#include "embedded/emitters_schema.h"
#include "fxsdk/presets/emitters/emitter_parts_preset.h"
#include "fxsdk/presets/emitters/emitter_technique.h"
#include "fxsdk/presets/field_detail_preset.h"
#include "fxsdk/presets/layer_names.h"

#include <array>
#include <limits>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, sim::ComputeOn>, 3> kComputers{{
    {"cpu", sim::ComputeOn::Cpu},
    {"gpu", sim::ComputeOn::Gpu},
    {"auto", sim::ComputeOn::Auto},
}};

void readBurst(const PresetValue& element, sim::Burst& out)
{
    element.read("time", out.time);
    element.read("count", out.count);
    element.read("cycles", out.cycles);
    element.read("interval", out.interval);
    element.read("probability", out.probability);
    if (out.cycles != 1 && out.interval <= 0.0f)
        element.error("interval", "found no interval; a burst of several cycles needs one");
}

void readMedium(const PresetValue& element, sim::EmitterDef& emitter)
{
    if (element.has("opticalDepth") && element.has("crossSection"))
        element.error("crossSection", "found both crossSection and opticalDepth; allowed is one of them");
    element.read("opticalDepth", emitter.crossSection);
    element.read("crossSection", emitter.crossSection);
    emitter.opticalDepthGiven = !element.has("crossSection");
    element.read("temperature", emitter.temperature);
    element.read("fireShare", emitter.fireShare);
    element.read("heat", emitter.heat);
    element.read("detailAmount", emitter.detailAmount);
    element.read("detailScale", emitter.detailScale);
    element.read("anisotropy", emitter.anisotropy);
    element.read("shutter", emitter.shutter);
    readFieldDetail(element, emitter.detail);
}

void readCurves(const PresetValue& element, sim::EmitterDef& emitter)
{
    element.read("sizeOverLife", emitter.sizeOverLife);
    element.read("opacityOverLife", emitter.opacityOverLife);
    element.read("temperatureOverLife", emitter.temperatureOverLife);
    element.read("albedoOverLife", emitter.albedoOverLife);
    element.read("emissionOverLife", emitter.emissionOverLife);
}

void readSpace(const PresetValue& element, sim::EmitterDef& emitter)
{
    constexpr std::array<std::pair<std::string_view, bool>, 2> kSpaces{{{"local", false}, {"world", true}}};
    element.read("space", std::span<const std::pair<std::string_view, bool>>(kSpaces), emitter.inWorld);
    element.read("inheritVelocity", emitter.inheritVelocity);
    if (emitter.inheritVelocity > 0.0f && !emitter.inWorld)
        element.error("inheritVelocity",
                      "found an inherited velocity of particles that move with the instance "
                      "anyway; add \"space\": \"world\"");
}

} // namespace

void readEmitterEmission(const PresetValue& emission, sim::Emission& out)
{
    out.duration = std::numeric_limits<float>::infinity();
    emission.read("rate", out.rate);
    emission.read("start", out.start);
    emission.read("duration", out.duration);
    emission.read("rateOverTime", out.rateOverTime);
    if (emission.child("rateOverTime").has("keys") && !emission.has("duration"))
        emission.error("rateOverTime",
                       "found a rate that changes over a duration that is not given; add a duration");
    for (size_t i = 0; i < emission.size("bursts"); ++i) {
        out.bursts.emplace_back();
        readBurst(emission.element("bursts", i), out.bursts.back());
    }
}

std::string_view emitterSchema()
{
    return emitters_schema::texts()[0].text;
}

void buildEmitter(const PresetValue& element, sim::EffectDef& effect)
{
    auto emitter = std::make_unique<sim::EmitterDef>();
    element.read("name", emitter->name);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayerNames),
                 emitter->layer);
    element.read("maxParticles", emitter->maxParticles);
    element.read("compute", std::span<const std::pair<std::string_view, sim::ComputeOn>>(kComputers),
                 emitter->compute);
    element.read("lifetime", emitter->lifetime);
    element.read("speed", emitter->speed);
    element.read("radius", emitter->radius);
    readEmitterShape(element, *emitter);
    readSpace(element, *emitter);
    readMedium(element, *emitter);
    readEmitterForces(element, *emitter);
    readCurves(element, *emitter);
    readEmitterAppearance(element.child("appearance"), emitter->appearance);
    readEmitterTrail(element.child("trail"), emitter->trail);
    readEmitterLight(element, emitter->light);
    readEmitterEmission(element.child("emission"), emitter->emission);
    effect.solvers.push_back(std::move(emitter));
}

void linkEmitters(const PresetValue& root, sim::EffectDef& effect)
{
    linkEmitterEvents(root, effect);
    warnOfDepthOnCpu(root, effect);
}

} // namespace fx::preset
