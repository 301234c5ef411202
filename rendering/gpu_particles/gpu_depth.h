/// @file gpu_depth.h
/// Collision of particles with the depth texture of a frame. The shader code is in
/// shaders/gpu_particles/gpu_particle_depth.glsl.
///
/// @formula depth-contact
/// First point and time at which the path of a particle meets the surface in a depth texture.
///
/// symbol   unit   meaning
///   x, y, z  m      position in the axes of the camera, z along the view
///   u, v     pixel  position in the window
///   k, c     pixel  change of u per slope x/z (parallel: per meter x), u of the view axis; k', c' for v
///   q        1/m    1 / z of the surface at u, v (parallel: z itself, in m)
///   g, h     q/pixel  change of q with u, v
///   N        1/m    (A, B, C), see below
///   d, b     m      distance from the surface, positive towards the camera; depth behind it along the ray
///   s        m      depth inside of the surface at which a path begins, else 0
///   e        m      depth error along the axis: a step of 2^-24 of the stored depth, or a rounding
///   m, w     m      margin, thickness
/// @derivation
///   For a plane, q is linear in the window: for A x + B y + C z = 1, q = A x/z + B y/z + C (parallel:
///   z = A x + B y + C). So near the center (u0, v0) of a texel that shows a plane,
///       q(u, v) = q0 + g (u - u0) + h (v - v0)                                                (1)
///   is exact; g and h are differences of q between neighboring texels. If an object ends next to a texel,
///   the difference across its edge is the larger one. So g is the one-sided difference of smaller magnitude,
///   and 0 if both neighbors show no surface                                                   (2)
///   From u = k x/z + c follows A = g k, B = h k', C = q0 + g (c - u0) + h (c' - v0), and
///       d = (1 - N.p) / |N| - m,  normal -N / |N|,  b = (N.p - 1) / (N.p / z)                 (3)
///   (parallel: d = (A x + B y + C - z) / |(A, B, -1)| - m, normal (A, B, -1) / |(A, B, -1)|,
///   b = z - (A x + B y + C)).
///   A path p0 + v t + a t^2 / 2 is sampled at equal intervals of time, one sample for two crossed pixels, at
///   most kMaxDepthSamples. A sample is inside if d < -2 e and d < -s - e / 4. Between a sample in front and
///   the next inside, the time with d = -s is computed. Two methods alternate: intersection with the plane
///   at the later point, and bisection. They end at a point that is on its own plane within e: the contact.
///   If there is no such point, the surface ends between the two samples. The path then has a contact if
///   b <= w; otherwise it passes behind the surface                                            (4)
///   A path that begins inside, with b <= w, may go as deep as it began. There is no contact for paths that
///   leave the surface, outside of the window, behind the camera, without a surface, and for b > w  (5)
///   A particle that is inside by at most 3 e at a contact is moved back by at most e          (6)
/// @source    elementary; collision with the depth buffer is common practice
/// @deviation none
/// @valid     finite numbers; perspective and parallel cameras with any depth convention of the view
/// @accuracy  on a plane that fills its texels and their neighbors, the only error of (1)-(3) is the rounding
///            of the depth texture: contacts are moved by at most 3 e along the ray, and normals are rotated
///            by at most 2 e / f, where f is the width of a pixel at the contact. There is no bound at edges
///            within a texel, and for objects narrower than two pixels or 1 / kMaxDepthSamples of a path
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
    ResourceId distance;                ///< output of SceneDistancePass; invalid: there are no collisions
    const CameraView* camera = nullptr; ///< camera of the depth texture
    int width = 0, height = 0;          ///< [pixel]
};

/// Layout of the last members of the uniform block in shaders/gpu_particles/gpu_particles.comp.glsl.
struct GpuDepthBlock
{
    /// Affine maps of a local position p to its coordinates along the camera axes [m]: dot(xyz, p) + w.
    glm::vec4 right, up, forward;
    glm::vec4 window; ///< symbols k, k', c, c' of formula depth-contact
    /// Coefficients of the depth error e = x + y d + z d^2 that 24-bit depth has at the distance d [m] along
    /// the view axis.
    glm::vec4 error;
    /// x, y size of the texture [pixel]; z 1 for a parallel projection, else 0; w meters per local unit of
    /// length
    glm::vec4 size;
};

/// Returns the data for collisions of an emitter with the depth texture.
/// @param place placement of the emitter in the world
GpuDepthBlock makeGpuDepthBlock(const GpuDepth& depth, const base::Placement& place);

/// True if the emitter collides with the depth texture.
bool meetsDepth(const base::GpuParticleFeatures& features);

} // namespace fx::render
