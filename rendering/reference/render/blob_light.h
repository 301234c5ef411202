/// @file blob_light.h
/// Computes the light that blobs scatter, from the illumination at their centers.
#pragma once

#include "rendering/reference/render/medium_view.h"
#include "rendering/reference/render/scene_lights.h"

#include <vector>

namespace fx::render {

/// @formula center-scattering
/// Light that a blob scatters towards the eye, assumed to be constant in the blob.
///
/// symbol    unit    meaning
///   a, p    1, 1/sr albedo and phase function of the blob
///   E_l     lx      illuminance of sun, lamp or glowing group l without attenuation
///   T_l     1       transmittance towards it
///   L_j     cd/m2   luminance of sky or ground in direction j; T_j transmittance in this direction
///   w_j     1       weight of direction j, sum 1
///   S       cd/m2   scattered light per optical depth
/// @derivation
///   S = a sum over l of p E_l T_l + a sum over j of w_j L_j T_j                                 (1)
///   j: along the axes, w = 1/15, and to the corners of a cube, w = 3/40: exact for L_j T_j of degree 5  (2)
///   if a triangle blocks direction j, L_j is the luminance of the ground, and T_j ends at the triangle  (3)
/// @source    [LL99] on quadrature over the sphere, 14 points, for (2)
/// @deviation light of the sky is scattered isotropically, independent of p
/// @valid     single scattering only
/// @accuracy  transmittances are exact; changes of light within a blob are not resolved
/// @tests     tests/rendering/reference/render/test_blob_light.cpp
///
/// @return S of each blob, in the order of the tree of `medium`; empty without lights
std::vector<glm::vec3> lightAtCenters(const MediumView& medium, const OpaqueView& opaque,
                                      const SceneLights& lights, base::TaskRunner& tasks);

} // namespace fx::render
