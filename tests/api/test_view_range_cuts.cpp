// Where ranges of depth cut media: in orthographic views, with ranges left out, and behind thick media.
#include "tests/api/view_ranges_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

using namespace fx::test;
using ViewRangeCuts = ViewRangesTest;

namespace {

/// Parallel rays. @param halfHeight [m] of the picture
FxFrameDef parallel(FxFrameDef def, float halfHeight)
{
    constexpr float kFar = 100.0f; // [m]
    std::fill_n(def.projection, 16, 0.0f);
    def.projection[0] = def.projection[5] = 1.0f / halfHeight;
    def.projection[10] = -2.0f / kFar; // the near plane is in the eye
    def.projection[14] = -1.0f;
    def.projection[15] = 1.0f;
    return def;
}

/// Balls of one size around a place on the z axis. @param z [m]
std::string balls(double z, double opticalDepth, int count)
{
    return R"({"layer": "smoke", "shape": "sphere", "size": 0.5, "position": [0, 0.8, )" + std::to_string(z) +
           R"(], "emission": {"bursts": [{"time": 0, "count": )" + std::to_string(count) +
           R"(}]}, "lifetime": 9, "speed": 0, "radius": 0.4, "opticalDepth": )" +
           std::to_string(opticalDepth) + R"(, "forces": {"gravity": 0}})";
}

std::string presetOf(const std::string& emitters)
{
    return R"({"version": 1, "emitters": [)" + emitters + "]}";
}

} // namespace

TEST_F(ViewRangeCuts, ofParallelRaysAddUpToTheWholePicture)
{
    for (const auto& [cut, composition] :
         {std::pair(kCampfire, FX_COMPOSITION_SORTED), std::pair(kCampfire, FX_COMPOSITION_SLABS),
          std::pair(kCampfire, FX_COMPOSITION_VOLUME)})
    {
        SCOPED_TRACE(std::string(cut.preset) + ", composition " + std::to_string(composition));
        FxView* const view = show(cut, composition);
        const FxFrameDef def = parallel(eye(cut), 1.2f);
        const std::vector<float> wanted = whole(view, def, kBackground);
        const std::vector<float> ranges = inRanges(view, cut, def, kBackground);
        std::printf("parallel, composition %d: ranges differ by %.2f/255 at most\n", int(composition),
                    double(largestShownDifference(ranges, wanted) / kStep));
        EXPECT_LE(largestShownDifference(ranges, wanted), kStep);
        clear(kBackground);
        render(view, def, FX_RANGE_ONLY, cut.ends[1], kEndless);
        EXPECT_GT(largestShownDifference(picture(), wanted), 8.0f * kStep);
        hide(view);
    }
}

TEST_F(ViewRangeCuts, ofARangeLeftOutLeaveTheOthersAsTheyAre)
{
    for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS, FX_COMPOSITION_VOLUME}) {
        SCOPED_TRACE(composition);
        FxView* const view = show(kCampfire, composition);
        FxViewSettings settings = sunny(composition);
        settings.shimmerStrength = 0.0f; // the last call bends the picture
        ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
        const FxFrameDef def = eye(kCampfire);
        const auto& ends = kCampfire.ends;
        const auto nearest = [&](bool withMiddle, float background) {
            render(view, def, FX_RANGE_FIRST, ends[1], kEndless);
            if (withMiddle)
                render(view, def, FX_RANGE_NEXT, ends[0], ends[1]);
            clear(background);
            render(view, def, FX_RANGE_LAST, 0.0f, ends[0]);
            return picture();
        };
        for (const float background : {0.0f, 1.0f}) {
            const std::vector<float> picture = nearest(false, background);
            EXPECT_LE(largestShownDifference(picture, nearest(true, background)), kStep);
            EXPECT_GT(largestShownDifference(picture, std::vector<float>(picture.size(), background)),
                      8.0f * kStep); // there is something
        }
        hide(view);
    }
}

TEST_F(ViewRangeCuts, showWhatLiesBehindThickMediaAsIfTheyWereNotThere)
{
    const Cut cut{"balls", 4.0, 0.8, 2, {}};
    constexpr float kBetween = 4.0f; // [m] the wall ends 0.1 m before it, the veil begins 0.1 m behind
    const std::string wall = balls(1.0, 5.0, 60), veil = balls(-1.0, 0.1, 20);
    for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS, FX_COMPOSITION_VOLUME}) {
        SCOPED_TRACE(composition);
        FxViewSettings settings = sunny(composition);
        settings.shimmerStrength = 0.0f;
        settings.voxels = 128;
        const auto through = [&](const std::string& emitters, float from) {
            FxView* const view = showPreset(loadText(context_, presetOf(emitters)), cut.updates, settings);
            std::array<std::vector<float>, 2> over; // black, white
            for (const int white : {0, 1}) {
                clear(float(white));
                render(view, eye(cut), FX_RANGE_ONLY, from, kEndless);
                over[size_t(white)] = picture();
            }
            hide(view);
            return transmittance(over[0], over[1]);
        };
        // a wall that is not seen, so that voxels lie at the same places
        const std::vector<float> alone = through(veil + ", " + balls(1.0, 1e-5, 60), 0.0f);
        const std::vector<float> behind = through(veil + ", " + wall, kBetween);
        const float difference = largestShownDifference(alone, behind);
        std::printf("composition %u: what is behind a wall differs by %.2f/255 at most\n", composition,
                    double(difference / kStep));
        EXPECT_LE(difference, kStep);
        EXPECT_LT(*std::min_element(alone.begin(), alone.end()), 0.8f);
        const std::vector<float> whole = through(veil + ", " + wall, 0.0f);
        EXPECT_LT(*std::min_element(whole.begin(), whole.end()), 0.001f); // a wall
    }
}
