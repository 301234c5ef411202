#include "simulation/blocks/block_noise.h"

#include "foundation/math/elementary.h"
#include "foundation/math/hash.h"

#include <cmath>

namespace fx::sim {

namespace {

/// In [-1, 1].
float valueAt(uint64_t seed, uint32_t octave, int x, int y, int z)
{
    uint64_t hash = base::hashWord(seed, octave);
    hash = base::hashWord(hash, uint64_t(uint32_t(x)) << 32 | uint32_t(y));
    hash = base::hashWord(hash, uint32_t(z));
    return float(hash >> 40) * (2.0f / float((1u << 24) - 1u)) - 1.0f;
}

float mix(float a, float b, float t)
{
    return a + t * (b - a);
}

float fade(float t)
{
    return base::smoothStep(0.0f, 1.0f, t);
}

} // namespace

float BlockNoise::octaveAt(const glm::vec3& position, uint32_t octave) const
{
    const glm::vec3 cell(std::floor(position.x), std::floor(position.y), std::floor(position.z));
    const int x = int(cell.x), y = int(cell.y), z = int(cell.z);
    const glm::vec3 t(fade(position.x - cell.x), fade(position.y - cell.y), fade(position.z - cell.z));
    float rows[2][2];
    for (int k = 0; k < 2; ++k)
        for (int j = 0; j < 2; ++j)
            rows[k][j] = mix(valueAt(seed_, octave, x, y + j, z + k),
                             valueAt(seed_, octave, x + 1, y + j, z + k), t.x);
    return mix(mix(rows[0][0], rows[0][1], t.y), mix(rows[1][0], rows[1][1], t.y), t.z);
}

float BlockNoise::at(const glm::vec3& position) const
{
    float sum = 0.0f, all = 0.0f, amplitude = 1.0f;
    glm::vec3 p = position * perLength_;
    for (uint32_t octave = 0; octave < octaves_; ++octave) {
        sum += amplitude * octaveAt(p, octave);
        all += amplitude;
        amplitude *= 0.5f;
        p *= 2.0f;
    }
    return sum / all;
}

} // namespace fx::sim
