/// @file random_preset.h
/// Random presets: any shape, force and appearance, within bounds that a camera can see.
#pragma once

#include <cstdint>
#include <string>

namespace fx::test {

/// Numbers that are the same everywhere.
class Dice
{
public:
    explicit Dice(uint64_t seed);
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Spread evenly over orders of magnitude.
    double magnitude(double low, double high);
    bool one(int in) { return next() % uint64_t(in) == 0; } ///< true one time in so many
    size_t below(size_t count) { return size_t(next() % count); }

private:
    uint64_t next();
    double unit() { return double(next() >> 11) * 0x1p-53; }
    uint64_t state_;
};

struct RandomPreset
{
    std::string text;
    std::string kind; ///< what it is about: "medium", "sprite", "mesh", "trail", "chain", "world", "gpu",
                      ///< "volume", "gas" or "fragments"
};

/// A preset with an emitter or a chain of them, with fragments or with gas. It names the assets below and
/// "library:debris-chunk.obj".
/// @param gpu whether emitters may ask for the GPU  @param gas whether there may be gas
RandomPreset randomPreset(uint64_t seed, bool gpu, bool gas);

/// The same of one emitter of few small solid particles that are fast in one direction, so that it can be
/// seen where they end.
RandomPreset sharpPreset(uint64_t seed);

/// "lump.obj", "cloud.fxgrid" and "wind.fxgrid": a mesh and a density to be born in, and moving air.
std::string lumpObj();
std::string cloudGrid();
std::string windGrid();

} // namespace fx::test
