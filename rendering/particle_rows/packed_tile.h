/// @file packed_tile.h
/// Buffer of up to 256 rows of particles. Packed rows (packed_rows.h) are written from this buffer.
#pragma once

#include <algorithm>
#include <cstdint>

namespace fx::render {

struct PackedTile
{
    static constexpr uint32_t kRows = 256;

    float x[kRows], y[kRows], z[kRows], age[kRows], radius[kRows];
    float red[kRows], green[kRows], blue[kRows], opacity[kRows];
    float velocityX[kRows], velocityY[kRows], velocityZ[kRows], angle[kRows], frame[kRows];
    float qx[kRows], qy[kRows], qz[kRows], qw[kRows];
    float flip[kRows];    ///< sign of the orientation quaternion, -1 or 1
    uint32_t turn[kRows]; ///< "turn" in 12 bits, see packed_rows.h

    /// Makes rows empty by setting them to 0.
    void fillFrom(uint32_t first, uint32_t count)
    {
        for (float* all : {x, y, z, age, radius, red, green, blue, opacity, velocityX, velocityY, velocityZ,
                           angle, frame, qx, qy, qz, qw})
            std::fill(all + first, all + count, 0.0f);
    }
};

/// Output pointers for the words of rows; null if a word is not written.
struct PackedTargets
{
    float* position[3];
    uint32_t *sizes, *colorLow, *colorHigh, *velocity, *orientation[2];
    float* frame;
    bool hasAngle;
};

} // namespace fx::render
