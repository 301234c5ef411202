/// @file parcel_optics.h
/// Emission, absorption and scattering of a parcel of burning or burnt gas.
///
/// @formula parcel-optics
/// Extinction cross section and albedo of a parcel, from its soot and salt.
///
/// symbol   unit    meaning
///   m       kg      own mass of the parcel
///   Y_g, Y_b  1     burning and burnt fraction
///   T       K       temperature, the mean over flames and gas that the flames have not reached
///   F       1       share of the burning gas in which soot has formed
///   f, y, z 1       soot in the flame, soot and salt in the smoke, per own mass
///   K_s, a_s  m2/kg, 1  extinction per mass and albedo of soot; K_z, a_z of salt
///   S       m2      extinction cross section
///   w       1       albedo
/// @derivation
///   Soot forms in flames. Cold gas that was just ignited at one place has no soot yet. Gas that has burnt
///   has soot in proportion, at any temperature:
///       F = max(u^2 (3 - 2 u), Y_b / (Y_g + Y_b)), u = (T - 900 K) / 400 K clamped to 0..1    (0)
///   soot m_s = m (f F Y_g + y Y_b), salt m_z = m z Y_b                                (1)
///   S = K_s m_s + K_z m_z                                                             (2)
///   w = (a_s K_s m_s + a_z K_z m_z) / S                                               (3)
///   absorbing matter emits as a black body of the parcel's temperature (Kirchhoff): (1 - w) B(T)
/// @source    [MC00] for K_s, [BB06] for a_s, [GLA89]: soot forms above 1300 to 1650 K in flames, hence (0)
/// for means
/// @deviation gray in the visible; a_z and K_z are orders of magnitude
/// @valid     fractions in 0..1
/// @accuracy  double rounding
/// @tests     tests/simulation/combustion/test_parcel_optics.cpp
#pragma once

#include "simulation/combustion/fire_parcel.h"

namespace fx::sim {

struct ParcelOptics
{
    double extinction = 0; ///< [m2] extinction cross section S of the whole parcel
    double absorption = 0; ///< [m2] absorption cross section (1 - w) S
    double albedo = 0;     ///< [1] single scattering albedo w; 0 for a parcel without particles
};

ParcelOptics opticsOf(const Material& material, const FireParcel& parcel);

/// [1] Emissivity of the parcel as a ball of `radius` [m] > 0, by equation (8) of formula parcel-radiation.
double emissivityOf(const Material& material, const FireParcel& parcel, double radius);

} // namespace fx::sim
