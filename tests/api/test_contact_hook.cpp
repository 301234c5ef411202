#include "tests/api/api_fixture.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

using fx::test::kFrame;
using fx::test::loadText;

namespace {

/// A floor at a world height, which counts its questions and can misbehave.
struct Floor
{
    double height = -1.0;
    enum class Fault : uint8_t
    {
        None,
        NormalNotANumber,
        NormalZero,
        ShareBeyond
    } fault = Fault::None;
    FxScene* called = nullptr; ///< a scene that it calls
    std::atomic<int> answers{0};
    std::atomic<int> refusedCalls{0};

    static int meet(void* user, const double from[3], const double to[3], float* outShare, float outNormal[3])
    {
        Floor& floor = *static_cast<Floor*>(user);
        if (to[1] >= floor.height || from[1] < to[1])
            return 0;
        ++floor.answers;
        if (floor.called && fxScene_Update(floor.called, 1.0) != FX_OK)
            ++floor.refusedCalls;
        *outShare = from[1] > floor.height ? float((from[1] - floor.height) / (from[1] - to[1])) : 0.0f;
        outNormal[0] = outNormal[2] = 0.0f;
        outNormal[1] = 3.0f; // any length
        if (floor.fault == Fault::NormalNotANumber)
            outNormal[0] = std::numeric_limits<float>::quiet_NaN();
        if (floor.fault == Fault::NormalZero)
            outNormal[1] = 0.0f;
        if (floor.fault == Fault::ShareBeyond)
            *outShare = 1.5f;
        return 1;
    }
    FxContactHook hook()
    {
        FxContactHook made = fxDefaultContactHook();
        made.meet = &Floor::meet;
        made.user = this;
        return made;
    }
};

class ContactHook : public fx::test::ApiTest
{
protected:
    FxInstanceId addHail(double y, bool inWorld = false)
    {
        const std::string preset =
            std::string(R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 64, "shape": "disc",
            "size": 1, "emission": {"bursts": [{"time": 0, "count": 64}]}, "lifetime": 100, "radius": 0.01,
            "space": ")") +
            (inWorld ? "world" : "local") +
            R"(", "appearance": {"kind": "sprite"}, "collisions": [{"shape": "hook", "bounce": 0.5}]}]})";
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, preset);
        def.position[1] = y;
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK) << fxGetLastErrorMessage();
        return id;
    }
    /// [m] lowest local y that is shown.
    float lowest() const
    {
        FxSnapshotId snapshot{};
        EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
        FxSnapshotColumn y{};
        y.structSize = sizeof y;
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, 0, "y", &y), FX_OK);
        float found = 1e9f;
        for (uint32_t i = 0; i < y.count; ++i)
            found = std::min(found, y.values[i]);
        fxScene_ReleaseSnapshot(scene_, snapshot);
        return found;
    }
};

} // namespace

TEST_F(ContactHook, particlesBounceOffThePlaneOfTheHostWhereverTheInstanceStands)
{
    for (const bool inWorld : {false, true})
        for (const double y : {0.0, 2.0}) {
            Floor floor;
            const FxContactHook hook = floor.hook();
            ASSERT_EQ(fxScene_SetContactHook(scene_, &hook), FX_OK) << fxGetLastErrorMessage();
            const FxInstanceId id = addHail(y, inWorld);
            float least = 0.0f;
            for (int i = 0; i < 180; ++i) {
                ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
                least = std::min(least, lowest());
            }
            EXPECT_GT(floor.answers, 0);
            EXPECT_NEAR(least, -1.0 - y, 2e-2);
            EXPECT_GT(least, -1.0 - y - 1e-3);
            ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
            ASSERT_EQ(fxScene_SetContactHook(scene_, nullptr), FX_OK);
        }
}

TEST_F(ContactHook, withoutOneNothingIsInTheWay)
{
    addHail(0);
    play(120);
    EXPECT_LT(lowest(), -15.0f);
}

TEST_F(ContactHook, answersThatAreNoneAreCountedAndReported)
{
    using Fault = Floor::Fault;
    for (const Fault fault : {Fault::NormalNotANumber, Fault::NormalZero, Fault::ShareBeyond}) {
        Floor floor;
        floor.fault = fault;
        const FxContactHook hook = floor.hook();
        ASSERT_EQ(fxScene_SetContactHook(scene_, &hook), FX_OK);
        const FxInstanceId id = addHail(0);
        FxResult result = FX_OK;
        for (int i = 0; i < 60 && result == FX_OK; ++i)
            result = fxScene_Update(scene_, kFrame);
        EXPECT_EQ(result, FX_ERROR_HOST_ANSWER);
        EXPECT_NE(std::string(fxGetLastErrorMessage()).find("answers that are none"), std::string::npos);
        const int64_t before = statistics().simulatedTick;
        floor.fault = Fault::None;
        EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK); // time went on and goes on
        EXPECT_GT(statistics().simulatedTick, before);
        ASSERT_EQ(fxScene_DestroyInstance(scene_, id), FX_OK);
    }
    ASSERT_EQ(fxScene_SetContactHook(scene_, nullptr), FX_OK);
}

TEST_F(ContactHook, mayNotCallTheSceneThatAsks)
{
    Floor floor;
    floor.called = scene_;
    const FxContactHook hook = floor.hook();
    ASSERT_EQ(fxScene_SetContactHook(scene_, &hook), FX_OK);
    addHail(0);
    for (int i = 0; i < 60; ++i)
        ASSERT_EQ(fxScene_Update(scene_, kFrame), FX_OK) << fxGetLastErrorMessage();
    EXPECT_GT(floor.refusedCalls, 0);
    EXPECT_EQ(floor.refusedCalls, floor.answers);
    ASSERT_EQ(fxScene_SetContactHook(scene_, nullptr), FX_OK);
}

TEST_F(ContactHook, isChecked)
{
    FxContactHook hook = fxDefaultContactHook();
    EXPECT_EQ(fxScene_SetContactHook(scene_, &hook), FX_ERROR_INVALID_ARGUMENT); // no function
    EXPECT_EQ(fxScene_SetContactHook(nullptr, nullptr), FX_ERROR_INVALID_ARGUMENT);
    Floor floor;
    hook = floor.hook();
    hook.structSize = 3;
    EXPECT_EQ(fxScene_SetContactHook(scene_, &hook), FX_ERROR_VERSION);
}

TEST_F(ContactHook, movesOfParticlesThatStayBehindAreSpreadOverTheStepsOfAnUpdate)
{
    const auto placesAfter = [this](int framesAtOnce) {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = loadText(context_, R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 4000,
            "space": "world", "emission": {"rate": 1200}, "lifetime": 100, "radius": 0.01,
            "forces": {"gravity": 0}, "appearance": {"kind": "sprite"}}]})");
        FxInstanceId id{};
        EXPECT_EQ(fxScene_CreateInstance(scene_, &def, &id), FX_OK);
        for (int frame = 0; frame < 12; frame += framesAtOnce) {
            const double position[3] = {0.1 * (frame + framesAtOnce), 0, 0};
            const float upright[4] = {0, 0, 0, 1};
            EXPECT_EQ(fxScene_SetTransform(scene_, id, position, upright, 1.0f), FX_OK);
            EXPECT_EQ(fxScene_Update(scene_, kFrame * framesAtOnce), FX_OK);
        }
        FxSnapshotId snapshot{};
        EXPECT_EQ(fxScene_AcquireSnapshot(scene_, &snapshot), FX_OK);
        FxSnapshotColumn x{};
        x.structSize = sizeof x;
        EXPECT_EQ(fxScene_FindSnapshotColumn(scene_, snapshot, FX_SNAPSHOT_NEWER, 0, "x", &x), FX_OK);
        std::vector<float> places(x.values, x.values + x.count);
        fxScene_ReleaseSnapshot(scene_, snapshot);
        fxScene_DestroyInstance(scene_, id);
        return places;
    };
    const auto byOne = placesAfter(1), byThree = placesAfter(3);
    ASSERT_EQ(byOne.size(), byThree.size());
    ASSERT_GT(byOne.size(), 200u);
    for (size_t i = 0; i < byOne.size(); ++i)
        ASSERT_NEAR(byOne[i], byThree[i], 2e-6) << i;
}
