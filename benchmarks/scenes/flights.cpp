#include "benchmarks/scenes/flights.h"

#include "benchmarks/scenes/chance.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/render/reference_scene.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "rendering/reference/blob_medium/blob_medium.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fx::cli {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFrameSeconds = 1.0 / 60.0;
constexpr double kFarAway = 1e4; ///< [m] on the way to the sun

/// Where an eye goes, in radii of the media around their middle.
enum class Motion
{
    Orbit,    ///< around them
    Through,  ///< straight through the middle
    Approach, ///< from outside to near the middle
    Rise,     ///< upwards beside them
    Turn      ///< stays among them and looks around
};

enum class Media
{
    Smoke,
    Fireball,
    Overlap, ///< both, each an instance of its own
    Balls    ///< two instances of a few large balls that lie in each other, one dark and one bright
};

struct EffectFlight
{
    FlightName name;
    Media media;
    Motion motion;
    uint64_t seed;
};

constexpr uint32_t kEffectFrames = 60, kLightFrames = 721;
constexpr FlightSubject kComposition = FlightSubject::Composition, kLight = FlightSubject::Light;
constexpr std::array<EffectFlight, 11> kEffectFlights{{
    {{"smoke-orbit", kComposition, kEffectFrames}, Media::Smoke, Motion::Orbit, 1},
    {{"smoke-through", kComposition, kEffectFrames}, Media::Smoke, Motion::Through, 2},
    {{"smoke-rise", kComposition, kEffectFrames}, Media::Smoke, Motion::Rise, 3},
    {{"fireball-orbit", kComposition, kEffectFrames}, Media::Fireball, Motion::Orbit, 4},
    {{"fireball-through", kComposition, kEffectFrames}, Media::Fireball, Motion::Through, 5},
    {{"fireball-approach", kComposition, kEffectFrames}, Media::Fireball, Motion::Approach, 6},
    {{"overlap-orbit", kComposition, kEffectFrames}, Media::Overlap, Motion::Orbit, 7},
    {{"overlap-through", kComposition, kEffectFrames}, Media::Overlap, Motion::Through, 8},
    {{"overlap-rise", kComposition, kEffectFrames}, Media::Overlap, Motion::Rise, 9},
    {{"overlap-turn", kComposition, kEffectFrames}, Media::Overlap, Motion::Turn, 10},
    {{"balls-orbit", kComposition, kEffectFrames, true}, Media::Balls, Motion::Orbit, 11},
}};

enum class Sweep
{
    Light, ///< the sun once around the vertical
    Across,
    Into
};

struct LightFlight
{
    FlightName name;
    Sweep sweep;
    uint64_t seed;
};

constexpr std::array<LightFlight, 3> kLightFlights{{
    {{"light-sweep", kLight, kLightFrames}, Sweep::Light, 12},
    {{"light-dolly-across", kLight, kLightFrames}, Sweep::Across, 13},
    {{"light-dolly-into", kLight, kLightFrames}, Sweep::Into, 14},
}};

/// A ball around most of the media.
struct MediaExtent
{
    glm::dvec3 middle{0.0}; ///< [m]
    double radius = 1.0;    ///< [m]
};

MediaExtent extentOf(const std::vector<render::MediumBlob>& blobs)
{
    MediaExtent extent;
    double weight = 0.0, square = 0.0;
    for (const render::MediumBlob& blob : blobs) {
        extent.middle += blob.crossSection * blob.center;
        weight += blob.crossSection;
    }
    extent.middle /= std::max(weight, 1e-30);
    for (const render::MediumBlob& blob : blobs) {
        const glm::dvec3 d = blob.center - extent.middle;
        square += blob.crossSection * (glm::dot(d, d) + blob.radius * blob.radius);
    }
    extent.radius = 1.5 * std::sqrt(square / std::max(weight, 1e-30));
    return extent;
}

/// @param s 0 at the beginning of the flight, 1 at its end
LitView viewAt(const EffectFlight& flight, const MediaExtent& extent, double s)
{
    bench::Chance chance(flight.seed);
    const double turn = chance.between(0.0, 2.0 * kPi);
    const glm::dvec3 side(std::cos(turn), 0.0, std::sin(turn)), across(-side.z, 0.0, side.x);
    const double height = chance.between(-0.2, 0.3);
    const double t = 2.0 * s - 1.0;
    glm::dvec3 eye(0.0), target(0.0); // in radii
    switch (flight.motion) {
    case Motion::Orbit:
        eye = 1.8 * (std::cos(0.3 * t) * side + std::sin(0.3 * t) * across) + glm::dvec3(0.0, height, 0.0);
        break;
    case Motion::Through:
        eye = -0.4 * t * side + 0.1 * across + glm::dvec3(0.0, 0.3 * height, 0.0);
        target = eye - side + glm::dvec3(0.0, 0.1, 0.0);
        break;
    case Motion::Approach:
        eye = (1.3 - 0.5 * t) * side + glm::dvec3(0.0, height, 0.0);
        break;
    case Motion::Rise:
        eye = 1.4 * side + glm::dvec3(0.0, height + 0.4 * t, 0.0);
        break;
    case Motion::Turn:
        eye = 0.5 * side + glm::dvec3(0.0, 0.2 * height, 0.0);
        target = eye - std::cos(0.4 * t) * side - std::sin(0.4 * t) * across;
        break;
    }
    LitView view;
    view.eye = extent.middle + extent.radius * eye;
    view.target = extent.middle + extent.radius * target;
    view.fovYDegrees = 50.0;
    view.lighting = {};
    view.lighting.sunIlluminance = glm::vec3(0.0f);
    view.lighting.groundAlbedo = 0.0f;
    view.exposureEv100 = flight.media == Media::Smoke || flight.media == Media::Balls ? 13.0f : 15.0f;
    return view;
}

base::Status addPreset(const std::string& name, scene_file::SceneFile& io)
{
    const auto other = sceneOfPreset("library:" + name);
    if (!other.ok())
        return other.status();
    for (scene_file::SceneInstance instance : other->instances) {
        instance.preset += io.presets.size();
        io.instances.push_back(std::move(instance));
    }
    io.presets.insert(io.presets.end(), other->presets.begin(), other->presets.end());
    return {};
}

/// Smoke that has risen for some seconds, and an explosion that has grown to a fireball.
base::Result<scene_file::SceneFile> sceneOf(const EffectFlight& flight, double& outTime)
{
    constexpr double kSmoke = 5.0, kFireball = 0.5;
    outTime = flight.media == Media::Fireball ? kFireball : kSmoke;
    auto scene =
        sceneOfPreset(flight.media == Media::Fireball ? "library:explosion" : "library:smoke-column");
    if (!scene.ok() || flight.media != Media::Overlap)
        return scene;
    const size_t first = scene->instances.size();
    if (base::Status status = addPreset("explosion", *scene); !status)
        return status;
    for (size_t i = first; i < scene->instances.size(); ++i) {
        scene->instances[i].start = kSmoke - kFireball;
        scene->instances[i].position += glm::dvec3(0.5, 1.0, 0.0);
    }
    return scene;
}

/// Each blob sends what it scatters of sun and sky.
void lightInCenters(std::vector<render::MediumBlob>& io)
{
    const render::Lighting sky = daylight();
    std::vector<render::Blob> balls;
    for (const render::MediumBlob& blob : io)
        balls.push_back({blob.center, blob.radius, blob.crossSection, glm::dvec3(0.0)});
    const render::BlobMedium medium(std::move(balls));
    for (render::MediumBlob& blob : io) {
        const render::Ray ray{blob.center, glm::normalize(glm::dvec3(sky.sunDirection))};
        const double passes = std::exp(-medium.opticalDepth(ray, 0.0, kFarAway));
        const glm::dvec3 sun = glm::dvec3(sky.sunIlluminance) * (passes / (4.0 * kPi));
        blob.source += blob.albedo * (sun + 0.3 * glm::dvec3(sky.skyLuminance));
        blob.albedo = glm::dvec3(0.0);
    }
}

std::vector<render::MediumBlob> darkAndBrightBalls(uint64_t seed)
{
    constexpr uint32_t kBalls = 16;
    bench::Chance chance(seed);
    std::vector<render::MediumBlob> blobs;
    for (uint32_t b = 0; b < kBalls; ++b) {
        render::MediumBlob blob;
        blob.center = 0.8 * chance.inCube();
        blob.radius = 1.0;
        blob.crossSection = 3.0;
        blob.source = b % 2 == 0 ? glm::dvec3(4000.0) : glm::dvec3(100.0); // [cd/m2]
        blob.instance = 1 + b % 2;
        blobs.push_back(blob);
    }
    return blobs;
}

std::vector<FlightFrame> ballFrames(const EffectFlight& flight, uint32_t frames)
{
    const std::vector<render::MediumBlob> blobs = darkAndBrightBalls(flight.seed);
    const MediaExtent extent = extentOf(blobs);
    std::vector<FlightFrame> all;
    for (uint32_t k = 0; k < frames; ++k)
        all.push_back(
            {blobs, viewAt(flight, extent,
                           double((flight.name.frames - frames) / 2 + k) / double(flight.name.frames - 1))});
    return all;
}

base::Result<std::vector<FlightFrame>> effectFrames(const EffectFlight& flight, uint32_t frames)
{
    double time = 0.0;
    const auto scene = sceneOf(flight, time);
    if (!scene.ok())
        return scene.status();
    auto source = ReferenceSceneSource::create(*scene, {});
    if (!source.ok())
        return source.status();
    const uint32_t first = (flight.name.frames - frames) / 2;
    std::vector<FlightFrame> all;
    MediaExtent extent;
    for (uint32_t k = 0; k < frames; ++k) {
        auto moment = (*source)->frameAt(base::toTicks(time + double(first + k) * kFrameSeconds));
        if (!moment.ok())
            return moment.status();
        if (k == 0)
            extent = extentOf(moment->scene.blobs);
        FlightFrame frame{std::move(moment->scene.blobs),
                          viewAt(flight, extent, double(first + k) / double(flight.name.frames - 1))};
        lightInCenters(frame.blobs);
        all.push_back(std::move(frame));
    }
    return all;
}

/// A cloud of large balls that circle in it.
void addCloud(const glm::dvec3& middle, double spin, bench::Chance& chance,
              std::vector<render::MediumBlob>& io)
{
    constexpr uint32_t kBalls = 26;
    const uint64_t instance = io.empty() ? 1 : io.back().instance + 1;
    for (uint32_t b = 0; b < kBalls; ++b) {
        const glm::dvec3 place = glm::dvec3(5.0, 2.5, 5.0) * chance.inCube();
        render::MediumBlob blob;
        blob.center = middle + glm::dvec3(place.x * std::cos(spin) - place.z * std::sin(spin), place.y,
                                          place.x * std::sin(spin) + place.z * std::cos(spin));
        blob.radius = chance.between(1.6, 2.8);
        blob.crossSection = 0.6 * blob.radius * blob.radius;
        blob.albedo = glm::dvec3(0.9);
        blob.anisotropy = 0.3;
        blob.instance = instance;
        io.push_back(blob);
    }
}

/// Clouds over more than 40 m, where the sun's planes are so coarse that the neighborhood of the eye gets its
/// own, and small balls that fly to and fro far outside of the picture, so that the extent of the media,
/// which planes are fitted to, is another one in each frame.
std::vector<render::MediumBlob> clouds(uint64_t seed, double seconds)
{
    constexpr uint32_t kClouds = 6, kFliers = 6;
    bench::Chance chance(seed);
    std::vector<render::MediumBlob> blobs;
    for (uint32_t c = 0; c < kClouds; ++c) {
        const double turn = kPi * (1.0 + (double(c) + 0.5) / double(kClouds)); // before the eye
        const double away = chance.between(8.0, 24.0), drift = 0.1 * chance.between(-1.0, 1.0) * seconds;
        addCloud({away * std::cos(turn), chance.between(3.0, 6.0), away * std::sin(turn)}, drift, chance,
                 blobs);
    }
    for (uint32_t f = 0; f < kFliers; ++f) {
        const double turn = 2.0 * kPi * (double(f) + 0.5) / double(kFliers), pace = chance.between(2.0, 3.0);
        const double away = 54.0 + 10.0 * std::sin(pace * seconds + chance.between(0.0, 2.0 * kPi));
        render::MediumBlob blob;
        blob.center = {away * std::cos(turn), 5.0 + 4.0 * std::sin(1.3 * pace * seconds),
                       away * std::sin(turn)};
        blob.radius = 0.5;
        blob.crossSection = 0.1;
        blob.albedo = glm::dvec3(0.9);
        blob.anisotropy = 0.3;
        blob.instance = kClouds + 1;
        blobs.push_back(blob);
    }
    return blobs;
}

FlightFrame lightFrame(const LightFlight& flight, uint32_t k)
{
    const double seconds = double(k) * kFrameSeconds, s = double(k) / double(flight.name.frames - 1);
    FlightFrame frame{clouds(flight.seed, seconds), {}};
    LitView& view = frame.view;
    view.eye = {0.0, 5.0, 6.0};
    view.target = {0.0, 4.5, -10.0};
    double turn = 0.7;
    switch (flight.sweep) {
    case Sweep::Light:
        turn = 2.0 * kPi * s;
        break;
    case Sweep::Across:
        view.eye += glm::dvec3(12.0 * (s - 0.5), 0.0, 0.0);
        view.target.x += 12.0 * (s - 0.5);
        break;
    case Sweep::Into:
        view.eye.z += -12.0 * s;
        view.target.z += -12.0 * s;
        break;
    }
    view.fovYDegrees = 60.0;
    view.lighting = daylight();
    view.lighting.sunDirection = glm::normalize(glm::vec3(std::cos(turn), 0.5, std::sin(turn)));
    view.lighting.skyLuminance = glm::vec3(0.0f);
    view.lighting.groundAlbedo = 0.0f;
    view.exposureEv100 = 13.0f;
    return frame;
}

} // namespace

std::span<const FlightName> flightNames()
{
    static const std::vector<FlightName> kNames = [] {
        std::vector<FlightName> names;
        for (const EffectFlight& flight : kEffectFlights)
            names.push_back(flight.name);
        for (const LightFlight& flight : kLightFlights)
            names.push_back(flight.name);
        return names;
    }();
    return kNames;
}

base::Result<std::vector<FlightFrame>> flightFrames(std::string_view name, uint32_t frames)
{
    for (const EffectFlight& flight : kEffectFlights)
        if (flight.name.name == name) {
            const uint32_t count = std::min(frames, flight.name.frames);
            if (flight.media == Media::Balls)
                return ballFrames(flight, count);
            return effectFrames(flight, count);
        }
    for (const LightFlight& flight : kLightFlights) {
        if (flight.name.name != name)
            continue;
        const uint32_t count = std::min(frames, flight.name.frames);
        std::vector<FlightFrame> all;
        for (uint32_t k = 0; k < count; ++k)
            all.push_back(lightFrame(flight, (flight.name.frames - count) / 2 + k));
        return all;
    }
    return base::Status(base::Code::InvalidArgument, "no such flight");
}

} // namespace fx::cli
