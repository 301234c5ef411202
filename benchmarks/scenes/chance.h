/// @file chance.h
/// Repeatable random numbers for scenes of measurements and tests.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cstdint>

namespace fx::bench {

/// Random numbers in [0, 1) that depend only on the seed.
class Chance
{
public:
    explicit Chance(uint64_t seed) : state_(seed) {}
    double operator()()
    {
        state_ += 0x9E3779B97F4A7C15u;
        uint64_t x = (state_ ^ (state_ >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        return double((x ^ (x >> 31)) >> 11) * 0x1.0p-53;
    }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    glm::dvec3 inCube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
    glm::dvec3 direction()
    {
        for (;;) {
            const glm::dvec3 v = inCube();
            const double length = glm::length(v);
            if (length > 0.1 && length < 1.0)
                return v / length;
        }
    }

private:
    uint64_t state_;
};

} // namespace fx::bench
