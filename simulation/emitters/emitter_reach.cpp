// How far from the origin an emitter's particles can get.
#include "simulation/emitters/emitter_def.h"
#include "simulation/motion/flight_bound.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fx::sim {

namespace {

constexpr float kGust = 5.0f; ///< the noise's highest speed over its root mean square
constexpr float kUnknown = std::numeric_limits<float>::infinity();

float largestOf(const base::ScalarCurve& curve)
{
    float most = 0;
    for (size_t i = 0; i <= base::kCurveSamples; ++i) // linear between samples
        most = std::max(most, curve.at(float(i) / float(base::kCurveSamples))[0]);
    return most;
}

/// What moves a particle; events may give it a speed of their own besides.
FlightBound boundOf(const EmitterDef& def, float gravity, float wind, float seconds, float inherited)
{
    const EmitterForces& forces = def.forces;
    FlightBound bound;
    bound.seconds = double(std::min(def.lifetime.max, seconds));
    bound.speed = double(std::max(std::abs(def.speed.min), std::abs(def.speed.max)) + inherited);
    bound.air = double(wind + glm::length(forces.wind));
    float octaves = 0; // each has half the strength of the one before it
    for (uint32_t i = 0; i < std::max(forces.curlOctaves, 1u); ++i)
        octaves = 0.5f * octaves + 1.0f;
    bound.air += double(kGust * std::abs(forces.curlStrength) * octaves);
    bound.acceleration = double(gravity) * double(std::abs(forces.gravity));
    if (forces.buoyancy != 0.0f) {
        const float hottest = std::max(def.temperature.max, kAirTemperature);
        bound.acceleration +=
            double(gravity) * double(std::abs(forces.buoyancy)) * double(hottest / kAirTemperature);
    }
    bound.drag = double(std::max(forces.drag, 0.0f));
    for (const std::shared_ptr<const TileOp>& op : def.modules) {
        const TilePush push = op->mostPush();
        bound.air += double(push.air);
        bound.acceleration += double(push.acceleration);
    }
    return bound;
}

/// [m] How far what is drawn of a particle reaches from its place.
float drawnRadius(const EmitterDef& def, float topSpeed)
{
    const EmitterLook& look = def.look;
    float radius = def.radius.max * largestOf(def.sizeOverLife);
    if (look.kind == Appearance::Medium)
        return radius + def.shutter * topSpeed;
    if (look.fastest > 0.0f)
        radius *= largestOf(look.sizeOverSpeed);
    const float corner =
        look.kind == Appearance::Mesh ? look.meshReach : std::sqrt(1.0f + look.aspect * look.aspect);
    return radius * corner + look.stretch * topSpeed;
}

} // namespace

Flight EmitterDef::flight(float gravity, float wind, float seconds, const Flight& cause) const
{
    const FlightBound bound = boundOf(*this, gravity, wind, seconds, fed ? cause.speed : 0.0f);
    const double way = flightBound(bound);
    if (!std::isfinite(way) || (fed && !std::isfinite(cause.reach)))
        return {kUnknown, kUnknown, !events.empty()};
    const double topSpeed = bound.speed + bound.air + bound.acceleration * bound.seconds;
    const float begin = births ? births->extent() : glm::length(position) + glm::length(size);
    const float ribbon = trail.lifetime > 0.0f ? 0.5f * trail.width * largestOf(trail.widthAlong) : 0.0f;
    Flight flight;
    flight.reach = begin + float(way) + std::max(drawnRadius(*this, float(topSpeed)), ribbon) +
                   (fed ? cause.reach : 0.0f);
    flight.causes = !events.empty();
    for (const EventRule& rule : events)
        flight.speed = std::max(flight.speed, rule.inheritVelocity * float(topSpeed));
    return flight;
}

} // namespace fx::sim
