/// @file gpu_depth.h
/// The depth texture of a frame, for emitters that collide with it. Text of the shader:
/// shaders/gpu_particles/gpu_particle_depth.glsl.
///
/// @formula depth-contact
/// First place and time at which a particle's way meets what a depth texture shows.
///
/// symbol   unit   meaning
///   x, y, z  m      place in the camera's axes, z along the view
///   u, v     pixel  place in the window
///   k, c     pixel  window place per slope x/z (parallel: per metre x), window place of the view axis
///   q        1/m    1 / z of what is seen at u, v (parallel: z itself, in m)
///   g, h     q/pixel  change of q with u, v
///   N        1/m    (A, B, C), see below
///   d, b     m      distance from the surface, positive towards the camera; depth behind it along the ray
///   s        m      how deep a way begins inside of the surface, else 0
///   e        m      what a step of 2^-24 of the stored depth, or of floats after it, is along the axis
///   m, w     m      margin, thickness
/// @derivation
///   Of a plane, q is linear in the window: for A x + B y + C z = 1, q = A x/z + B y/z + C (parallel:
///   z = A x + B y + C). So next to the middle (u0, v0) of a texel that shows a plane
///       q(u, v) = q0 + g (u - u0) + h (v - v0)                                                (1)
///   exactly, with g and h the differences of q to neighbors. An edge lies at most on one side of a texel,
///   where the difference is the larger one: g is the smaller of the two one-sided differences, in
///   magnitude, and 0 where neither neighbor shows anything                                    (2)
///   From u = k x/z + c follows A = g k, B = h k', C = q0 + g (c - u0) + h (c' - v0), and
///       d = (1 - N.p) / |N| - m,  normal -N / |N|,  b = (N.p - 1) / (N.p / z)                 (3)
///   (parallel: d = (A x + B y + C - z) / |(A, B, -1)| - m, normal (A, B, -1) / |(A, B, -1)|,
///   b = z - (A x + B y + C)).
///   A way p0 + v t + a t^2 / 2 is looked at at equal times, once for two pixels that it crosses, at most
///   kMaxDepthSamples times. Between a place in front and one that is inside by more than the error, d < -2 e
///   and d < -s - e / 4, the time at which d = -s is found by intersecting the way with the plane of the
///   later place and halving by turns, until a place lies on its own plane within e; it is met there. When
///   none does, the surface breaks off between the two: the way meets it where b <= w, and passes behind it
///   otherwise                                                                             (4)
///   A way that begins inside, b <= w, may go as deep as it began. Nothing is met by ways that lead out,
///   outside of the window, behind the camera, where nothing is seen, and behind b > w         (5)
///   What a contact finds sunk in by no more than 3 e comes back by at most e                  (6)
/// @source    elementary; collision with the depth buffer as such is common practice
/// @deviation none
/// @valid     finite numbers; perspective and parallel cameras with any depth convention of the view
/// @accuracy  on a plane that fills its texels and their neighbors, (1)-(3) are exact but for rounding of
///            the depth texture: contacts are moved by at most 3 e along the ray, and normals turned by at
///            most 2 e / f, f the width of a pixel there; across an edge that no texel resolves, and for what
///            is narrower than two pixels or 1 / kMaxDepthSamples of a way, nothing is promised
/// @tests     tests/gpu_particles/test_gpu_depth.cpp, tests/gpu_particles/test_gpu_depth_limits.cpp
#pragma once

#include "foundation/math/geometry.h"
#include "foundation/snapshot/gpu_particles.h"
#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"

#include <glm/vec4.hpp>

namespace fx::render {

/// The depth texture of a frame.
struct GpuDepth
{
    ResourceId distance;                ///< as SceneDistancePass writes it; invalid: nothing is known
    const CameraView* camera = nullptr; ///< that has seen it
    int width = 0, height = 0;          ///< [pixel]
};

/// Layout of the last members of the uniform block in shaders/gpu_particles/gpu_particles.comp.glsl.
struct GpuDepthBlock
{
    glm::vec4 right, up, forward; ///< local place and 1 to the camera's axes [m]
    glm::vec4 window;             ///< k, k', c, c'
    glm::vec4 error;              ///< of 24 bits: e = x + y z + z z^2
    glm::vec4 size;               ///< [pixel] of the texture; 1: parallel; [m] per local length
};

/// @param place of the emitter, in the world
GpuDepthBlock makeGpuDepthBlock(const GpuDepth& depth, const base::Placement& place);

/// True for emitters that collide with the depth texture.
bool meetsDepth(const base::GpuParticleFeatures& features);

} // namespace fx::render
