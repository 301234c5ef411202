/// @file gpu_compare.h
/// Compares rows that the GPU has computed with the rows of the CPU.
#pragma once

#include "gpu_fixture.h"

#include <algorithm>
#include <cmath>

namespace fx::test {

namespace column = base::particle_column;

/// Bound of the difference of positions, relative to the length of the path; see docs/howto/gpu-particles.md.
inline constexpr float kBound = 4e-6f;

/// Largest distance of a living particle from the origin.
inline float farthest(const Rows& rows)
{
    float most = 0;
    for (size_t i = 0; i < rows.count(); ++i)
        for (size_t a = 0; a < 3; ++a)
            most = std::max(most, std::abs(rows.columns[column::PositionX + a][i]));
    return most;
}

/// Expects that the bounds `seen` of particles are inside of `possible`. For GPU emitters, `possible`
/// contains all possible particles, because the CPU does not compute the particles.
inline void expectInside(const base::Bounds& seen, const base::Bounds& possible)
{
    if (seen.empty())
        return;
    for (int a = 0; a < 3; ++a) {
        EXPECT_GE(seen.min[a], possible.min[a]) << "axis " << a;
        EXPECT_LE(seen.max[a], possible.max[a]) << "axis " << a;
    }
    const float size = glm::length(possible.max - possible.min);
    EXPECT_LT(size, 40.0f * glm::length(seen.max - seen.min) + 1.0f) << "bounds of no use";
}

/// Number of rows of living particles that are not bit-equal.
inline size_t countDifferent(const Rows& cpu, const Rows& gpu)
{
    size_t different = 0;
    for (size_t i = 0; i < std::min(cpu.count(), gpu.count()); ++i) {
        bool same = !cpu.isAlive(i) || cpu.color[i] == gpu.color[i];
        for (size_t c = 0; c < column::Count && cpu.isAlive(i); ++c)
            same = same &&
                   (c == column::Index || cpu.columns[c].empty() || cpu.columns[c][i] == gpu.columns[c][i]);
        different += same ? 0 : 1;
    }
    return different;
}

/// Compares the rows computed by CPU and GPU. @return number of living particles
inline size_t compare(const Rows& cpu, const Rows& gpu)
{
    size_t living = 0, wrong = 0;
    double worst[column::Count] = {};
    double worstColor = 0;
    const float size = farthest(cpu);
    for (size_t i = 0; i < gpu.count(); ++i) {
        const bool isAlive = i < cpu.count() && cpu.isAlive(i); // rows beyond the window are not published
        wrong += gpu.isAlive(i) != isAlive ? 1 : 0;
        living += isAlive ? 1 : 0;
        if (!isAlive || !gpu.isAlive(i))
            continue;
        for (size_t c = 0; c < column::Count; ++c)
            if (c != column::Index && !cpu.columns[c].empty())
                worst[c] = std::max(worst[c], double(std::abs(cpu.columns[c][i] - gpu.columns[c][i])));
        for (int k = 0; k < 4; ++k)
            worstColor = std::max(worstColor, double(std::abs(cpu.color[i][k] - gpu.color[i][k]) /
                                                     std::max(cpu.color[i][k], 1e-3f)));
        EXPECT_EQ(cpu.columns[column::Age][i], gpu.columns[column::Age][i]) << "row " << i;
    }
    EXPECT_EQ(wrong, 0u) << "rows live on one side only";
    for (const size_t c : {size_t(column::PositionX), size_t(column::PositionY), size_t(column::PositionZ)})
        EXPECT_LE(worst[c], double(kBound * size)) << "column " << c;
    EXPECT_LE(worst[column::Radius], 1e-5 * double(size));
    EXPECT_LE(worstColor, 2e-3);
    return living;
}

} // namespace fx::test
