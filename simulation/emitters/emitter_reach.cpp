// How far from the origin an emitter's particles can get.
#include "simulation/emitters/emitter_def.h"
#include "simulation/motion/flight_bound.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

constexpr float kGust = 5.0f;    ///< the noise's highest speed over its root mean square
constexpr float kOctaves = 2.0f; ///< strengths of all octaves over that of the first: 1 + 1/2 + 1/4 + ...

float peakOf(const base::ScalarCurve& curve)
{
    float largest = 0;
    for (size_t i = 0; i <= base::kCurveSamples; ++i) // linear between samples
        largest = std::max(largest, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return largest;
}

/// What moves a particle of `def`, at most.
FlightBound flightOf(const EmitterDef& def, const ReachConditions& conditions, const BirthReach& births)
{
    const EmitterForces& forces = def.forces;
    FlightBound bound;
    bound.seconds = double(std::min(def.lifetime.max, conditions.seconds));
    bound.speed = double(std::max(std::abs(def.speed.min), std::abs(def.speed.max)) + births.speed);
    bound.air = double(conditions.wind + glm::length(forces.wind) +
                       kGust * forces.curlStrength * (forces.curlOctaves > 1 ? kOctaves : 1.0f));
    bound.acceleration = double(conditions.gravity) * double(std::abs(forces.gravity));
    if (forces.buoyancy != 0.0f) {
        const float hottest = std::max(def.temperature.max, kAirTemperature);
        bound.acceleration += double(conditions.gravity) * double(std::abs(forces.buoyancy)) *
                              double(hottest / kAirTemperature);
    }
    bound.drag = double(std::max(forces.drag, 0.0f));
    bool followsAir = false;
    for (const auto& module : def.modules) {
        const TileBound more = module->bound();
        bound.acceleration += double(more.acceleration);
        bound.air += double(more.air);
        followsAir = followsAir || more.followsAir;
    }
    if (followsAir) // drag that only slows what is faster than the air
        bound.speed = std::max(bound.speed, bound.air);
    return bound;
}

/// [m/s] that nothing in flight exceeds; the derivation is that of flight-bound.
float fastestOf(const FlightBound& bound)
{
    double fastest = bound.speed + (bound.acceleration + bound.drag * bound.air) * bound.seconds;
    if (bound.drag > 0)
        fastest = std::min(fastest, std::max(bound.speed, bound.air + bound.acceleration / bound.drag));
    return float(fastest);
}

/// 0 of anything is nothing, however much it is.
float share(float factor, float of)
{
    return factor > 0.0f ? factor * of : 0.0f;
}

/// [m] from a particle's place to the farthest of what is drawn of it.
float drawnOf(const EmitterDef& def, float fastest)
{
    const EmitterLook& look = def.look;
    float drawn = peakOf(def.sizeOverLife) * def.radius.max;
    if (look.kind == Appearance::Medium)
        drawn += share(def.shutter, fastest);
    if (look.fastest > 0.0f)
        drawn *= std::max(peakOf(look.sizeOverSpeed), 1e-4f);
    if (look.kind == Appearance::Mesh)
        drawn *= look.meshReach;
    if (look.kind == Appearance::Sprite)
        drawn =
            std::sqrt(1.0f + look.aspect * look.aspect) * drawn +
            (look.alignment == base::SpriteAlignment::Velocity ? share(0.5f * look.stretch, fastest) : 0.0f);
    if (look.kind == Appearance::None)
        drawn = 0.0f;
    if (def.trail.lifetime > 0.0f)
        drawn = std::max(drawn, 0.5f * def.trail.width * peakOf(def.trail.widthAlong));
    return drawn;
}

} // namespace

float EmitterDef::reachFrom(const ReachConditions& conditions, const BirthReach& given,
                            std::span<BirthReach> ioOthers) const
{
    const BirthReach start = fed ? given : BirthReach{};
    const float shapes = births ? births->extent() : glm::length(position) + glm::length(size);
    const FlightBound bound = flightOf(*this, conditions, start);
    const float fastest = fastestOf(bound);
    // A trail lies where its particle has been.
    const float way = start.distance + shapes + float(flightBound(bound));
    for (const EventRule& rule : events)
        if (rule.target < ioOthers.size())
            ioOthers[rule.target].add({way, share(rule.inheritVelocity, fastest)});
    if (inWorld) // the host may have gone anywhere meanwhile
        return std::numeric_limits<float>::infinity();
    return way + drawnOf(*this, fastest);
}

} // namespace fx::sim
