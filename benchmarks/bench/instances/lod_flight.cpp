#include "benchmarks/bench/instances/lod_flight.h"

#include <algorithm>
#include <iterator>

namespace fx::cli {
namespace {

constexpr double kFlown = 2.0;      ///< [pixel] by which the nearest effects move a frame
constexpr uint32_t kHardFrames = 4; ///< between switches

/// How much nearer a frame of the flight comes, so that what is seen moves by kFlown pixels at the edge.
double approach(int pixels)
{
    constexpr double kSlopePixels = 1.37; ///< [1] of the picture's width: BenchScene::look()
    return 1.0 - kFlown / (kLodWidest * kSlopePixels * pixels);
}

/// Whether any level or picture differs from the frame before.
bool hasChanged(const FxViewStatistics& now, const FxViewStatistics& before)
{
    return now.impostorsTaken > 0 || now.impostors != before.impostors ||
           now.blobsThinned != before.blobsThinned ||
           !std::equal(std::begin(now.lodGroups), std::end(now.lodGroups), std::begin(before.lodGroups));
}

base::Status drawOne(BenchScene& scene, std::vector<float>& outPicture)
{
    scene.clear();
    if (base::Status status = scene.draw(); !status)
        return status;
    outPicture = scene.picture();
    return {};
}

} // namespace

bool isSmall(const LodFlight& flight)
{
    return flight.pop.p99() <= kLodPopP99 && flight.pop.largest() <= kMaxLodPop * flight.pop.motionLargest();
}

FxViewSettings lodSettings(const LodCase& what)
{
    FxViewSettings settings = fxDefaultViewSettings();
    settings.dazzle = 0;
    for (int i = 0; i < 3; ++i) {
        settings.sunIlluminance[i] = 60'000.0f;
        settings.skyLuminance[i] = 3'000.0f;
    }
    settings.lodBias = what.bias;
    settings.lodImpostorPixels = what.impostorPixels;
    return settings;
}

uint32_t warmFrames(const LodCase& what)
{
    return what.impostorPixels > 0 ? 30 : 1;
}

base::Status drawStill(BenchScene& scene, const LodCase& what, std::vector<float>& outPicture)
{
    for (uint32_t i = 0; i < warmFrames(what); ++i) {
        scene.clear();
        if (base::Status status = scene.draw(); !status)
            return status;
    }
    outPicture = scene.picture();
    return {};
}

base::Status fly(BenchScene& scene, const LodFlightRules& rules, const LodCase& what,
                 std::vector<std::vector<float>>& ioWithout, LodFlight& outFlight)
{
    const bool isFirst = ioWithout.empty();
    std::vector<float> before;
    scene.moveTo(0.0, kLodEyeHeight, 0.0);
    if (base::Status status = drawStill(scene, what, before); !status || rules.frames == 0)
        return status;
    double distance = kLodNearest;
    for (uint32_t i = 0; i < rules.frames; ++i, distance *= approach(rules.pixels)) {
        scene.moveTo(0.0, kLodEyeHeight, distance - kLodNearest);
        std::vector<float> held;
        scene.holdDetail(true);
        if (base::Status status = drawOne(scene, held); !status)
            return status;
        scene.holdDetail(false);
        const FxViewStatistics last = scene.viewStatistics();
        if (what.isHard && i % kHardFrames == 0)
            if (base::Status status = scene.setView(lodSettings(i / kHardFrames % 2 == 0 ? LodCase{} : what));
                !status)
                return status;
        std::vector<float> picture;
        if (base::Status status = drawOne(scene, picture); !status)
            return status;
        if (i > 0) {
            const int pixels = rules.pixels;
            if (isFirst)
                ioWithout.push_back(blockChanges(picture, before, pixels, pixels));
            outFlight.pop.add(blockChanges(picture, held, pixels, pixels), ioWithout[i - 1]);
            outFlight.changedFrames += hasChanged(scene.viewStatistics(), last) ? 1 : 0;
        }
        before = std::move(picture);
    }
    return {};
}

} // namespace fx::cli
