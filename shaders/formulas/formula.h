/// @file formula.h
/// Compiles the formula texts (*.fx.h) as C++: fx::formula in float, fx::formula64 in double. GLSL compiles
/// the same texts, see shader_library.cpp.
///
/// A formula text may use FX_REAL, FX_FORMULA(name), arithmetic, comparison, ?: and the functions below,
/// nothing else.
#pragma once

#include <cmath>

#define FX_FORMULA(name) inline FX_REAL name

#define FX_FORMULA_SPACE_BEGIN                                                                               \
    using std::sqrt;                                                                                         \
    using std::exp;                                                                                          \
    using std::exp2;                                                                                         \
    using std::log;                                                                                          \
    using std::pow;                                                                                          \
    using std::floor;                                                                                        \
    using std::abs;                                                                                          \
    inline FX_REAL min(FX_REAL a, FX_REAL b)                                                                 \
    {                                                                                                        \
        return b < a ? b : a;                                                                                \
    }                                                                                                        \
    inline FX_REAL max(FX_REAL a, FX_REAL b)                                                                 \
    {                                                                                                        \
        return a < b ? b : a;                                                                                \
    }                                                                                                        \
    inline FX_REAL clamp(FX_REAL x, FX_REAL a, FX_REAL b)                                                    \
    {                                                                                                        \
        return min(max(x, a), b);                                                                            \
    }                                                                                                        \
    inline FX_REAL fract(FX_REAL x)                                                                          \
    {                                                                                                        \
        return x - floor(x);                                                                                 \
    }

#define FX_REAL float
namespace fx::formula {
FX_FORMULA_SPACE_BEGIN
// The order is that of use.
// clang-format off
#include "shaders/formulas/black_body_contrast.fx.h"
#include "shaders/formulas/detail_noise.fx.h"
#include "shaders/formulas/field_detail.fx.h"
#include "shaders/formulas/field_glow.fx.h"
#include "shaders/formulas/heat_stream.fx.h"
#include "shaders/formulas/henyey_greenstein.fx.h"
#include "shaders/formulas/kernel_moment.fx.h"
#include "shaders/formulas/kernel_optical_depth.fx.h"
#include "shaders/formulas/kernel_quantile.fx.h"
#include "shaders/formulas/lump_noise.fx.h"
#include "shaders/formulas/multiple_scattering.fx.h"
#include "shaders/formulas/network_cell.fx.h"
#include "shaders/formulas/sensor_law.fx.h"
#include "shaders/formulas/slab_light.fx.h"
#include "shaders/formulas/slice_depth.fx.h"
#include "shaders/formulas/soil_texture.fx.h"
#include "shaders/formulas/sphere_path.fx.h"
#include "shaders/formulas/tone_curve.fx.h"
#include "shaders/formulas/display_codes.fx.h"
#include "shaders/formulas/volume_advection.fx.h"
#include "shaders/formulas/voxel_kernel.fx.h"
#include "shaders/formulas/widened_ball.fx.h"
#include "shaders/formulas/wooded_horizon.fx.h"
// clang-format on
} // namespace fx::formula
#undef FX_REAL

#define FX_REAL double
namespace fx::formula64 {
FX_FORMULA_SPACE_BEGIN
// clang-format off
#include "shaders/formulas/sphere_path.fx.h"
#include "shaders/formulas/kernel_optical_depth.fx.h"
#include "shaders/formulas/kernel_moment.fx.h"
#include "shaders/formulas/kernel_quantile.fx.h"
#include "shaders/formulas/lump_noise.fx.h"
#include "shaders/formulas/black_body_contrast.fx.h"
#include "shaders/formulas/detail_noise.fx.h"
#include "shaders/formulas/field_detail.fx.h"
#include "shaders/formulas/field_glow.fx.h"
#include "shaders/formulas/heat_stream.fx.h"
#include "shaders/formulas/henyey_greenstein.fx.h"
#include "shaders/formulas/soil_texture.fx.h"
#include "shaders/formulas/multiple_scattering.fx.h"
#include "shaders/formulas/network_cell.fx.h"
#include "shaders/formulas/sensor_law.fx.h"
#include "shaders/formulas/slab_light.fx.h"
#include "shaders/formulas/slice_depth.fx.h"
#include "shaders/formulas/tone_curve.fx.h"
#include "shaders/formulas/display_codes.fx.h"
#include "shaders/formulas/volume_advection.fx.h"
#include "shaders/formulas/voxel_kernel.fx.h"
#include "shaders/formulas/widened_ball.fx.h"
#include "shaders/formulas/wooded_horizon.fx.h"
// clang-format on
} // namespace fx::formula64
#undef FX_REAL

#undef FX_FORMULA
