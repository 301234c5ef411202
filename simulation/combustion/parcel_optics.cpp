#include "simulation/combustion/parcel_optics.h"

#include "foundation/math/elementary.h"

#include <algorithm>

namespace fx::sim {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr float kNoFlame = 900.0f, kAllFlames = 1300.0f; // [K]

/// (0)
double sooty(const FireParcel& parcel)
{
    const double alight = parcel.burning + parcel.burnt;
    const double hot = double(base::smoothStep(kNoFlame, kAllFlames, float(parcel.temperature)));
    return alight > 0.0 ? std::max(hot, parcel.burnt / alight) : 0.0;
}

} // namespace

ParcelOptics opticsOf(const Material& material, const FireParcel& parcel)
{
    const double soot = parcel.ownMass * (material.flameSoot * sooty(parcel) * parcel.burning +
                                          material.smokeSoot * parcel.burnt); // (1)
    const double salt = parcel.ownMass * material.smokeSalt * parcel.burnt;
    const double bySoot = kSootOptics.extinction * soot;
    const double bySalt = kSaltOptics.extinction * salt;
    ParcelOptics optics;
    optics.extinction = bySoot + bySalt; // (2)
    const double scattering = kSootOptics.albedo * bySoot + kSaltOptics.albedo * bySalt;
    optics.absorption = optics.extinction - scattering;
    optics.albedo = optics.extinction > 0.0 ? scattering / optics.extinction : 0.0; // (3)
    return optics;
}

double emissivityOf(const Material& material, const FireParcel& parcel, double radius)
{
    return 1.0 - base::naturalExp(-opticsOf(material, parcel).absorption / (kPi * radius * radius));
}

} // namespace fx::sim
