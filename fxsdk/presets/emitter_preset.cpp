#include "fxsdk/presets/emitter_preset.h"

#include "simulation/emitters/emitter_def.h"

#include <array>
#include <limits>
#include <numbers>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, sim::EmitterShape>, 4> kShapes{{
    {"point", sim::EmitterShape::Point},
    {"sphere", sim::EmitterShape::Sphere},
    {"box", sim::EmitterShape::Box},
    {"cone", sim::EmitterShape::Cone},
}};

constexpr std::array<std::pair<std::string_view, base::MediaLayer>, 3> kLayers{{
    {"fire", base::MediaLayer::Fire},
    {"smoke", base::MediaLayer::Smoke},
    {"dust", base::MediaLayer::Dust},
}};

void readShape(const PresetValue& element, sim::EmitterDef& emitter)
{
    element.read("shape", std::span<const std::pair<std::string_view, sim::EmitterShape>>(kShapes),
                 emitter.shape);
    element.read("position", emitter.position);
    element.read("size", emitter.size);
    float degrees = 0;
    element.read("angleDegrees", degrees);
    emitter.angle = degrees * (std::numbers::pi_v<float> / 180.0f);
}

/// @return births that can be alive at once, by rate times the longest life and bursts
double readEmission(const PresetValue& emission, float longestLife, sim::Emission& out)
{
    out.duration = std::numeric_limits<float>::infinity();
    emission.read("rate", out.rate);
    emission.read("start", out.start);
    emission.read("duration", out.duration);
    double alive = double(out.rate) * double(std::min(longestLife, out.duration));
    for (size_t i = 0; i < emission.size("bursts"); ++i) {
        const PresetValue element = emission.element("bursts", i);
        sim::Burst burst;
        element.read("time", burst.time);
        element.read("count", burst.count);
        alive += burst.count;
        out.bursts.push_back(burst);
    }
    if (out.rate <= 0 && out.bursts.empty())
        emission.error("", "found neither a rate above 0 nor bursts: nothing would ever be born");
    return alive;
}

void readForces(const PresetValue& forces, sim::EmitterForces& out)
{
    forces.read("gravity", out.gravity);
    forces.read("drag", out.drag);
    forces.read("buoyancy", out.buoyancy);
    forces.read("wind", out.wind);
    forces.read("curlStrength", out.curlStrength);
    forces.read("curlScale", out.curlScale);
    forces.read("curlRate", out.curlRate);
    forces.read("bounce", out.bounce);
    forces.read("friction", out.friction);
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
}

void readCurves(const PresetValue& element, sim::EmitterDef& emitter)
{
    element.read("sizeOverLife", emitter.sizeOverLife);
    element.read("opacityOverLife", emitter.opacityOverLife);
    element.read("temperatureOverLife", emitter.temperatureOverLife);
    element.read("albedoOverLife", emitter.albedoOverLife);
    element.read("emissionOverLife", emitter.emissionOverLife);
}

} // namespace

void buildEmitter(const PresetValue& element, sim::EffectDef& effect)
{
    auto emitter = std::make_unique<sim::EmitterDef>();
    element.read("name", emitter->name);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayers),
                 emitter->layer);
    element.read("maxParticles", emitter->maxParticles);
    element.read("lifetime", emitter->lifetime);
    element.read("speed", emitter->speed);
    element.read("radius", emitter->radius);
    readShape(element, *emitter);
    readMedium(element, *emitter);
    readForces(element.child("forces"), emitter->forces);
    readCurves(element, *emitter);
    const double alive = readEmission(element.child("emission"), emitter->lifetime.max, emitter->emission);
    if (alive > double(emitter->maxParticles))
        element.warning("maxParticles", "up to " + std::to_string(uint64_t(alive)) +
                                            " particles can be alive, but " +
                                            std::to_string(emitter->maxParticles) +
                                            " is the capacity: births beyond it are dropped");
    effect.solvers.push_back(std::move(emitter));
}

} // namespace fx::preset
