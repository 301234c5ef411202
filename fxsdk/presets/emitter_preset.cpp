#include "fxsdk/presets/emitter_preset.h"

#include "fxsdk/presets/emitter_parts_preset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fx::preset {

namespace {

constexpr std::array<std::pair<std::string_view, base::MediaLayer>, 3> kLayers{{
    {"fire", base::MediaLayer::Fire},
    {"smoke", base::MediaLayer::Smoke},
    {"dust", base::MediaLayer::Dust},
}};

constexpr std::array<std::pair<std::string_view, sim::ComputeOn>, 3> kComputers{{
    {"cpu", sim::ComputeOn::Cpu},
    {"gpu", sim::ComputeOn::Gpu},
    {"auto", sim::ComputeOn::Auto},
}};

/// Reads one burst. @return births of it that can be alive at once
double readBurst(const PresetValue& element, float longestLife, sim::Burst& out)
{
    element.read("time", out.time);
    element.read("count", out.count);
    element.read("cycles", out.cycles);
    element.read("interval", out.interval);
    element.read("probability", out.probability);
    if (out.cycles == 1)
        return out.count;
    if (out.interval <= 0.0f) {
        element.error("interval", "found no interval; a burst of several cycles needs one");
        return out.count;
    }
    const double within = std::floor(double(longestLife) / double(out.interval)) + 1.0;
    return double(out.count) * (out.cycles == 0 ? within : std::min(within, double(out.cycles)));
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

/// The largest value of a curve.
float peakOf(const base::ScalarCurve& curve)
{
    float peak = 0.0f;
    for (size_t i = 0; i <= base::kCurveSamples; ++i)
        peak = std::max(peak, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return peak;
}

} // namespace

double readEmitterEmission(const PresetValue& emission, float longestLife, sim::Emission& out)
{
    out.duration = std::numeric_limits<float>::infinity();
    emission.read("rate", out.rate);
    emission.read("start", out.start);
    emission.read("duration", out.duration);
    emission.read("rateOverTime", out.rateOverTime);
    if (emission.child("rateOverTime").has("keys") && !emission.has("duration"))
        emission.error("rateOverTime",
                       "found a rate that changes over a duration that is not given; add a duration");
    double alive =
        double(out.rate) * double(peakOf(out.rateOverTime)) * double(std::min(longestLife, out.duration));
    for (size_t i = 0; i < emission.size("bursts"); ++i) {
        out.bursts.emplace_back();
        alive += readBurst(emission.element("bursts", i), longestLife, out.bursts.back());
    }
    return alive;
}

void buildEmitter(const PresetValue& element, sim::EffectDef& effect)
{
    auto emitter = std::make_unique<sim::EmitterDef>();
    element.read("name", emitter->name);
    element.read("layer", std::span<const std::pair<std::string_view, base::MediaLayer>>(kLayers),
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
    readEmitterLook(element.child("appearance"), emitter->look);
    readEmitterTrail(element.child("trail"), emitter->trail);
    readEmitterLight(element, emitter->light);
    const double alive =
        readEmitterEmission(element.child("emission"), emitter->lifetime.max, emitter->emission);
    if (alive > double(emitter->maxParticles))
        element.warning("maxParticles", "up to " + std::to_string(uint64_t(alive)) +
                                            " particles can be alive, but " +
                                            std::to_string(emitter->maxParticles) +
                                            " is the capacity: births beyond it are dropped");
    effect.solvers.push_back(std::move(emitter));
}

} // namespace fx::preset
