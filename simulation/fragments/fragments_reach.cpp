// How far from the origin fragments and their smoke can get.
#include "simulation/fragments/fragments_def.h"
#include "simulation/motion/ambient_air.h"
#include "simulation/motion/flight_bound.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {
constexpr float kGust = 5.0f; ///< the noise's highest speed over its root mean square
}

float FragmentsDef::reach(float gravity, float wind, float seconds) const
{
    FlightBound flight; // quadratic drag only slows down what is faster than the air
    flight.seconds = double(std::min(lifetime.max, seconds));
    flight.speed = double(std::max(speed.max, wind));
    flight.acceleration = double(gravity) * double(std::abs(matter.gravity));
    FlightBound smoke;
    smoke.seconds = double(std::min(trail.lifetime.max, seconds));
    smoke.speed = double(trail.inherited) * (flight.speed + flight.acceleration * flight.seconds);
    smoke.air = double(wind + kGust * trail.curlStrength);
    smoke.acceleration = double(gravity) * double(trail.buoyancy) *
                         double(std::max(trail.temperature, kAirTemperature)) / kAirKelvin;
    smoke.drag = double(trail.drag);
    const float puff =
        std::sqrt(trail.radius.max * trail.radius.max + trail.spreading * std::max(trail.lifetime.max, 0.0f));
    const float body = 0.5f * size.max * visibleSize + speed.max * shutter;
    return glm::length(position) + originRadius + float(flightBound(flight)) +
           (trail.spacing > 0.0f ? float(flightBound(smoke)) + 2.0f * puff : 0.0f) + body;
}

} // namespace fx::sim
