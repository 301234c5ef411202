// How far from the origin an emitter's particles can get.
#include "simulation/emitters/emitter_def.h"
#include "simulation/motion/flight_bound.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {
constexpr float kGust = 5.0f; ///< the noise's highest speed over its root mean square
}

float EmitterDef::reach(float gravity, float wind, float seconds) const
{
    float largest = 0;
    for (size_t i = 0; i <= base::kCurveSamples; ++i) // linear between samples
        largest = std::max(largest, sizeOverLife.at(float(i) / float(base::kCurveSamples))[0]);
    FlightBound bound;
    bound.seconds = double(std::min(lifetime.max, seconds));
    bound.speed = double(std::max(std::abs(speed.min), std::abs(speed.max)));
    bound.air = double(wind + glm::length(forces.wind) + kGust * forces.curlStrength);
    bound.acceleration = double(gravity) * double(std::abs(forces.gravity));
    if (forces.buoyancy != 0.0f) {
        const float hottest = std::max(temperature.max, kAirTemperature);
        bound.acceleration +=
            double(gravity) * double(std::abs(forces.buoyancy)) * double(hottest / kAirTemperature);
    }
    bound.drag = double(std::max(forces.drag, 0.0f));
    const float start = glm::length(position) + glm::length(size);
    return start + float(flightBound(bound)) + largest * radius.max;
}

} // namespace fx::sim
