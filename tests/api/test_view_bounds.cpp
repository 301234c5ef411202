// What a view draws of the library's effects lies inside of the bounds that their snapshots tell.
#include "tests/api/view_fixture.h"

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr float kMargin = 2.0f; ///< [pixel] what is smaller than a pixel is widened to one

struct Box
{
    glm::vec3 low{kFar};
    glm::vec3 high{-kFar};

    bool empty() const { return !(low.x <= high.x); }
    void add(const float* min, const float* max)
    {
        low = glm::min(low, glm::vec3(min[0], min[1], min[2]));
        high = glm::max(high, glm::vec3(max[0], max[1], max[2]));
    }
};

class ViewBounds : public fx::test::ViewApiTest
{
protected:
    /// Bounds of all that the two snapshots of a moment hold; instances stand in the origin.
    Box boundsOf(FxScene* scene)
    {
        Box box;
        FxSnapshotId id{};
        FxSnapshotInfo info{};
        info.structSize = sizeof info;
        EXPECT_EQ(fxScene_AcquireSnapshot(scene, &id), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxScene_GetSnapshotInfo(scene, id, &info), FX_OK);
        for (const FxSnapshotStep step : {FX_SNAPSHOT_NEWER, FX_SNAPSHOT_OLDER})
            for (uint32_t i = 0; i < (step == FX_SNAPSHOT_NEWER ? info.groupsNewer : info.groupsOlder); ++i) {
                FxSnapshotGroup group{};
                group.structSize = sizeof group;
                EXPECT_EQ(fxScene_GetSnapshotGroup(scene, id, step, i, &group), FX_OK);
                box.add(group.boundsMin, group.boundsMax);
            }
        EXPECT_EQ(fxScene_ReleaseSnapshot(scene, id), FX_OK);
        return box;
    }

    /// Draws from in front of the box. @return pixels that changed; a failure for each outside of the box
    int expectInside(FxView* view, const Box& box, float nearness, const std::string& what)
    {
        const glm::vec3 half = 0.5f * (box.high - box.low);
        const glm::vec3 middle = box.low + half;
        FxFrameDef def = frame();
        for (int a = 0; a < 3; ++a)
            def.origin[a] = double(middle[a]);
        const float away = half.z + std::max({0.5f, half.x, half.y}) * nearness + 0.2f;
        def.origin[2] += double(away);
        fillPicture();
        EXPECT_EQ(fxView_Render(view, &def), FX_OK) << fxGetLastErrorMessage();
        const float depth = away - half.z; // of the box's front, where it is largest
        const float halfSize = 0.5f * float(kSize);
        const float right = half.x / depth * halfSize + kMargin;
        const float up = half.y / depth * halfSize + kMargin;
        const std::vector<float> pixels = picture();
        int changed = 0, outside = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                if (std::abs(pixels[size_t(y * kSize + x) * 4 + 1] - kBackground) < 1e-5f)
                    continue;
                ++changed;
                outside += std::abs(float(x) + 0.5f - halfSize) > right + 0.5f ||
                           std::abs(float(y) + 0.5f - halfSize) > up + 0.5f;
            }
        EXPECT_EQ(outside, 0) << what << ", nearness " << nearness << ", of " << changed;
        return changed;
    }

    /// @return pixels that were drawn at all moments
    int playAndCompare(const char* preset)
    {
        FxScene* scene = nullptr;
        FxView* view = nullptr;
        FxInstanceDef instance = fxDefaultInstanceDef();
        const FxSceneDef sceneDef = fxDefaultSceneDef();
        EXPECT_EQ(fxLoadPresetLibrary(context_, preset, &instance.preset), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxCreateScene(context_, &sceneDef, &scene), FX_OK);
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &id), FX_OK);
        EXPECT_EQ(fxCreateView(context_, scene, nullptr, &view), FX_OK);
        FxViewSettings settings = fxDefaultViewSettings();
        settings.dazzle = 0; // glare leaves every bound
        EXPECT_EQ(fxView_SetSettings(view, &settings), FX_OK) << fxGetLastErrorMessage();
        int changed = 0;
        double now = 0.0;
        for (int moment = 0; moment < 14; ++moment) {
            const double next = 0.021 * std::pow(1.5, moment); // 0.02 to 4 s, between steps
            for (; now < next; now += 1.0 / 45.0)
                EXPECT_EQ(fxScene_Update(scene, 1.0 / 45.0), FX_OK);
            const Box box = boundsOf(scene);
            if (box.empty())
                continue;
            const std::string what = std::string(preset) + " at " + std::to_string(now) + " s";
            for (const float nearness : {0.3f, 1.3f})
                changed += expectInside(view, box, nearness, what);
        }
        EXPECT_EQ(fxDestroyView(view), FX_OK);
        EXPECT_EQ(fxDestroyScene(scene), FX_OK);
        return changed;
    }
};

} // namespace

TEST_F(ViewBounds, holdEveryPixelThatFallsFloatsOrFlies)
{
    for (const char* preset : {"rain", "snow", "waterfall-mist", "magic-trail"})
        EXPECT_GT(playAndCompare(preset), 500) << preset;
}

TEST_F(ViewBounds, holdEveryPixelOfWhatBursts)
{
    for (const char* preset : {"fireworks", "muzzle-flash", "tracer", "debris"})
        EXPECT_GT(playAndCompare(preset), 50) << preset;
}
