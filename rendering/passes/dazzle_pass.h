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

/// State of the adaptation of glare of a view, in the std430 layout of the history buffer. All members are 0
/// before the first frame.
struct DazzleHistory
{
    double adapted[3];   ///< [1] adapted mean overflow per pixel, in units of white, for red, green and blue
    double frameMean[3]; ///< [1] mean overflow per pixel of the last frame, in units of white
    uint32_t valid;      ///< 0 before the first frame, then 1
    /// Number of channel values of the last frame that were replaced because they were not finite, negative
    /// or too large.
    uint32_t replaced;
};
static_assert(sizeof(DazzleHistory) == 56);

/// The unit (quantum) for integer sums of light is 2^exponent. `white` is exactly whiteQuanta quanta, with
/// 2^23 < whiteQuanta <= 2^24. So every integer number of quanta up to white is representable as a float.
struct DazzleScale
{
    uint32_t whiteQuanta;
    int exponent;
};
DazzleScale dazzleScale(float white);

/// [1] Values are clamped to this factor times `white`, so that the integer sums of a tile are less than
/// 2^63.
inline constexpr float kDazzleLargest = 0x1p30f;

/// Returns the weight of the previous adaptation after the time dt [s] = `deltaTime`: exp(-dt / tau). With
/// this weight, adaptation does not depend on the frame rate. If dt is 0, negative or NaN, the weight is 1.
/// If tau is 0, the weight is 0. @param timeConstant time constant tau [s]
double dazzleKeep(double deltaTime, double timeConstant);

/// Checks the settings. `white` must be in [1e-6, 1e9], and times must not be negative. More light must
/// never cause less glare (formula sensor-law, condition 2).
/// @return InvalidArgument with the value and its range in the message
base::Status checkSensorLaw(const DazzleSettings& settings);

/// Glare of a sensor whose pixels saturate, [UBT96]: light above `white` is removed from a pixel and
/// distributed to all other pixels, in proportion to their headroom. Channels are independent. Sums are
/// integers, so that the result does not depend on the order of execution. With a = 1, b = 0, constant
/// adaptation and enough headroom, the total number of quanta is kept exactly. Formula: sensor-law.
///
/// reads   color    RGBA32F exposed radiance; NaN and negative values are replaced by 0, +inf by 65504
///         history  DazzleHistory
/// writes  color    RGBA32F, at most white; alpha unchanged. Without glare, values below white do not change
///         history  the state after this frame
/// No pass is added if glare is disabled, or if checkSensorLaw() returns an error.
class DazzlePass
{
public:
    struct Inputs
    {
        ResourceId color;
        ResourceId history; ///< imported buffer of sizeof(DazzleHistory)
        int width, height;  ///< [pixel] size of the picture; each at most 16384
        DazzleSettings settings;
        double deltaTime;  ///< [s] time since the last frame
        bool resetHistory; ///< true: adaptation starts from this frame
    };
    struct Outputs
    {
        ResourceId color;
        ResourceId history;
    };
    [[nodiscard]] static Outputs addTo(FrameGraph& graph, const Inputs& in);
};

} // namespace fx::render
