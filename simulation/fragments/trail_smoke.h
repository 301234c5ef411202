/// @file trail_smoke.h
/// Emission, motion and fading of the smoke of a fragment.
///
/// @formula smoke-trail
/// Blobs of smoke at equal distances along the path of a fragment, and their evolution.
///
/// symbol   unit   meaning
///   L       m      path length of a fragment in a step, at least idle speed times the step's length
///   D       m      remaining distance to the next blob
///   h       m      spacing
///   f_j     1      share of the step after which blob j is emitted
///   R_0, R  m      radius at birth, at age a
///   K       m2/s   spreading
///   T_0, T  K      temperature at birth, at age a; T_a of the air
///   q       1/s    mixing
///   s       1      share of the smoke that is still drawn
///   l       s      lifetime
/// @derivation
///   Blob j = 0, 1, ... is emitted after f_j = (D + j h) / L, if that is at most 1               (1)
///   Then D <- D + n h - L for n blobs, so the spacing does not depend on the division into steps (2)
///   By diffusion the square of the radius grows linearly, R^2 = R_0^2 + K a                     (3)
///   By mixing T = T_a + (T_0 - T_a) exp(-q a)                                                    (4)
///   The cross section is constant (soot is conserved), multiplied by the fading s = (1 - (a/l)^2)^2 (5)
///   A blob rises by (T / T_a - 1) g, with the mean of (4) over the step, and follows the air by
///   formula linear-drag-step                                                                     (6)
/// @source    own; (1)-(4) are elementary
/// @deviation the path within a step is its chord
/// @valid     h > 0
/// @accuracy  spacing along the way: float rounding times the number of blobs; equal for all steps up to the
///            difference of chord and path, relative (turn of the velocity in a step)^2 / 24
/// @tests     tests/simulation/fragments/test_fragments_solver.cpp,
/// tests/simulation/fragments/test_trail_smoke.cpp
#pragma once

#include "simulation/fragments/fragment_store.h"
#include "simulation/fragments/fragments_def.h"
#include "simulation/fragments/trail_store.h"
#include "simulation/motion/curl_noise.h"
#include "simulation/motion/ground_contact.h"

#include <array>

namespace fx::sim {

/// Data shared by all blobs of a step.
struct TrailStep
{
    TrailStep(const FragmentsDef& definition, const StepContext& context);

    const FragmentsDef& def;
    const StepContext& step;
    base::Ticks end; ///< local time at which the step ends
    CurlNoise noise;
};

/// Flight of a fragment in a step, and the smoke that it emits.
struct FragmentWay
{
    MotionState from;
    MotionState to;
    float length;    ///< [m] length L of equation (2), along which smoke is emitted
    float due;       ///< [m] distance D of equation (2) before the step
    uint32_t blobs;  ///< number of blobs emitted in the step
    uint32_t stored; ///< number of emitted blobs that fit into the store
    uint32_t first;  ///< row of the first stored blob
};

/// Number n of blobs along a path, by equation (2).
uint32_t blobsAlong(float length, float due, float spacing);

/// A range of consecutive rows.
struct SmokeRows
{
    uint32_t begin;
    uint32_t end;
};

/// Writes the smoke of fragment `row` along `way` to `rows`. The blobs have their state at the end of the
/// step.
/// @param begin local time at which `way` begins
void emitSmoke(const TrailStep& step, const FragmentStore& fragments, uint32_t row, const FragmentWay& way,
               base::Ticks begin, const SmokeRows& rows, TrailStore& trail);

/// Moves the rows [begin, end) over the whole step.
void moveSmoke(const TrailStep& step, TrailStore& trail, uint32_t begin, uint32_t end);

/// Appearance of a blob at an age.
struct SmokeAppearance
{
    float radius;      ///< [m] radius by equation (3)
    float temperature; ///< [K] temperature by equation (4)
    float share;       ///< [1] factor by equation (5)
};
SmokeAppearance smokeAppearance(const TrailDef& def, float radius, float age, float lifetime);

} // namespace fx::sim
