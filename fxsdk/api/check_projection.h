/// @file check_projection.h
/// Tests of projection matrices of the host, column-major float[16].
#pragma once

#include <cstdint>

namespace fx::api {

/// Reason why the matrix is not a camera's projection from eye to clip space, with the remedy; null if it is
/// one. Faults: not finite, row-major, for a camera that looks along +Z, without extent, scaled, singular.
/// Off-center, jittered, mirrored and oblique projections are accepted.
const char* projectionFault(const float* projection);

/// Reason why a frame cannot be drawn with a matrix that projectionFault() accepts; null if it can be drawn.
/// Distances and rays of a frame are computed from single elements, so the matrix must not contain a part of
/// the view matrix.
/// @param isReversed near maps to the larger depth
const char* frameProjectionFault(const float* projection, bool isReversed);

} // namespace fx::api
