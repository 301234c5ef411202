/// @file lod_flight.h
/// The flight of fx bench lod towards a field of effects, with a test whether changes of levels of detail are
/// visible.
#pragma once

#include "benchmarks/bench/instances/flight_pop.h"
#include "benchmarks/scenes/bench_scene.h"

#include <cstdint>
#include <vector>

namespace fx::cli {

constexpr double kLodNearest = 150.0;  ///< [m] distance to the field at the start of the flight
constexpr double kLodWidest = 0.3;     ///< [1] half the width of the field over its distance
constexpr double kLodEyeHeight = 40.0; ///< [m]

/// Limits of pops. At most one in a hundred of the changed blocks changes by more than kLodPopP99. No block
/// changes by more than kMaxLodPop times the largest change of the flight itself. Blocks are used because
/// single pixels at the edge of a thick flame change with motion of a hundredth of a pixel.
constexpr double kLodPopP99 = 0.045; ///< [1] 99th percentile of pops, in display values
constexpr double kMaxLodPop = 0.6;   ///< [1] factor on the largest change of the flight

/// A case of the measurement.
struct LodCase
{
    float bias;           ///< FxViewSettings::lodBias
    float impostorPixels; ///< FxViewSettings::lodImpostorPixels
    /// true: a control, in which levels of detail are switched off and on every few frames
    bool isHard = false;
};

/// Results of a flight.
struct LodFlight
{
    FlightPop pop;
    uint32_t changedFrames = 0; ///< number of frames in which a level or an impostor changed
};
bool isSmall(const LodFlight& flight); ///< whether the pops are within the limits

FxViewSettings lodSettings(const LodCase& what);

/// Number of frames until all impostors have been rendered and are in use.
uint32_t warmFrames(const LodCase& what);
/// Draws one moment repeatedly until the picture no longer changes.
base::Status drawStill(BenchScene& scene, const LodCase& what, std::vector<float>& outPicture);

struct LodFlightRules
{
    int pixels;      ///< width of the picture
    uint32_t frames; ///< 0: no flight
};

/// Draws each frame of a flight twice from the same camera: first with the levels and impostors of the
/// previous frame, then with those of this frame. The difference of both pictures is the visible effect of
/// the changes of levels and impostors.
/// @param ioWithout changes of the picture from frame to frame in the flight without levels of detail. The
///          first call must draw the flight without levels of detail. It gets an empty list, and fills the
///          list.
base::Status fly(BenchScene& scene, const LodFlightRules& rules, const LodCase& what,
                 std::vector<std::vector<float>>& ioWithout, LodFlight& outFlight);

} // namespace fx::cli
