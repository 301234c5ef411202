/// @file dazzle_pass.h
#pragma once

#include "foundation/result/status.h"
#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"

#include <cstdint>

namespace fx::render {

inline constexpr ProgramDesc kDazzleSumProgram{"dazzle sum", nullptr, nullptr, "dazzle/dazzle_sum.comp.glsl",
                                               nullptr};
inline constexpr ProgramDesc kDazzleBudgetProgram{"dazzle budget", nullptr, nullptr,
                                                  "dazzle/dazzle_budget.comp.glsl", nullptr};
inline constexpr ProgramDesc kDazzleDealProgram{"dazzle deal", nullptr, nullptr,
                                                "dazzle/dazzle_deal.comp.glsl", nullptr};

/// Glare adaptation of a view; std430 layout of the history buffer. All zero before the first frame.
struct DazzleHistory
{
    double
        adapted[3]; ///< [1] mean overflow per pixel that glare is made from, units of white; red, green, blue
    double frameMean[3]; ///< [1] that of the last frame, without adaptation
    uint32_t valid;      ///< 1 after the first frame
    uint32_t replaced;   ///< channel values of the last frame that were not finite, negative or too large
};
static_assert(sizeof(DazzleHistory) == 56);

/// Fixed point in which light is counted: `white` is exactly whiteQuanta * 2^exponent, 2^23 < whiteQuanta <=
/// 2^24, and every whole number of quanta up to white is a float.
struct DazzleScale
{
    uint32_t whiteQuanta;
    int exponent;
};
DazzleScale dazzleScale(float white);

/// [1] Values above this many times `white` are cut, so that integer sums of a tile stay below 2^63.
inline constexpr float kDazzleLargest = 0x1p30f;

/// Share of the old adaptation that remains after `deltaTime` [s]: exp(-dt / tau), however the time is cut.
/// If dt is zero, negative or NaN, the history is kept completely; if tau is 0, it is discarded.
double dazzleKeep(double deltaTime, double timeConstant);

/// Checks the settings: white in [1e-6, 1e9], times not negative, and a sensor law that never gives less
/// glare for more light (formula sensor-law, condition 2).
/// @return InvalidArgument naming the value and its range
base::Status checkSensorLaw(const DazzleSettings& settings);

/// Glare of a sensor whose pixels saturate: light above `white` is taken from its pixels and given to all
/// others in proportion to their headroom, [UBT96]. Each channel for itself. Sums are integers, so that with
/// A = 1, B = 0, adaptation at rest and room enough the picture holds exactly as many quanta afterwards as
/// before, and the result does not depend on the order of the work. Formula: sensor-law.
///
/// reads   color    RGBA32F exposed radiance; NaN and negative count as 0, +inf as 65504 (all counted)
///         history  DazzleHistory
/// writes  color    RGBA32F, at most white; alpha unchanged; a value below white that gets no glare keeps its
///         bits history the state after this frame
/// Adds nothing when glare is switched off or checkSensorLaw() refuses the settings.
class DazzlePass
{
public:
    struct Inputs
    {
        ResourceId color;
        ResourceId history; ///< imported buffer of sizeof(DazzleHistory)
        int width, height;  ///< [pixel], at most 16384 each
        DazzleSettings settings;
        double deltaTime;  ///< [s] since the last frame
        bool resetHistory; ///< adaptation starts from this frame
    };
    struct Outputs
    {
        ResourceId color;
        ResourceId history;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
