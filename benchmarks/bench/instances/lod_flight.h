/// @file lod_flight.h
/// The flight of fx bench lod towards a field of effects, and whether levels of detail are seen to change in
/// it.
#pragma once

#include "benchmarks/bench/instances/flight_pop.h"
#include "benchmarks/scenes/bench_scene.h"

#include <cstdint>
#include <vector>

namespace fx::cli {

constexpr double kLodNearest = 150.0;  ///< [m] of the field, from where the flight begins
constexpr double kLodWidest = 0.3;     ///< [1] half the width of the field over its distance
constexpr double kLodEyeHeight = 40.0; ///< [m]

/// Limits of pops: of the changed blocks at most one in a hundred changes by more than kLodPopP99, and none
/// by more than kMaxLodPop of the largest change of the flight itself. Blocks are used because single pixels
/// at the edge of a thick flame change with motion of a hundredth of a pixel.
constexpr double kLodPopP99 = 0.04; ///< [1] of display values
constexpr double kMaxLodPop = 0.6;  ///< [1]

/// Case of the measurement.
struct LodCase
{
    float bias;           ///< FxViewSettings::lodBias
    float impostorPixels; ///< FxViewSettings::lodImpostorPixels
    bool isHard = false;  ///< the same, but switched off and on every few frames of the flight: a control
};

/// Results of a flight.
struct LodFlight
{
    FlightPop pop;
    uint32_t changedFrames = 0; ///< in which a level or a picture has changed
};
bool isSmall(const LodFlight& flight); ///< nothing pops

FxViewSettings lodSettings(const LodCase& what);

/// Frames until impostors have been rendered and have replaced their effects.
uint32_t warmFrames(const LodCase& what);
/// Draws the same moment until the picture is constant.
base::Status drawStill(BenchScene& scene, const LodCase& what, std::vector<float>& outPicture);

struct LodFlightRules
{
    int pixels;      ///< of the picture's width
    uint32_t frames; ///< 0: no flight
};

/// Each frame is drawn twice from where the camera is: with the levels and impostors of the previous frame,
/// and with its own. The difference is the effect of changing them.
/// @param ioWithout changes from frame to frame of the flight without a level of detail; empty: this is that
/// flight
base::Status fly(BenchScene& scene, const LodFlightRules& rules, const LodCase& what,
                 std::vector<std::vector<float>>& ioWithout, LodFlight& outFlight);

} // namespace fx::cli
