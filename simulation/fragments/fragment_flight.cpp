#include "simulation/fragments/fragment_flight.h"

#include "simulation/motion/ambient_air.h"
#include "simulation/motion/drag_step.h"

#include <algorithm>
#include <cmath>

namespace fx::sim {

namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8; // [W/(m2 K4)]
// Air at 700 K, between the fragment and its surroundings: textbook values.
constexpr double kFilmConductivity = 0.0524; // [W/(m K)]
constexpr double kFilmViscosity = 6.67e-5;   // [m2/s]
constexpr double kFilmPrandtlRoot = 0.8837;  // [1] Pr^(1/3), Pr = 0.69
constexpr double kAir = double(kAirTemperature);

float lengthOf(const glm::vec3& v)
{
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

MotionState linearStep(const MotionState& from, const glm::vec3& acceleration, const glm::vec3& air,
                       float rate, float seconds)
{
    const DragStep drag = makeDragStep(double(rate), double(seconds));
    return {from.position + drag.gain * from.velocity + drag.drift * air + drag.ramp * acceleration,
            drag.decay * from.velocity + drag.share * air + drag.gain * acceleration};
}

double radiate(double temperature, double rate, double seconds)
{
    const double growth = 1.0 + 3.0 * rate * seconds * temperature * temperature * temperature;
    return std::max(temperature / base::cubeRoot(growth), kAir); // (6)
}

} // namespace

float dragPerMeter(const FragmentMatter& matter, float size)
{
    return 0.75f * matter.dragCoefficient * kAirDensity / (matter.density * size); // (1)
}

MotionState flyStep(const MotionState& from, const glm::vec3& acceleration, const glm::vec3& air,
                    float perMeter, float seconds)
{
    const float before = lengthOf(from.velocity - air);
    const MotionState guess = linearStep(from, acceleration, air, perMeter * before, seconds); // (2)
    const float after = lengthOf(guess.velocity - air);
    return linearStep(from, acceleration, air, perMeter * 0.5f * (before + after), seconds); // (3)
}

CoolingRates coolingRates(const FragmentMatter& matter, float size, float speed)
{
    const double d = double(size);
    const double capacity = double(matter.density) * double(matter.specificHeat) * d;
    const double reynolds = double(speed) * d / kFilmViscosity;
    const double nusselt = 2.0 + 0.6 * std::sqrt(reynolds) * kFilmPrandtlRoot;
    return {6.0 * nusselt * kFilmConductivity / (capacity * d),
            6.0 * double(matter.emissivity) * kStefanBoltzmann / capacity}; // (4)
}

float coolStep(float temperature, const CoolingRates& rates, float seconds)
{
    if (!(temperature > kAirTemperature))
        return temperature;
    const double t = double(seconds);
    double T = radiate(double(temperature), rates.radiation, 0.5 * t); // (7)
    T = kAir + (T - kAir) * base::naturalExp(-rates.convection * t);   // (5)
    return float(radiate(T, rates.radiation, 0.5 * t));
}

} // namespace fx::sim
