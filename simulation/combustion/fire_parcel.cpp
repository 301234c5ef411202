#include "simulation/combustion/fire_parcel.h"

#include "foundation/math/elementary.h"
#include "simulation/combustion/parcel_optics.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8; // [W/(m2 K4)]
constexpr double kPi = 3.14159265358979323846;
constexpr double kEntrainment = 0.25;      // [1] alpha of a thermal
constexpr double kIgnitionWindow = 1.2;    // [1] temperature of full ignition over that of the first
constexpr double kLongest = 1e9;           // [s]
constexpr double kLargestExponent = 300.0; // keeps M and all products finite

/// (1 - exp(-x)) / x for x >= 0.
double meanDecay(double x)
{
    if (x < 1e-2) // the next term of the series is below 1e-15
        return 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x / 720.0))));
    return (1.0 - base::naturalExp(-x)) / x;
}

struct Fractions
{
    double unburnt;
    double burning;
    double burnt;
};

/// (1)-(6)
Fractions burnFractions(const Material& material, const FireParcel& parcel, double ignition, double mixing,
                        double seconds)
{
    const double burn = 1.0 / material.burnTime;
    const double unburnt = parcel.unburnt * base::naturalExp(-ignition * seconds); // (1)
    const double slower = std::min(ignition, burn);
    const double apart = std::max(ignition, burn) - slower;
    const double lit = ignition * parcel.unburnt * seconds * base::naturalExp(-slower * seconds) *
                       meanDecay(apart * seconds);                                   // (3)
    const double burning = parcel.burning * base::naturalExp(-burn * seconds) + lit; // (2)
    const double wanted = 1.0 - (unburnt + burning);
    const double air = material.airNeeded > 0.0 ? (mixing - 1.0) / material.airNeeded : 1.0;
    const double allowed = std::min(material.ownOxygen + air, 1.0); // (5)
    const double burnt = std::min(std::max(std::min(wanted, allowed), parcel.burnt), 1.0 - unburnt);
    // The burnt share is what is left, so that the three add up to one exactly.
    const double alight = std::max(1.0 - (unburnt + burnt), 0.0); // (6)
    return {unburnt, alight, 1.0 - (unburnt + alight)};
}

/// (8)-(10)
void radiate(const Material& material, const FireSurroundings& around, double seconds, FireParcel& ioParcel,
             FireLedger& ioLedger)
{
    const double before = ioParcel.temperature;
    if (!(before > around.airTemperature) || !(around.radius > 0.0))
        return;
    const double capacity = ioParcel.ownMass * ioParcel.mixing * material.heatCapacity;
    const double surface = 4.0 * kPi * around.radius * around.radius;
    const double rate = surface * emissivityOf(material, ioParcel, around.radius) * around.exposure *
                        kStefanBoltzmann / capacity;
    const double growth = 1.0 + 3.0 * rate * seconds * before * before * before;
    const double cooled = growth < 1e290 ? before / base::cubeRoot(growth) : 0.0; // (9)
    ioParcel.temperature = std::clamp(cooled, around.airTemperature, before);     // (10)
    ioLedger.radiated += capacity * (before - ioParcel.temperature);
}

} // namespace

FireParcel startParcel(const Material& material, double mass)
{
    FireParcel parcel;
    parcel.ownMass = mass;
    parcel.burning = material.burningAtStart;
    parcel.unburnt = 1.0 - material.burningAtStart;
    parcel.burnt = 0.0;
    parcel.temperature = material.startTemperature;
    return parcel;
}

FireParcel burnParcel(const Material& material, const FireParcel& parcel, const FireSurroundings& around,
                      double seconds, FireLedger& ioLedger)
{
    if (!(seconds > 0.0))
        return parcel;
    const double t = std::min(seconds, kLongest);
    FireParcel next = parcel;
    const double ignition = ignitionRate(material, std::max(parcel.temperature, around.hottest));
    radiate(material, around, 0.5 * t, next, ioLedger);

    const double exponent = std::clamp(around.entrainment * t, 0.0, kLargestExponent);
    const double mixing = parcel.mixing * base::naturalExp(exponent); // (4)
    const Fractions fractions = burnFractions(material, parcel, ignition, mixing, t);
    const double released =
        parcel.ownMass * material.heatOfCombustion * std::max(fractions.burnt - parcel.burnt, 0.0);
    const double heat = heatOf(material, next, around.airTemperature) + released;
    next.unburnt = fractions.unburnt;
    next.burning = fractions.burning;
    next.burnt = fractions.burnt;
    next.mixing = std::min(mixing, kMaxMixing);
    next.temperature =
        around.airTemperature + heat / (parcel.ownMass * mixing * material.heatCapacity); // (7)
    ioLedger.released += released;
    ioLedger.givenToAir += heat - heat * (next.mixing / mixing);

    radiate(material, around, 0.5 * t, next, ioLedger);
    return next;
}

double heatOf(const Material& material, const FireParcel& parcel, double airTemperature)
{
    return parcel.ownMass * parcel.mixing * material.heatCapacity * (parcel.temperature - airTemperature);
}

double ignitionRate(const Material& material, double temperature)
{
    const float readiness =
        base::smoothStep(float(material.ignitionTemperature),
                         float(kIgnitionWindow * material.ignitionTemperature), float(temperature));
    return double(readiness) / material.ignitionDelay;
}

double entrainmentRate(double speed, double radius, double density)
{
    if (!(speed > 0.0) || !(radius > 0.0) || !(density > 0.0))
        return 0.0;
    return 3.0 * kEntrainment * speed / (radius * density);
}

} // namespace fx::sim
