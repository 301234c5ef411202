/// @file random_preset.h
/// Presets that nobody has thought of: any shape, force and appearance, within bounds that a camera can see.
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

/// The text of a preset with an emitter or two, or with fragments. It names "spot.png", "lump.obj" and
/// "library:debris-chunk.obj".
/// @param gpu whether emitters may ask for the GPU
std::string randomPreset(uint64_t seed, bool gpu);

/// A mesh for emitters to give birth on.
std::string lumpObj();

} // namespace fx::test
