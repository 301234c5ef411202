#include "fxsdk/cli/scene/preview_ground.h"

#include "foundation/random/philox.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fx::cli {
namespace {

constexpr glm::vec3 kSoil(0.235f, 0.212f, 0.178f);
constexpr glm::vec3 kDryGrass(0.205f, 0.19f, 0.13f);
constexpr glm::vec3 kDamp(0.125f, 0.112f, 0.092f);
constexpr glm::vec3 kLeaves(0.062f, 0.07f, 0.05f);
constexpr glm::vec3 kHaze(0.4f, 0.44f, 0.49f); ///< of the air in front of what is far away, as an albedo
constexpr float kHazeLength = 2500.0f;         ///< [m] over which air hides all but 1/e
constexpr float kFields = 90.0f;               ///< [m] from where on the ground is grass
constexpr float kHorizon = 2400.0f;            ///< [m] half of the ground's side
constexpr float kHills = 1500.0f;              ///< [m] distance of the foot of wooded hills
constexpr float kHillDepth = 500.0f; ///< [m] from their foot to their top: too flat to shade themselves
constexpr int kHillSteps = 1440;     ///< around the horizon

/// A square ring of cells.
struct Ring
{
    float inner, outer, cell; ///< [m] half sides, multiples of the cell
};
constexpr Ring kRings[] = {{0, 20, 0.4f}, {20, 60, 2}, {60, 180, 10}, {180, kHorizon, 60}};

float valueAt(int x, int z, uint32_t octave)
{
    return base::toUnitFloat(base::philox({uint32_t(x), uint32_t(z), octave, 0}, 0x5011)[0]);
}

/// Smooth noise between 0 and 1 of this period.
float noise(const glm::vec2& p, float period, uint32_t octave)
{
    const glm::vec2 place = p / period, low = glm::floor(place);
    const glm::vec2 part = glm::smoothstep(glm::vec2(0.0f), glm::vec2(1.0f), place - low);
    const int x = int(low.x), z = int(low.y);
    const float near = glm::mix(valueAt(x, z, octave), valueAt(x + 1, z, octave), part.x);
    const float far = glm::mix(valueAt(x, z + 1, octave), valueAt(x + 1, z + 1, octave), part.x);
    return glm::mix(near, far, part.y);
}

/// Color of something at this distance from the middle.
glm::vec3 hazed(const glm::vec3& color, float distance)
{
    return glm::mix(kHaze, color, std::exp(-distance / kHazeLength));
}

glm::vec3 groundColor(const glm::vec2& p)
{
    const float away = glm::length(p);
    const float wide = noise(p, 31.0f, 0), middle = noise(p, 9.0f, 1), small = noise(p, 2.3f, 2);
    const float grain = noise(p, 0.4f, 3);
    const float grass = std::clamp(3.0f * (0.6f * wide + 0.4f * middle) - 1.3f + away / kFields, 0.0f, 1.0f);
    const float damp = std::clamp(3.0f * (0.5f * middle + 0.5f * small) - 1.8f, 0.0f, 0.6f);
    glm::vec3 color = glm::mix(glm::mix(kSoil, kDryGrass, grass), kDamp, damp);
    color *= 1.0f + 0.22f * (small - 0.5f) + 0.3f * (grain - 0.5f);
    return hazed(color, away);
}

void addTriangle(render::StageMesh& mesh, const glm::vec3 (&corners)[3], const glm::vec3 (&colors)[3])
{
    for (int i = 0; i < 3; ++i) {
        mesh.positions.push_back(corners[i]);
        mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
        mesh.colors.push_back(colors[i]);
    }
}

void addCell(render::StageMesh& mesh, const glm::vec2& low, float side)
{
    const glm::vec2 places[] = {low + glm::vec2(0, side), low + side, low + glm::vec2(side, 0), low};
    glm::vec3 corners[4], colors[4];
    for (int i = 0; i < 4; ++i) {
        corners[i] = {places[i].x, 0.0f, places[i].y};
        colors[i] = groundColor(places[i]);
    }
    addTriangle(mesh, {corners[0], corners[1], corners[2]}, {colors[0], colors[1], colors[2]});
    addTriangle(mesh, {corners[0], corners[2], corners[3]}, {colors[0], colors[2], colors[3]});
}

void addRing(render::StageMesh& mesh, const Ring& ring)
{
    const int count = int(std::lround(2.0f * ring.outer / ring.cell));
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
            const glm::vec2 low = glm::vec2(i, j) * ring.cell - ring.outer;
            const glm::vec2 middle = glm::abs(low + 0.5f * ring.cell);
            if (std::max(middle.x, middle.y) > ring.inner)
                addCell(mesh, low, ring.cell);
        }
}

/// [m] Height of the hills at a place around the horizon.
float hillHeight(float turn)
{
    const glm::vec2 place = kHills * glm::vec2(std::cos(2.0f * std::numbers::pi_v<float> * turn),
                                               std::sin(2.0f * std::numbers::pi_v<float> * turn));
    return 14.0f + 40.0f * noise(place, 430.0f, 4) + 10.0f * noise(place, 80.0f, 5) +
           5.0f * noise(place, 23.0f, 6);
}

void addHills(render::StageMesh& mesh)
{
    const auto outwards = [](int i) {
        const float angle = 2.0f * std::numbers::pi_v<float> * float(i) / float(kHillSteps);
        return glm::vec3(std::cos(angle), 0.0f, std::sin(angle));
    };
    const auto top = [&](int i) {
        const float height = hillHeight(float(i % kHillSteps) / float(kHillSteps));
        return (kHills + kHillDepth) * outwards(i) + glm::vec3(0.0f, height, 0.0f);
    };
    const glm::vec3 low = hazed(kLeaves, kHills), high = hazed(kLeaves, 1.7f * kHills);
    for (int i = 0; i < kHillSteps; ++i) {
        const glm::vec3 a = kHills * outwards(i), b = kHills * outwards(i + 1);
        addTriangle(mesh, {a, b, top(i + 1)}, {low, low, high});
        addTriangle(mesh, {a, top(i + 1), top(i)}, {low, high, high});
    }
}

} // namespace

void addPreviewGround(render::StageMesh& mesh)
{
    for (const Ring& ring : kRings)
        addRing(mesh, ring);
    addHills(mesh);
}

} // namespace fx::cli
