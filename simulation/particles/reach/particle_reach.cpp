#include "simulation/particles/reach/particle_reach.h"

#include "simulation/motion/flight_bound.h"

#include <glm/common.hpp>
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

/// True when a module takes particles to the speed of the air by more than linear drag.
bool followsAir(const EmitterSettings& def)
{
    return std::any_of(def.modules.begin(), def.modules.end(),
                       [](const auto& module) { return module->bound().followsAir; });
}

/// What moves a particle of `def`, at most.
FlightBound flightOf(const EmitterSettings& def, const ReachConditions& conditions, const BirthReach& births)
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
    if (forces.updraft > 0.0f) // how fast gases rise is unknown
        bound.acceleration = std::numeric_limits<double>::infinity();
    bound.drag = double(std::max(forces.drag, 0.0f));
    for (const auto& module : def.modules) {
        const TileBound more = module->bound();
        bound.acceleration += double(more.acceleration);
        bound.air += double(more.air);
    }
    if (followsAir(def)) // drag that only slows what is faster than the air
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
float drawnOf(const EmitterSettings& def, float fastest)
{
    const EmitterAppearance& appearance = def.appearance;
    float drawn = peakOf(def.sizeOverLife) * def.radius.max;
    if (appearance.kind == AppearanceKind::Medium)
        drawn += share(def.shutter, fastest);
    if (appearance.fastest > 0.0f)
        drawn *= std::max(peakOf(appearance.sizeOverSpeed), 1e-4f);
    if (appearance.kind == AppearanceKind::Mesh)
        drawn *= appearance.meshReach;
    if (appearance.kind == AppearanceKind::Sprite)
        drawn = std::sqrt(1.0f + appearance.aspect * appearance.aspect) * drawn +
                (appearance.alignment == base::SpriteAlignment::Velocity
                     ? share(0.5f * appearance.stretch, fastest)
                     : 0.0f);
    if (appearance.kind == AppearanceKind::None)
        drawn = 0.0f;
    if (def.trail.lifetime > 0.0f)
        drawn = std::max(drawn, 0.5f * def.trail.width * peakOf(def.trail.widthAlong));
    return drawn;
}

} // namespace

float reachOf(const EmitterSettings& def, const ReachConditions& conditions, const BirthReach& given,
              std::span<BirthReach> ioOthers)
{
    const BirthReach start = def.fed ? given : BirthReach{};
    const float shapes =
        def.births ? def.births->extent() : glm::length(def.position) + glm::length(def.size);
    const FlightBound bound = flightOf(def, conditions, start);
    const float fastest = fastestOf(bound);
    // A trail lies where its particle has been.
    const float way = start.distance + shapes + float(flightBound(bound));
    for (const EventRule& rule : def.events)
        if (rule.target < ioOthers.size())
            ioOthers[rule.target].add({way, share(rule.inheritVelocity, fastest)});
    return way + drawnOf(def, fastest);
}

namespace {

/// Everything is in a ball around the origin.
base::Bounds ballOf(const EmitterSettings& def, const FlightBound& bound, const ReachConditions& conditions,
                    float secondsBack)
{
    float reach = reachOf(def, conditions, {}, {});
    if (def.appearance.alignment == base::SpriteAlignment::Velocity || def.appearance.stretch > 0.0f) {
        // Particles born since the snapshot before are drawn on the tangent of their path.
        const float back = std::min(float(bound.seconds), secondsBack), fastest = fastestOf(bound);
        const float grown = float(bound.acceleration + bound.drag * (double(fastest) + bound.air));
        const float change = followsAir(def) ? 2.0f * fastest : 0.5f * grown * back;
        reach += std::min(change, 2.0f * fastest) * back;
    }
    base::Bounds box;
    box.add(glm::vec3(0.0f), reach);
    return box;
}

} // namespace

/// Where at most the ground is met, each component of a velocity obeys the same inequality as that of a
/// ballistic particle whose pull is the largest that there may be: what the ground takes away makes it
/// smaller. Upwards that is so when all pulls are downwards and equal, as a bounce then rises to no more than
/// it fell from.
base::Bounds boundsOfStepped(const EmitterSettings& def, const ConditionsRange& conditions)
{
    const FlightBound bound = flightOf(def, conditions.strongest, {});
    const base::Bounds ball = ballOf(def, bound, conditions.strongest, conditions.secondsBack);
    if (conditions.meetsOthers || followsAir(def) || !std::isfinite(ball.max.x))
        return ball;
    const double steady = double(conditions.strongest.gravity) * double(std::abs(def.forces.gravity));
    const double air = bound.air - double(conditions.strongest.wind) - double(glm::length(def.forces.wind));
    const auto any = float((bound.acceleration - steady + bound.drag * air) * (1.0 + 1e-6)); // anywhere to
    const glm::vec3 low = conditions.low - any, high = conditions.high + any;
    base::Bounds box = boundsOfAll(def, low, high, float(bound.seconds), conditions.secondsBack);
    if (conditions.meetsGround && conditions.highGround > -1e30f) {
        const bool isSteady = high.y < 0.0f && low.y >= 1.0001f * high.y;
        const float drawn = drawnOf(def, fastestOf(bound));
        box.max.y = isSteady ? std::max(box.max.y, conditions.highGround + drawn) : ball.max.y;
        const float shapes = def.births ? def.births->extent() : glm::length(def.size);
        const float lowest = std::min(conditions.lowGround, def.position.y - shapes) - drawn;
        if (!(def.appearance.stretch > 0.0f) && def.appearance.alignment != base::SpriteAlignment::Velocity)
            box.min.y = std::max(box.min.y, lowest);
    }
    box.min = glm::max(box.min, ball.min);
    box.max = glm::min(box.max, ball.max);
    return box;
}

} // namespace fx::sim
