/// @file material_coordinates.h
/// Positions of the balls of a medium at the births of two generations of coordinates. The noise for the
/// detail of the medium is evaluated at these positions, so that the detail moves with the medium.
///
/// @formula material-coordinates
/// Noise that a flow carries must be renewed before the flow has distorted it too much.
///
/// symbol   unit   meaning
///   S       1/s    rms of the traceless symmetric part of the velocity gradient over the balls
///   w       1/s    curl of the velocity
///   e       1      shear since the beginning, over the shear between two births
///   n, f    1      number of the younger generation and its weight
///   m_n     m      coordinate of a ball in generation n
///   x, v           position and velocity of the ball
///   t, t_n  s      now, and when generation n was born
/// @derivation
///   In homogeneous, divergence-free flow the mean squares of strain and vorticity are proportional:
///       S^2 = <w^2> / 2                                                                     (1)
///   A generation is born each time the shear has grown by 1/2, and lives for twice that:
///       de/dt = 2 l S, at most 8 /s, n = 1 + floor(e), f = e - floor(e)                     (2)
///   with the preset's liveliness l. The weights f and 1 - f are triangle functions, so a generation has the
///   weight 0 at its birth and at its death. Its coordinate is the position of the ball at its birth:
///       m_n = x(t_n)                                                                        (3)
///   A ball that is born later gets the coordinate that it would have if its stream had flowed before, so
///   that the balls of a steady stream have different coordinates:
///       m_n = x - V (t - t_n)                                                               (4)
///   V is its mean velocity in the first half of the lifetime of a generation, by linear-drag-step.
/// @source    [NEY03] advected textures with renewal, for the two generations
/// @deviation (2) counts shear instead of time; the generations of all balls are born together
/// @valid     any flow; e grows without limit
/// @accuracy  (1) is exact in homogeneous turbulence; in a fireball it gives the order of magnitude
/// @tests     tests/simulation/detail/test_generation_clock.cpp, tests/simulation/detail/test_gas_detail.cpp,
///            tests/simulation/detail/test_emitter_detail.cpp
#pragma once

#include "foundation/memory/column.h"
#include "simulation/detail/field_detail.h"

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <memory_resource>
#include <span>

namespace fx::sim {

constexpr double kShearOfGeneration = 0.5; ///< [1] shear between two births of generations
constexpr double kMaxGenerationRate = 8.0; ///< [1/s] maximum birth rate of generations

/// Clock by which generations of coordinates begin, by equation (2).
class GenerationClock
{
public:
    /// Advances the clock by a step.
    /// @param shear [1] shear during the step: the rate S times the duration
    /// @return number of generations that began
    uint64_t advance(double shear, double seconds);
    uint64_t younger() const { return younger_; }
    double fade() const { return fade_; } ///< [1] weight of the younger generation, [0, 1)
    void set(uint64_t younger, double fade)
    {
        younger_ = younger;
        fade_ = fade;
    }

private:
    uint64_t younger_ = 1;
    double fade_ = 0;
};

/// The coordinates m_n of two generations for a fixed number of balls, one row per ball.
class MaterialCoordinates
{
public:
    static constexpr size_t kColumns = 6; ///< number of columns of material_column

    MaterialCoordinates(std::pmr::memory_resource* memory, uint32_t capacity);
    static constexpr uint64_t bytesOf(uint32_t capacity) { return kColumns * sizeof(float) * capacity; }

    void set(uint64_t generation, uint32_t row, const glm::vec3& place)
    {
        for (size_t a = 0; a < 3; ++a)
            columns_[first(generation) + a][row] = place[int(a)];
    }
    glm::vec3 at(uint64_t generation, uint32_t row) const
    {
        const size_t c = first(generation);
        return {columns_[c][row], columns_[c + 1][row], columns_[c + 2][row]};
    }
    float value(size_t column, uint32_t row) const { return columns_[column][row]; }
    float& value(size_t column, uint32_t row) { return columns_[column][row]; }
    std::span<float> rows(size_t column, uint32_t count) { return columns_[column].first(count); }
    std::span<const float> rows(size_t column, uint32_t count) const { return columns_[column].first(count); }

private:
    static constexpr size_t first(uint64_t generation) { return generation % 2 * 3; }

    std::array<base::Column<float>, kColumns> columns_;
};

} // namespace fx::sim
