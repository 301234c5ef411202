/// @file flights.h
/// Named sequences of frames 1/60 s apart: flights of an eye through effects of the library, and clouds under
/// a light that turns or an eye that travels. Everything follows from the name.
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
    Composition, ///< how overlapping media are put together: media send light of their own only
    Light        ///< light slices: media are lit by the sun
};

struct FlightName
{
    std::string_view name;
    FlightSubject subject;
    uint32_t frames; ///< of the whole flight

    /// Few large balls, so that two which swap their places in an order are seen: drawn one over the other
    /// they break the bound. In effects of hundreds of balls the motion of the media hides that.
    bool hasControl = false;
};

/// All flights.
std::span<const FlightName> flightNames();

/// The frames in the middle of a flight. Blobs of effects have the light of sun and sky as it arrives in
/// their centers, scattered alike in all directions, as light of their own.
/// @param name one of flightNames()
/// @param frames at most as many as the flight has
base::Result<std::vector<FlightFrame>> flightFrames(std::string_view name, uint32_t frames);

} // namespace fx::cli
