// Writes the voxels of library:thunderhead, a cloud of towers below an anvil. The build runs it:
// make_thunderhead OUT.fxvolume. Lengths are in voxels of kSide, +Y is up, and the wind blows along +X.
#include "foundation/assets/voxel_volume.h"
#include "foundation/math/hash.h"
#include "fxsdk/assets/volume_file.h"
#include "simulation/blocks/block_noise.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <vector>

namespace {

using namespace fx;

constexpr float kSide = 50.0f;        // [m]
constexpr float kExtinction = 0.075f; // [1/m] of droplets
constexpr float kIce = 0.2f;          // extinction of the anvil, which is ice, over that of droplets
constexpr glm::ivec3 kLow(-7, 0, -5), kHigh(9, 9, 5); // [brick] box that holds the cloud
constexpr float kFarthest = 8.0f;                     // depth below which nothing is cloud
constexpr float kBase = 5.0f, kAnvil = 54.0f;         // heights

struct Ball
{
    glm::vec3 center;
    float radius;
};

/// A number from 0 to 1 that depends on nothing but its arguments.
float random(uint64_t key, uint64_t seed)
{
    return float(base::hashWord(base::hashWord(1, seed), key) >> 40) * 0x1p-24f;
}

/// A unit vector that depends on nothing but its argument.
glm::vec3 randomDirection(uint64_t key)
{
    for (uint64_t trial = 0;; ++trial) {
        const glm::vec3 p(random(key, 3 * trial + 20), random(key, 3 * trial + 21),
                          random(key, 3 * trial + 22));
        const glm::vec3 q = 2.0f * p - 1.0f;
        const float length = glm::length(q);
        if (length > 0.1f && length < 1.0f)
            return q / length;
    }
}

/// Balls of rising air, one on the other, which lean with the wind and become smaller with height; and
/// smaller ones on their surfaces.
std::vector<Ball> towers()
{
    struct Tower
    {
        float x, z, top, radius;
    };
    constexpr Tower kTowers[] = {{-4, 0, 51, 13}, {7, 3, 48, 12},   {1, -8, 44, 10},    {-13, -2, 38, 10},
                                 {16, -3, 33, 9}, {4, 11, 31, 8},   {-11, 9, 25, 7},    {-23, 3, 26, 8.5f},
                                 {26, 2, 20, 8},  {-33, -2, 17, 7}, {35, -4, 14, 6.5f}, {-42, 2, 11, 6},
                                 {20, 10, 15, 6}, {-28, 8, 10, 5},  {42, 3, 10, 5},     {-18, 14, 13, 6}};
    std::vector<Ball> balls;
    for (const Tower& tower : kTowers)
        for (float y = 0.5f * tower.radius; y < tower.top;) {
            const uint64_t key = balls.size();
            const float radius =
                tower.radius * (1.0f - 0.45f * y / tower.top) * (0.75f + 0.5f * random(key, 5));
            const float spread = 1.5f * tower.radius;
            balls.push_back({{tower.x + 0.12f * y + spread * (random(key, 6) - 0.5f), y,
                              tower.z + spread * (random(key, 7) - 0.5f)},
                             radius});
            y += 0.75f * radius;
        }
    const size_t large = balls.size();
    for (size_t i = 0; i < 9 * large; ++i) {
        const Ball ball = balls[i % large];
        const float radius = ball.radius * (0.2f + 0.3f * random(i, 8));
        balls.push_back({ball.center + ball.radius * randomDirection(i), radius});
    }
    return balls;
}

/// The larger one, rounded where they differ by less than `width`.
float smoothMax(float a, float b, float width)
{
    const float t = std::clamp(0.5f + 0.5f * (a - b) / width, 0.0f, 1.0f);
    return b + t * (a - b) + width * t * (1.0f - t);
}

/// Where ice spreads below the tropopause: a disc that rises and thins outwards and drifts with the wind.
/// @return depth below its surface
float anvilDepth(const glm::vec3& p)
{
    const glm::vec3 q((p.x - 17.0f) / 48.0f, p.y - kAnvil, p.z / 32.0f);
    const float distance = std::sqrt(q.x * q.x + q.z * q.z);
    const float half = 5.5f * (1.0f - distance) * (1.0f - distance) + 1.4f;
    return std::min(half - std::abs(q.y - 3.5f * distance), 20.0f * (1.0f - distance));
}

/// Share of the extinction of droplets, by position.
class Cloud
{
public:
    float at(const glm::vec3& p) const
    {
        const glm::vec3 q = p + 3.5f * glm::vec3(warp_[0].at(p), warp_[1].at(p), warp_[2].at(p));
        float depth = -kFarthest;
        for (const Ball& ball : balls_) {
            const glm::vec3 from = q - ball.center;
            const float reach = ball.radius + kFarthest;
            if (glm::dot(from, from) < reach * reach)
                depth = smoothMax(depth, ball.radius - glm::length(from), 1.2f);
        }
        depth = smoothMax(depth, anvilDepth(q), 9.0f);
        depth = std::min(depth, 1.5f * (0.3f * q.y + 0.7f * p.y - kBase)); // vapor condenses at the base
        const float ice = std::clamp((p.y - kAnvil + 7.0f) / 6.0f, 0.0f, 1.0f);
        const glm::vec3 fibers(0.2f * p.x, p.y, 0.6f * p.z); // along the wind
        depth += (1.0f - ice) * 2.25f * lumps_.at(p) + ice * 2.0f * lumps_.at(fibers);
        const float share = std::clamp(depth / 2.5f, 0.0f, 1.0f);
        return share < 0.02f ? 0.0f : share * (1.0f - (1.0f - kIce) * ice);
    }

private:
    std::vector<Ball> balls_ = towers();
    sim::BlockNoise warp_[3] = {{100, 9.0f, 3}, {110, 9.0f, 3}, {120, 9.0f, 3}}, lumps_{300, 5.0f, 3};
};

base::VoxelVolume thunderhead()
{
    constexpr int kVoxels = base::kVolumeBrickSide;
    const Cloud cloud;
    base::VoxelVolume volume;
    volume.side = kSide;
    volume.origin = glm::vec3((kLow - 1) * kVoxels) * kSide;
    volume.evenAlbedo = glm::vec3(0.99f);
    for (int z = kLow.z; z < kHigh.z; ++z)
        for (int y = kLow.y; y < kHigh.y; ++y)
            for (int x = kLow.x; x < kHigh.x; ++x) {
                const glm::ivec3 brick(x, y, z);
                std::vector<float> values;
                for (int k = 0; k < kVoxels; ++k)
                    for (int j = 0; j < kVoxels; ++j)
                        for (int i = 0; i < kVoxels; ++i)
                            values.push_back(kExtinction *
                                             cloud.at(glm::vec3(brick * kVoxels + glm::ivec3(i, j, k))));
                if (std::ranges::none_of(values, [](float v) { return v > 0.0f; }))
                    continue;
                volume.bricks.push_back(brick - kLow + 1);
                volume.extinction.insert(volume.extinction.end(), values.begin(), values.end());
            }
    return volume;
}

} // namespace

int main(int count, char** arguments)
{
    const auto bytes = asset::writeVolume(thunderhead());
    if (count != 2 || !bytes) {
        std::fprintf(stderr, "make_thunderhead OUT.fxvolume: %s\n",
                     bytes ? "needs one argument" : bytes.status().message().c_str());
        return 1;
    }
    std::ofstream file(arguments[1], std::ios::binary);
    file << *bytes;
    return file.flush() ? 0 : 1;
}
