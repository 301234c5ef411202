/// @file city.h
/// fx bench city: ten thousand effects, of which a camera sees fifty, compared with a scene of only these
/// fifty.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fx::cli {

struct BenchCityOptions
{
    uint32_t instances = 10'000;
    uint32_t frames = 240;
    /// [degree] rotation of the camera per frame; above 0: update times during the rotation are measured
    double turn = 0;
    bool gl = false;    ///< true: each frame is drawn as well
    bool check = false; ///< true: results are compared with a city without culling, instead of measuring time
    bool json = false;
};

constexpr int kCityPresets = 12;

struct CityPlace
{
    double x, z; ///< [m] position
    uint32_t number;
};

/// A square grid around the camera; no effect is within 30 m of the camera.
std::vector<CityPlace> cityPlaces(uint32_t count);

/// Text of a preset for one of twelve fountains with different costs.
/// @param offscreen the preset's member "offscreen"  @param ballistic false: one in three fountains has
///          turbulence
std::string cityPreset(int index, const std::string& offscreen, bool ballistic);

/// Compares hashes, memory and pictures of the city with a city without culling.
/// @return exit code: 0, or 1 if a hash, the memory or a picture differs
int checkCity(const BenchCityOptions& options);

/// Measures times, replays and memory while the camera rotates by `options.turn` per frame. @return exit code
int turnCity(const BenchCityOptions& options);

} // namespace fx::cli
