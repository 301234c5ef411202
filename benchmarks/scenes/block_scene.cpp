#include "benchmarks/scenes/block_scene.h"

#include "foundation/random/philox.h"

#include <glm/geometric.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace fx::cli {
namespace {

constexpr double kDistance = 100.0;             // [m] from the camera to the middle of the blocks
constexpr double kDepth = 20.0;                 // [m] half the extent of the blocks along the view
constexpr double kHalfField = 0.4;              // [1] tangent of half the vertical field of view
constexpr double kShareX = 0.8, kShareY = 0.65; // of the picture that blocks fill: about half
constexpr uint32_t kTypes = 4;
constexpr const char* kStandIn = "ball of "; ///< and the name of the type that it stands for
constexpr double kReach = 1.1;   ///< [1] of a block on the picture, which is wider beside the middle
constexpr double kSpread = 0.82; // [block radius] within which the centers of balls lie

std::array<float, 4> random(uint32_t stream, uint64_t number)
{
    return base::randomUnit4(20261127, stream, number, base::RandomPurpose::Position);
}

/// Anywhere in a ball of radius 1.
glm::dvec3 inBall(uint32_t stream, uint64_t number)
{
    const auto u = random(stream, number);
    const double z = 2.0 * double(u[0]) - 1.0, turn = 2.0 * std::numbers::pi * double(u[1]);
    const double flat = std::sqrt(std::max(1.0 - z * z, 0.0));
    return std::cbrt(double(u[2])) * glm::dvec3(flat * std::cos(turn), flat * std::sin(turn), z);
}

/// Balls as in puffs: some ten lumps, each of many balls.
nlohmann::json ballsOf(uint32_t type, uint32_t count)
{
    constexpr uint32_t kLumps = 12;
    nlohmann::json balls = nlohmann::json::array();
    const double radius = 0.8 / std::cbrt(double(count)); // balls overlap about fourfold
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 lump = 0.55 * inBall(10 + type, i % kLumps);
        const glm::dvec3 place = kSpread * (lump + 0.45 * inBall(20 + type, i));
        const double size = radius * (0.7 + 0.6 * double(random(30 + type, i)[0]));
        balls.push_back({{"position", {place.x, place.y, place.z}},
                         {"radius", size},
                         {"opticalDepth", 3.0 * size},
                         {"albedo", {0.98, 0.98, 0.98}}});
    }
    return balls;
}

/// One ball instead of all balls of a block.
nlohmann::json standInFor(const nlohmann::json& balls)
{
    double reach = 0.0, sections = 0.0;
    for (const nlohmann::json& ball : balls) {
        const nlohmann::json& at = ball["position"];
        const double radius = ball["radius"];
        reach =
            std::max(reach, glm::length(glm::dvec3(double(at[0]), double(at[1]), double(at[2]))) + radius);
        sections += double(ball["opticalDepth"]) * radius * radius; // up to a factor that all balls have
    }
    nlohmann::json ball = balls.front();
    ball["position"] = {0.0, 0.0, 0.0};
    ball["radius"] = reach;
    ball["opticalDepth"] = sections / (reach * reach);
    return nlohmann::json::array({ball});
}

/// Whether a ball may cover a pixel of a part of the picture. @param center [m] relative to the camera
bool mayBeSeen(const glm::dvec3& center, double radius, const PictureWindow& window)
{
    const double perSlope = 0.5 * double(window.pictureHeight) / kHalfField; // [pixel]
    const double perMeter = perSlope / -center.z;
    const double reach = kReach * radius * perMeter + 2.0;
    const glm::dvec2 at = 0.5 * glm::dvec2(window.pictureWidth, window.pictureHeight) +
                          perMeter * glm::dvec2(center.x, center.y);
    const glm::dvec2 half = 0.5 * glm::dvec2(window.width, window.height);
    const glm::dvec2 off = glm::abs(at - glm::dvec2(window.x, window.y) - half);
    return off.x <= half.x + reach && off.y <= half.y + reach;
}

/// Blocks of balls that a block consists of, together of the cross section of one block of balls.
nlohmann::json partsOf(uint32_t type, uint32_t count, const std::string& part)
{
    const double scale = 0.97 / std::cbrt(double(count)); // parts overlap about as lumps do
    nlohmann::json parts = nlohmann::json::array();
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 place = (1.0 - scale) * inBall(40 + type, i);
        parts.push_back({{"type", part + std::to_string((type + i) % kTypes)},
                         {"position", {place.x, place.y, place.z}},
                         {"angleDegrees", 360.0 * double(random(50 + type, i)[0])},
                         {"scale", scale},
                         {"density", 1.0 / (double(count) * scale * scale)},
                         {"phase", 0.999 * double(random(50 + type, i)[1])}});
    }
    return parts;
}

nlohmann::json emitterOf(uint32_t count)
{
    constexpr double kShareOfLoop =
        0.9; // a frame of the loop has up to an eighth more than rate times lifetime
    const double radius = 0.8 / std::cbrt(double(count));
    return {{"maxParticles", 2 * count},
            {"shape", "sphere"},
            {"size", 0.6},
            {"emission", {{"rate", kShareOfLoop * double(count) / 2.0}}},
            {"lifetime", 2.0},
            {"speed", 0.1},
            {"radius", radius},
            {"opticalDepth", 3.0 * radius},
            {"forces", {{"gravity", 0}}},
            {"albedoOverLife", {0.98, 0.98, 0.98}}};
}

/// Types of blocks: of balls, and, where blocks have parts, of blocks. @param hasStandIns also those that
/// stand for types
nlohmann::json typesOf(const BlockSceneSize& size, bool hasStandIns)
{
    nlohmann::json types = nlohmann::json::array();
    for (uint32_t type = 0; type < kTypes; ++type) {
        nlohmann::json made = {{"name", "puff " + std::to_string(type)}};
        if (size.isMoving) {
            made["emitter"] = emitterOf(size.ballsPerPart);
            made["period"] = 2.0;
            made["frames"] = 8;
            made["seed"] = type + 1;
            made["phases"] = 4;
        } else {
            made["balls"] = ballsOf(type, size.ballsPerPart);
            if (hasStandIns)
                types.push_back(
                    {{"name", kStandIn + std::string(made["name"])}, {"balls", standInFor(made["balls"])}});
        }
        types.push_back(std::move(made));
    }
    if (size.partsPerBlock == 1)
        return types;
    for (uint32_t type = 0; type < kTypes; ++type)
        for (const char* kind : {"", kStandIn})
            if (*kind == 0 || hasStandIns)
                types.push_back({{"name", kind + ("heap " + std::to_string(type))},
                                 {"blocks", partsOf(type, size.partsPerBlock, kind + std::string("puff "))}});
    return types;
}

} // namespace

base::Result<scene_file::SceneFile> blockScene(const BlockSceneSize& size,
                                               const std::optional<PictureWindow>& window)
{
    const double aspect = double(size.width) / double(size.height);
    const double pixel = 2.0 * kHalfField * kDistance / double(size.height); // [m]
    const double radius = 0.5 * double(size.pixels) * pixel;
    nlohmann::json blocks = nlohmann::json::array();
    for (uint32_t i = 0; i < size.blocks; ++i) {
        const auto u = random(1, i), v = random(2, i);
        const double z = kDepth * (2.0 * double(u[2]) - 1.0);
        const double half = kHalfField * kDistance;
        const double x = kShareX * aspect * half * (2.0 * double(u[0]) - 1.0);
        const double y = kShareY * half * (2.0 * double(u[1]) - 1.0);
        const double scale = radius * (0.8 + 0.4 * double(u[3]));
        const bool isWhole = !window || mayBeSeen({x, y, z - kDistance}, scale, *window);
        const std::string type = (isWhole ? "" : kStandIn) +
                                 std::string(size.partsPerBlock > 1 ? "heap " : "puff ") +
                                 std::to_string(i % kTypes);
        blocks.push_back({{"type", type},
                          {"position", {x, y, z}},
                          {"angleDegrees", 360.0 * double(v[0])},
                          {"scale", scale},
                          {"phase", 0.999 * double(v[1])}});
    }
    const nlohmann::json preset = {{"version", 1},
                                   {"name", "blocks"},
                                   {"composition", "slabs"},
                                   {"blocks",
                                    {{{"layer", "smoke"},
                                      {"anisotropy", 0.4},
                                      {"maxParticles", 1048576},
                                      {"types", typesOf(size, window.has_value())},
                                      {"blocks", blocks}}}}};
    auto loaded = preset::loadPresetText(preset.dump(), "blocks.fx.json");
    if (!loaded.ok())
        return loaded.status();
    scene_file::SceneFile scene;
    scene.name = "blocks";
    scene.presets.push_back({"blocks", preset.dump(), "", loaded->effect});
    scene.instances.emplace_back();
    scene.background.luminance = {1600.0f, 2600.0f, 4600.0f};
    scene.background.horizon = {5200.0f, 5700.0f, 6100.0f};
    scene.view.lighting.sunDirection = glm::normalize(glm::vec3(0.75f, 0.5f, 0.45f));
    scene.view.lighting.sunIlluminance = {40000.0f, 34500.0f, 27000.0f};
    scene.view.lighting.skyLuminance = {2500.0f, 3150.0f, 4200.0f};
    scene.view.exposureEv100 = 13.0f;
    scene.view.composition = render::Composition::Slabs;
    scene.view.slabs = 16;
    scene.view.dazzle.enabled = false;
    scene.camera.position = {0.0, 0.0, kDistance};
    scene.camera.target = {0.0, 0.0, 0.0};
    scene.camera.fovYDegrees = float(2.0 * std::atan(kHalfField) * 180.0 / std::numbers::pi);
    return scene;
}

} // namespace fx::cli
