/// @file random_preset.h
/// Random presets with any shape, force and appearance, within the view of a camera.
#pragma once

#include <cstdint>
#include <string>

namespace fx::test {

/// Random numbers that are the same on every machine.
class Dice
{
public:
    explicit Dice(uint64_t seed);
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// A random number in [low, high) whose logarithm is uniformly distributed.
    double magnitude(double low, double high);
    bool one(int in) { return next() % uint64_t(in) == 0; } ///< true with the probability 1 / in
    size_t below(size_t count) { return size_t(next() % count); }

private:
    uint64_t next();
    double unit() { return double(next() >> 11) * 0x1p-53; }
    uint64_t state_;
};

struct RandomPreset
{
    std::string text;
    /// subject of the preset: "medium", "sprite", "mesh", "trail", "chain", "world", "gpu", "volume", "gas"
    /// or "fragments"
    std::string kind;
};

/// A random preset with one emitter, a chain of emitters, fragments or gas. The preset may refer to the
/// assets below and to "library:debris-chunk.obj".
/// @param gpu true: emitters may prefer the GPU
/// @param gas true: the preset may have gas
RandomPreset randomPreset(uint64_t seed, bool gpu, bool gas);

/// A random preset with one emitter of few small solid particles. The particles are fast in one direction, so
/// that their extent is clearly visible.
RandomPreset sharpPreset(uint64_t seed);

/// Contents of the assets that random presets refer to: "lump.obj", a mesh for births; "cloud.fxgrid", a
/// density for births; "wind.fxgrid", moving air.
std::string lumpObj();
std::string cloudGrid();
std::string windGrid();

} // namespace fx::test
