/// @file flights.h
/// Named sequences of frames 1/60 s apart: flights of an eye through effects of the library, and clouds under
/// a rotating light or a moving eye. The name of a flight determines all of its frames.
#pragma once

#include "benchmarks/scenes/lit_media.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fx::cli {

/// One frame of a flight.
struct FlightFrame
{
    std::vector<render::MediumBlob> blobs;
    LitView view;
};

/// Subject of the comparison in a flight.
enum class FlightSubject
{
    Composition, ///< composition of overlapping media; media emit their own light only
    Light        ///< light slices: media are lit by the sun
};

struct FlightName
{
    std::string_view name;
    FlightSubject subject;
    uint32_t frames; ///< number of frames of the whole flight

    /// Whether the flight has a control of a few large balls, in which a change of the drawing order is
    /// visible. If these balls are blended in sorted order, the picture violates the bound. In effects of
    /// hundreds of balls, the motion of the media hides changes of the drawing order.
    bool hasControl = false;
};

/// All flights.
std::span<const FlightName> flightNames();

/// The frames in the middle of a flight. For effects, the light of sun and sky at the center of each blob,
/// scattered isotropically, is added to the blob's emission.
/// @param name one of flightNames()
/// @param frames at most the number of frames of the flight
base::Result<std::vector<FlightFrame>> flightFrames(std::string_view name, uint32_t frames);

} // namespace fx::cli
