/// @file blob_optics.h
/// Amount of medium with which a blob has a given opacity.
///
/// @formula blob-cross-section
/// The extinction cross section that gives a blob a required optical depth along its diameter.
///
/// symbol   unit   meaning
///   tau     1      optical depth through the center
///   R       m      radius of the blob
///   sigma   m2     extinction cross section: the integral of extinction over space
/// @derivation
///   The optical depth along a diameter of the quartic kernel is tau = 3.5 sigma / (pi R^2)
///   (formula kernel-optical-depth, h = 0)                                                   (1)
///   so sigma = tau pi R^2 / 3.5                                                             (2)
///   sigma is the amount of medium: it is constant while the blob grows, and tau falls as 1 / R^2.
/// @source    [UBT96] eq. (1) for the kernel
/// @deviation none
/// @valid     tau >= 0, R >= 0
/// @accuracy  float rounding
/// @tests     tests/simulation/test_emitter_solver.cpp
#pragma once

namespace fx::sim {

inline float crossSectionOf(float opticalDepth, float radius)
{
    return opticalDepth * radius * radius * (3.14159265f / 3.5f); // (2)
}

} // namespace fx::sim
