/// @file black_body.h
/// Color and luminance of incandescent matter.
#pragma once

#include <glm/vec3.hpp>

namespace fx::render {

constexpr glm::dvec3 kLuminance{0.2126, 0.7152, 0.0722}; ///< weights of linear Rec. 709

/// @formula black-body-luminance
/// Luminance of an ideal black body as a linear Rec. 709 triple.
///
/// symbol    unit          meaning
///   T       K             temperature
///   L       W/(m2 sr m)   spectral radiance
///   XYZ     cd/m2         tristimulus values, Y is luminance
/// @derivation
///   L(lambda, T) = 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1)                          (1)
///   XYZ = 683 lm/W * integral of L times the CIE 1931 color matching functions                (2)
///   rgb = M XYZ with the Rec. 709 matrix (D65); negative values (out of gamut) are set to 0   (3)
/// @source    [Pla01] for (1); [WSS13] multi-lobe fit for (2)
/// @deviation the integral runs over 380..780 nm in steps of 5 nm, once per table entry
/// @valid     T <= 400 K gives 0; T is limited to 10000 K; NaN gives 0
/// @accuracy  table of 256 temperatures equally spaced in 1/T, log-linear between: within 0.1 % of (1)-(3)
/// @tests     tests/rendering/core/test_optics.cpp
///
/// @return    [cd/m2] each >= 0; the luminance is 0.2126 r + 0.7152 g + 0.0722 b
glm::vec3 blackBodyLuminance(float temperature);

/// Computes the luminance of blackBodyLuminance() by integration, without a table. Tests and the
/// construction of the table use this function.
glm::dvec3 integrateBlackBody(double temperature);

} // namespace fx::render
