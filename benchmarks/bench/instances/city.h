/// @file city.h
/// fx bench city: ten thousand effects of which a camera sees fifty, against a scene that has only those.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fx::cli {

struct BenchCityOptions
{
    uint32_t instances = 10'000;
    uint32_t frames = 240;
    double turn = 0;    ///< [degree] a frame; above 0: how long updates take while the camera turns so fast
    bool gl = false;    ///< draw each frame as well
    bool check = false; ///< compare with a city that hides nothing, instead of measuring time
    bool json = false;
};

constexpr int kCityPresets = 12;

struct CityPlace
{
    double x, z; ///< [m]
    uint32_t number;
};

/// A square grid about the camera, which is alone within 30 m.
std::vector<CityPlace> cityPlaces(uint32_t count);

/// One of twelve fountains with different costs.
/// @param offscreen their policy @param ballistic false: one in three has turbulence
std::string cityPreset(int index, const std::string& offscreen, bool ballistic);

/// Compares hashes, memory and pictures of the city with those of a city without culling.
/// @return exit code: 0, or 1 if any of them differs
int checkCity(const BenchCityOptions& options);

/// Times, replays and memory while the camera turns by `options.turn` a frame. @return exit code
int turnCity(const BenchCityOptions& options);

} // namespace fx::cli
