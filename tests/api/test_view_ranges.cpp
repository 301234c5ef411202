// Ranges of depth: their sum, what they share, and which calls are refused.
#include "tests/api/view_ranges_fixture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace fx::test;
using ViewRanges = ViewRangesTest;

namespace {

double meanDifference(const std::vector<float>& a, const std::vector<float>& b)
{
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += double(std::abs(std::min(a[i], 1.0f) - std::min(b[i], 1.0f)));
    return sum / double(a.size());
}

} // namespace

TEST_F(ViewRanges, overEachOtherAreTheWholePicture)
{
    for (const auto& [cut, composition] :
         {std::pair(kCampfire, FX_COMPOSITION_SORTED), std::pair(kCampfire, FX_COMPOSITION_SLABS),
          std::pair(kExplosion, FX_COMPOSITION_SLABS), std::pair(kExplosion, FX_COMPOSITION_VOLUME),
          std::pair(kCampfire, FX_COMPOSITION_VOLUME), std::pair(kDebris, FX_COMPOSITION_SLABS),
          std::pair(kCloud, FX_COMPOSITION_SLABS)})
    {
        SCOPED_TRACE(std::string(cut.preset) + ", composition " + std::to_string(composition));
        FxView* const view = show(cut, composition);
        const FxFrameDef def = eye(cut);
        const std::vector<float> wanted = whole(view, def, kBackground);
        const std::vector<float> ranges = inRanges(view, cut, kBackground);
        std::printf("%s, composition %d: ranges differ by %.2f/255 at most\n", cut.preset, int(composition),
                    fx::test::largestShownDifference(ranges, wanted) / kStep);
        EXPECT_LE(fx::test::largestShownDifference(ranges, wanted), kStep);
        clear(kBackground);
        render(view, def, FX_RANGE_ONLY, cut.ends[1], kEndless);
        EXPECT_GT(fx::test::largestShownDifference(picture(), wanted),
                  8.0f * kStep); // the others have a part of it
        hide(view);
    }
}

TEST_F(ViewRanges, hideTheBackgroundAsTheWholePictureDoes)
{
    FxView* const view = show(kCampfire, FX_COMPOSITION_SORTED);
    FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    settings.shimmerStrength = 0.0f;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    const FxFrameDef def = eye(kCampfire);
    const auto throughWhole = transmittance(whole(view, def, 0.0f), whole(view, def, 1.0f));
    const auto throughRanges =
        transmittance(inRanges(view, kCampfire, 0.0f), inRanges(view, kCampfire, 1.0f));
    EXPECT_LE(fx::test::largestShownDifference(throughRanges, throughWhole), kStep);
    EXPECT_LT(*std::min_element(throughWhole.begin(), throughWhole.end()), 0.9f); // there is smoke
}

TEST_F(ViewRanges, areCutByOpticalDepthInSlabsToo)
{
    // Sorted balls are cut one by one, where the integral of the kernel says.
    FxView* const view = show(kCampfire, FX_COMPOSITION_SORTED);
    const FxFrameDef def = eye(kCampfire);
    for (const bool isAlone : {true, false})
        for (const float end : {2.8f, 3.0f, 3.2f}) {
            SCOPED_TRACE(std::to_string(end) + (isAlone ? " alone" : " of two"));
            std::array<std::vector<float>, 2> through;
            for (const uint32_t composition : {FX_COMPOSITION_SORTED, FX_COMPOSITION_SLABS}) {
                FxViewSettings settings = sunny(composition);
                settings.shimmerStrength = 0.0f;
                ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
                std::array<std::vector<float>, 2> over; // black, white
                for (const int white : {0, 1}) {
                    if (!isAlone)
                        render(view, def, FX_RANGE_FIRST, end, kEndless);
                    clear(float(white));
                    render(view, def, isAlone ? FX_RANGE_ONLY : FX_RANGE_LAST, 0.0f, end);
                    over[size_t(white)] = picture();
                }
                through[composition == FX_COMPOSITION_SLABS] = transmittance(over[0], over[1]);
            }
            EXPECT_LT(*std::min_element(through[0].begin(), through[0].end()), 0.9f); // there is something
            const float difference = fx::test::largestShownDifference(through[0], through[1]);
            std::printf("up to %.1f m, %s: opacity of slabs differs by %.2f/255 at most\n", double(end),
                        isAlone ? "alone" : "one of two", double(difference / kStep));
            EXPECT_LE(difference, kStep);
        }
    hide(view);
}

TEST_F(ViewRanges, haveLightWhereverTheyHide)
{
    // In daylight nothing has no light. A pixel whose sums are no numbers would have none.
    for (const auto& [cut, composition] :
         {std::pair(kNearExplosion, FX_COMPOSITION_SLABS), std::pair(kExplosion, FX_COMPOSITION_VOLUME),
          std::pair(kCampfire, FX_COMPOSITION_VOLUME), std::pair(kCampfire, FX_COMPOSITION_SLABS)})
    {
        SCOPED_TRACE(std::string(cut.preset) + ", composition " + std::to_string(composition));
        FxView* const view = show(cut, composition);
        FxViewSettings settings = sunny(composition);
        settings.shimmerStrength = 0.0f;
        ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
        size_t hidden = 0, black = 0;
        for (int moved = 0; moved < 2; ++moved) { // rays at other places
            FxFrameDef def = eye(cut);
            def.origin[0] += 0.0013 * double(moved) * cut.distance;
            const std::vector<float> dark = whole(view, def, 0.0f), bright = whole(view, def, 1.0f);
            for (size_t i = 0; i < dark.size(); i += 4) {
                const bool hides = bright[i] - dark[i] < 0.6f;
                ASSERT_TRUE(std::isfinite(dark[i]) && std::isfinite(bright[i]));
                hidden += hides;
                black += hides && !(dark[i] > 1e-5f);
            }
        }
        EXPECT_GT(hidden, 50u);
        EXPECT_EQ(black, 0u) << "of " << hidden;
        hide(view);
    }
}

TEST_F(ViewRanges, showEffectsBeforeInAndBehindGlass)
{
    FxView* const view = show(kCampfire, FX_COMPOSITION_SLABS);
    FxViewSettings settings = sunny(FX_COMPOSITION_SLABS);
    settings.shimmerStrength = 0.0f;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    const FxFrameDef def = eye(kCampfire);
    struct Place
    {
        const char* name;
        float depth; ///< [m]
    };
    std::vector<std::vector<float>> pictures;
    for (const Place& at : {Place{"before", 1.2f}, Place{"inside", 3.0f}, Place{"behind", 20.0f}}) {
        SCOPED_TRACE(at.name);
        clear(kBackground);
        render(view, def, FX_RANGE_FIRST, at.depth, kEndless);
        drawGlass(); // the transparent pass of the host
        const std::vector<float> behind = picture();
        render(view, def, FX_RANGE_LAST, 0.0f, at.depth);
        pictures.push_back(picture());
        writePicture(at.name, pictures.back());
        // what is before the glass, over black and over white, tells what it shows of the picture with glass
        const auto near = [&](float background) {
            clear(background);
            render(view, def, FX_RANGE_FIRST, at.depth, kEndless);
            clear(background);
            render(view, def, FX_RANGE_LAST, 0.0f, at.depth);
            return picture();
        };
        const std::vector<float> dark = near(0.0f), bright = near(1.0f);
        std::vector<float> wanted = pictures.back();
        for (size_t i = 0; i < wanted.size(); ++i)
            wanted[i] = i % 4 == 3 ? wanted[i] : dark[i] + (bright[i] - dark[i]) * behind[i];
        EXPECT_LE(fx::test::largestShownDifference(pictures.back(), wanted), kStep);
    }
    std::vector<float> tinted = whole(view, def, kBackground);
    tint(tinted);
    EXPECT_LE(fx::test::largestShownDifference(pictures[0], tinted), kStep); // all is behind the glass
    clear(kBackground);
    drawGlass();
    render(view, def, FX_RANGE_ONLY, 0.0f, kEndless);
    EXPECT_LE(fx::test::largestShownDifference(pictures[2], picture()), kStep); // all is before it
    EXPECT_GT(fx::test::largestShownDifference(pictures[1], pictures[0]), 0.1f);
    EXPECT_GT(fx::test::largestShownDifference(pictures[1], pictures[2]), 0.1f);
    hide(view);
}

TEST_F(ViewRanges, shareWhatTheFirstCallPreparesAndItsMoment)
{
    for (const auto& [cut, composition] :
         {std::pair(kCampfire, FX_COMPOSITION_SLABS), std::pair(kSparks, FX_COMPOSITION_SORTED)})
    {
        SCOPED_TRACE(std::string(cut.preset) + ", composition " + std::to_string(composition));
        FxView* const view = show(cut, composition);
        FxViewSettings settings = sunny(composition);
        settings.multipleScattering = 2; // networks
        ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
        const FxFrameDef def = eye(cut);
        const std::vector<float> before = inRanges(view, cut, kBackground);
        clear(kBackground);
        render(view, def, FX_RANGE_FIRST, cut.ends[1], kEndless);
        EXPECT_GT(countsOf(view).passes, 0u);
        step(5); // the frame does not see it
        render(view, def, FX_RANGE_NEXT, cut.ends[0], cut.ends[1]);
        for (int i = 0; i < 2; ++i) {
            const FxViewStatistics counts = countsOf(view);
            EXPECT_EQ(counts.keptLists, 1u);
            EXPECT_EQ(counts.uploadedBytes, 0u);
            EXPECT_EQ(counts.sortedParticles, 0u);
            for (const std::string& pass : fx::test::passNamesOf(view))
                for (const char* const once :
                     {"light slices", "blob upload", "blob light", "loose blob upload", "field upload",
                      "field fill", "field light", "field slices", "glow", "network", "gpu particles"})
                    EXPECT_FALSE(pass.starts_with(once)) << pass;
            if (i == 0)
                render(view, def, FX_RANGE_LAST, 0.0f, cut.ends[0]);
        }
        EXPECT_LE(fx::test::largestShownDifference(picture(), before), kStep);
        EXPECT_GT(fx::test::largestShownDifference(whole(view, def, kBackground), before),
                  kStep); // time has passed
        hide(view);
    }
}

TEST_F(ViewRanges, areCompletedByTheLastCall)
{
    FxView* const view = show(kCampfire, FX_COMPOSITION_SORTED);
    FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    settings.dazzle = 1;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    FxView* const other = makeView(settings);
    const FxFrameDef def = eye(kCampfire);
    const auto isComplete = [&] {
        const std::vector<std::string> passes = fx::test::passNamesOf(view);
        return std::ranges::any_of(passes, [](const std::string& pass) {
            return pass.starts_with("heat shimmer") || pass.starts_with("dazzle");
        });
    };
    for (int i = 0; i < 3; ++i) { // glare adapts over frames
        step(1);
        clear(kBackground);
        const float depth = kCampfire.ends[0];
        render(view, def, FX_RANGE_FIRST, depth, kEndless);
        EXPECT_FALSE(isComplete());
        render(view, def, FX_RANGE_LAST, 0.0f, depth);
        EXPECT_TRUE(isComplete());
        const std::vector<float> ranges = picture();
        EXPECT_LE(meanDifference(whole(other, def, kBackground), ranges), kStep);
    }
}

TEST_F(ViewRanges, ofWrongDepthsOrOrderAreRefusedAndNameTheMember)
{
    FxView* const view = show(kCampfire, FX_COMPOSITION_SORTED);
    const auto refuse = [&](FxFrameDef def, const char* text) {
        EXPECT_EQ(fxView_Render(view, &def), FX_ERROR_INVALID_ARGUMENT) << text;
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find(text), std::string::npos)
            << fxGetLastErrorMessage();
    };
    const auto ranged = [&](uint32_t part, float from, float to) {
        FxFrameDef def = eye(kCampfire);
        def.rangePart = part;
        def.rangeNear = from;
        def.rangeFar = to;
        return def;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    clear(kBackground);
    const std::vector<float> before = picture();
    refuse(ranged(FX_RANGE_ONLY, kNan, 5.0f), "frame.rangeNear");
    refuse(ranged(FX_RANGE_ONLY, -1.0f, 5.0f), "frame.rangeNear");
    refuse(ranged(FX_RANGE_ONLY, 0.0f, kNan), "frame.rangeFar");
    refuse(ranged(FX_RANGE_ONLY, 0.0f, kInfinite), "frame.rangeFar");
    refuse(ranged(FX_RANGE_ONLY, 5.0f, 2.0f), "frame.rangeFar is not above frame.rangeNear");
    refuse(ranged(FX_RANGE_ONLY, 2.0f, 2.0f), "frame.rangeFar is not above frame.rangeNear");
    refuse(ranged(4, 0.0f, 5.0f), "frame.rangePart");
    refuse(ranged(FX_RANGE_NEXT, 0.0f, 5.0f), "begin with FX_RANGE_FIRST");
    refuse(ranged(FX_RANGE_LAST, 0.0f, 5.0f), "begin with FX_RANGE_FIRST");
    FxFrameDef elsewhere = ranged(FX_RANGE_FIRST, 0.0f, 5.0f);
    elsewhere.target = FX_TARGET_FRAMEBUFFER;
    refuse(elsewhere, "FX_TARGET_TEXTURE");
    const FxFrameDef eyes[] = {ranged(FX_RANGE_FIRST, 2.0f, 5.0f), ranged(FX_RANGE_ONLY, 0.0f, 5.0f)};
    EXPECT_EQ(fxView_RenderStereo(view, &eyes[0], &eyes[1]), FX_ERROR_INVALID_ARGUMENT);
    EXPECT_NE(std::string(fxGetLastErrorMessage()).find("first: frame.rangePart"), std::string::npos);
    EXPECT_EQ(picture(), before);

    const auto begin = [&] { render(view, eye(kCampfire), FX_RANGE_FIRST, 3.0f, kEndless); };
    begin();
    refuse(ranged(FX_RANGE_LAST, 0.0f, 3.5f), "the farthest first");
    FxFrameDef moved = ranged(FX_RANGE_LAST, 0.0f, 3.0f);
    moved.origin[0] = 1.0;
    refuse(moved, "differ from the range before");
    render(view, eye(kCampfire), FX_RANGE_LAST, 0.0f, 3.0f); // refused arguments have not ended it
    begin();
    FxViewSettings settings = sunny(FX_COMPOSITION_SORTED);
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    refuse(ranged(FX_RANGE_LAST, 0.0f, 3.0f), "begin with FX_RANGE_FIRST");
    settings.outputs = FX_OUTPUT_MOTION;
    ASSERT_EQ(fxView_SetSettings(view, &settings), FX_OK);
    refuse(ranged(FX_RANGE_FIRST, 0.0f, 3.0f), "settings.outputs");
}
