#include "simulation/blocks/block_turn.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <cmath>

namespace fx::sim {

namespace {

constexpr uint32_t kTrials = 32;

/// A point of the unit disc, evenly distributed, but not its center: the first of random places in the square
/// that lies in the disc.
glm::vec2 discPoint(uint64_t seed, uint32_t stream, uint64_t index)
{
    for (uint32_t trial = 0; trial < kTrials; ++trial) {
        const auto u = base::randomUnit4(seed, stream + trial, index, base::RandomPurpose::Spin);
        for (size_t k = 0; k < 4; k += 2) {
            const glm::vec2 point(2.0f * u[k] - 1.0f, 2.0f * u[k + 1] - 1.0f);
            const float squared = glm::dot(point, point);
            if (squared <= 1.0f && squared > 1e-6f)
                return point;
        }
    }
    return {1.0f, 0.0f};
}

glm::quat uprightTurn(uint64_t seed, uint64_t index)
{
    const glm::vec2 point = discPoint(seed, 0, index), halfAngle = point / glm::length(point);
    return {halfAngle.x, 0.0f, halfAngle.y, 0.0f};
}

/// Evenly distributed among all rotations: a point of the unit sphere in four dimensions, from two points of
/// the disc [MAR72].
glm::quat freeTurn(uint64_t seed, uint64_t index)
{
    const glm::vec2 a = discPoint(seed, 0, index), b = discPoint(seed, kTrials, index);
    const float rest = std::sqrt((1.0f - glm::dot(a, a)) / glm::dot(b, b));
    return {a.x, a.y, b.x * rest, b.y * rest};
}

} // namespace

glm::quat turnOf(BlockTurn turn, uint64_t seed, uint64_t index)
{
    switch (turn) {
    case BlockTurn::None:
        break;
    case BlockTurn::Upright:
        return uprightTurn(seed, index);
    case BlockTurn::Free:
        return freeTurn(seed, index);
    }
    return {1.0f, 0.0f, 0.0f, 0.0f};
}

} // namespace fx::sim
