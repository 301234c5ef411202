// Callbacks of the host that call the library again: every call is refused or does what it says, whatever
// function is being executed, destruction included.
#include "tests/api/api_fixture.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

using fx::test::kFrame;
using fx::test::loadText;

namespace {

/// A host all of whose callbacks call the library.
class CallingHost
{
public:
    FxContextDef def()
    {
        FxContextDef def = fxDefaultContextDef();
        def.workers = 1;
        def.allocator = {this, &allocate, &release};
        def.parallelFor = {this, &parallelFor};
        def.log = {this, &log};
        def.assets = {this, &open, &close};
        return def;
    }

    using Results = std::map<std::string, std::set<FxResult>>;
    /// While `outer` runs, each callback makes all calls that `inner` makes.
    /// @return what the calls gave, by callback and function
    Results during(const std::function<void(CallingHost&)>& inner, const std::function<void()>& outer)
    {
        results_.clear();
        inner_ = inner;
        outer();
        inner_ = nullptr;
        return results_;
    }
    /// For `inner`: notes a result.
    void note(const char* function, FxResult result)
    {
        results_[std::string(callback_) + ": " + function].insert(result);
    }

    int64_t blocks = 0; ///< taken and not given back
    std::string asset;  ///< what every file of the host contains

    static int meet(void* user, const double*, const double*, float*, float*)
    {
        static_cast<CallingHost*>(user)->call("meet");
        return 0;
    }

private:
    void call(const char* callback)
    {
        if (!inner_ || isInside_)
            return;
        isInside_ = true;
        callback_ = callback;
        inner_(*this);
        isInside_ = false;
    }
    static CallingHost& self(void* user) { return *static_cast<CallingHost*>(user); }
    static void* allocate(void* user, size_t size, size_t alignment)
    {
        self(user).call("allocate");
        ++self(user).blocks;
        return ::operator new(size, std::align_val_t(alignment), std::nothrow);
    }
    static void release(void* user, void* memory, size_t, size_t alignment)
    {
        self(user).call("release");
        --self(user).blocks;
        ::operator delete(memory, std::align_val_t(alignment));
    }
    static void parallelFor(void* user, uint32_t count, uint32_t, FxLoopBody body, void* argument)
    {
        self(user).call("parallelFor");
        body(argument, 0, count);
    }
    static void log(void* user, FxLogLevel, FxResult, const char*) { self(user).call("log"); }
    static const void* open(void* user, const char*, size_t* outSize)
    {
        self(user).call("open");
        *outSize = self(user).asset.size();
        return self(user).asset.data();
    }
    static void close(void* user, const void*, size_t) { self(user).call("close"); }

    std::function<void(CallingHost&)> inner_;
    bool isInside_ = false;
    const char* callback_ = "";
    Results results_;
};

/// Particles that meet the host's geometry, and that are many enough for parallelFor.
constexpr const char* kHail = R"({"version": 1, "ground": false, "emitters": [{"maxParticles": 20000,
    "shape": "disc", "size": 1, "emission": {"bursts": [{"time": 0, "count": 8000}]}, "lifetime": 9,
    "radius": 0.01, "appearance": {"kind": "sprite"}, "collisions": [{"shape": "hook", "bounce": 0.5}]}]})";

class Reentrance : public ::testing::Test
{
protected:
    Reentrance()
    {
        host_.asset = fx::test::fountainPreset();
        const FxContextDef def = host_.def();
        EXPECT_EQ(fxCreateContext(&def, &context_), FX_OK) << fxGetLastErrorMessage();
        hail_ = loadText(context_, kHail);
        scene_ = makeScene();
    }
    ~Reentrance() override
    {
        EXPECT_EQ(fxDestroyContext(context_), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(host_.blocks, 0);
    }

    FxScene* makeScene(int frames = 3)
    {
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        EXPECT_EQ(fxCreateScene(context_, &def, &scene), FX_OK) << fxGetLastErrorMessage();
        FxContactHook hook = fxDefaultContactHook();
        hook.user = &host_;
        hook.meet = &CallingHost::meet;
        EXPECT_EQ(fxScene_SetContactHook(scene, &hook), FX_OK);
        FxInstanceDef instance = fxDefaultInstanceDef();
        instance.preset = hail_;
        EXPECT_EQ(fxScene_CreateInstance(scene, &instance, &instance_), FX_OK) << fxGetLastErrorMessage();
        play(scene, frames);
        return scene;
    }

    static void play(FxScene* scene, int frames)
    {
        for (int frame = 0; frame < frames; ++frame)
            EXPECT_EQ(fxScene_Update(scene, kFrame), FX_OK) << fxGetLastErrorMessage();
    }

    /// Every function that enters the scene.
    void callScene(CallingHost& host, FxScene* scene) const
    {
        FxInstanceDef def = fxDefaultInstanceDef();
        def.preset = hail_;
        FxInstanceId id{};
        FxSceneStatistics statistics{};
        statistics.structSize = sizeof statistics;
        const FxInstanceParameters parameters = fxDefaultInstanceParameters();
        const double position[3] = {};
        const float rotation[4] = {0, 0, 0, 1};
        uint64_t hash = 0;
        size_t size = 0;
        uint32_t count = 0;
        std::array<char, 64> state{};
        FxInstanceState instanceState{};
        host.note("fxDestroyScene", fxDestroyScene(scene));
        host.note("fxScene_AdoptThread", fxScene_AdoptThread(scene));
        host.note("fxScene_Update", fxScene_Update(scene, kFrame));
        host.note("fxScene_GetStatistics", fxScene_GetStatistics(scene, &statistics));
        host.note("fxScene_CreateInstance", fxScene_CreateInstance(scene, &def, &id));
        host.note("fxScene_DestroyInstance", fxScene_DestroyInstance(scene, instance_));
        host.note("fxScene_GetInstances", fxScene_GetInstances(scene, nullptr, 0, &count));
        host.note("fxScene_GetEvents", fxScene_GetEvents(scene, nullptr, 0, &count, nullptr));
        host.note("fxScene_GetUserData", fxScene_GetUserData(scene, instance_, &hash));
        host.note("fxScene_SetParameter",
                  fxScene_SetParameter(scene, instance_, {}, FX_PARAMETER_FLOAT, position));
        host.note("fxScene_GetInstanceState",
                  fxScene_GetInstanceState(scene, instance_, &instanceState, nullptr));
        host.note("fxScene_SetTransform", fxScene_SetTransform(scene, instance_, position, rotation, 1.0f));
        const FxMotion motion = fxDefaultMotion();
        FxReservationInfo reservation{};
        reservation.structSize = sizeof reservation;
        host.note("fxScene_SetMotion", fxScene_SetMotion(scene, instance_, &motion));
        host.note("fxScene_ReservePreset", fxScene_ReservePreset(scene, def.preset, 0, 2));
        host.note("fxScene_GetReservation", fxScene_GetReservation(scene, def.preset, 0, &reservation));
        host.note("fxScene_SetParameters", fxScene_SetParameters(scene, instance_, &parameters));
        host.note("fxScene_SeekInstance", fxScene_SeekInstance(scene, instance_, 0.1));
        host.note("fxScene_SetContactHook", fxScene_SetContactHook(scene, nullptr));
        host.note("fxScene_SetCollisionMesh", fxScene_SetCollisionMesh(scene, nullptr));
        host.note("fxScene_GetStateHash", fxScene_GetStateHash(scene, &hash));
        host.note("fxScene_GetSimulationHash", fxScene_GetSimulationHash(scene, &hash));
        host.note("fxScene_SaveState", fxScene_SaveState(scene, nullptr, 0, &size));
        host.note("fxScene_RestoreState", fxScene_RestoreState(scene, state.data(), state.size()));
        EXPECT_EQ(fxScene_IsValid(scene, instance_), 0u);
    }

    /// Every function of the context, but for creating more.
    void callContext(CallingHost& host) const
    {
        FxMemoryStats stats{};
        stats.structSize = sizeof stats;
        FxPresetInfo info{};
        info.structSize = sizeof info;
        FxPresetId preset{};
        FxScene* scene = nullptr;
        const FxSceneDef def = fxDefaultSceneDef();
        const std::string text = fx::test::fountainPreset();
        host.note("fxDestroyContext", fxDestroyContext(context_));
        host.note("fxContext_GetMemoryStats", fxContext_GetMemoryStats(context_, &stats));
        host.note("fxGetPresetInfo", fxGetPresetInfo(context_, hail_, &info));
        FxPresetPreview preview{};
        preview.structSize = sizeof preview;
        host.note("fxGetPresetPreview", fxGetPresetPreview(context_, hail_, &preview));
        FxViewSettings settings = fxDefaultViewSettings();
        host.note("fxSetPreviewSettings", fxSetPreviewSettings(context_, hail_, &settings));
        host.note("fxLoadPresetText", fxLoadPresetText(context_, text.data(), text.size(), nullptr, &preset));
        host.note("fxCreateScene", fxCreateScene(context_, &def, &scene));
    }

    /// Takes a snapshot, as any thread may, and gives it back.
    static void callSnapshot(CallingHost& host, FxScene* scene)
    {
        FxSnapshotId snapshot{};
        const FxResult result = fxScene_AcquireSnapshot(scene, &snapshot);
        host.note("fxScene_AcquireSnapshot", result);
        if (result == FX_OK) {
            EXPECT_EQ(fxScene_ReleaseSnapshot(scene, snapshot), FX_OK);
        }
    }

    static void expectAll(const CallingHost::Results& results, const std::string& callback, FxResult wanted)
    {
        bool isCalled = false;
        for (const auto& [name, seen] : results)
            if (name.rfind(callback + ":", 0) == 0) {
                isCalled = true;
                EXPECT_EQ(seen, std::set<FxResult>{wanted}) << name;
            }
        EXPECT_TRUE(isCalled) << "the host has not been called: " << callback;
    }

    CallingHost host_;
    FxContext* context_ = nullptr;
    FxPresetId hail_{};
    FxScene* scene_ = nullptr;
    FxInstanceId instance_{};
};

} // namespace

TEST_F(Reentrance, nothingEntersASceneThatIsBeingDestroyed)
{
    FxScene* const scene = makeScene();
    const auto results = host_.during(
        [&](CallingHost& host) {
            callScene(host, scene);
            callSnapshot(host, scene);
        },
        [&] { EXPECT_EQ(fxDestroyScene(scene), FX_OK) << fxGetLastErrorMessage(); });
    expectAll(results, "release", FX_ERROR_RE_ENTRANT);
    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK); // the other is as it was
}

TEST_F(Reentrance, nothingEntersAContextThatIsBeingDestroyed)
{
    CallingHost other;
    const FxContextDef def = other.def();
    FxContext* const kept = std::exchange(context_, nullptr);
    ASSERT_EQ(fxCreateContext(&def, &context_), FX_OK);
    hail_ = loadText(context_, kHail);
    makeScene();
    makeScene();
    const auto results = other.during([&](CallingHost& host) { callContext(host); },
                                      [&] { EXPECT_EQ(fxDestroyContext(context_), FX_OK); });
    expectAll(results, "release", FX_ERROR_RE_ENTRANT);
    EXPECT_EQ(other.blocks, 0);
    context_ = kept;
}

TEST_F(Reentrance, aSceneIsInsideWhileItsContextIsBeingDestroyed)
{
    CallingHost other;
    const FxContextDef def = other.def();
    FxContext* const kept = std::exchange(context_, nullptr);
    ASSERT_EQ(fxCreateContext(&def, &context_), FX_OK);
    hail_ = loadText(context_, kHail);
    FxScene* const scene = makeScene();
    bool isGone = false; // its memory is given back before that of the context
    const auto results = other.during(
        [&](CallingHost& host) {
            if (isGone)
                return;
            host.note("fxScene_Update", fxScene_Update(scene, kFrame));
            host.note("fxDestroyScene", fxDestroyScene(scene));
            isGone = true;
        },
        [&] { EXPECT_EQ(fxDestroyContext(context_), FX_OK); });
    expectAll(results, "release", FX_ERROR_RE_ENTRANT);
    context_ = kept;
}

TEST_F(Reentrance, nothingEntersASceneThatIsUpdating)
{
    FxScene* const scene = makeScene(0);
    const auto results =
        host_.during([&](CallingHost& host) { callScene(host, scene); }, [&] { play(scene, 4); });
    for (const char* callback : {"allocate", "parallelFor", "meet"})
        expectAll(results, callback, FX_ERROR_RE_ENTRANT);
}

TEST_F(Reentrance, noContextIsDestroyedFromInside)
{
    const auto destroy = [&](CallingHost& host) {
        host.note("fxDestroyContext", fxDestroyContext(context_));
    };
    FxScene* const scene = makeScene(0);
    auto results = host_.during(destroy, [&] { play(scene, 4); });
    for (const char* callback : {"allocate", "parallelFor", "meet"})
        expectAll(results, callback, FX_ERROR_RE_ENTRANT);
    results = host_.during(destroy, [&] {
        FxPresetId preset{};
        EXPECT_EQ(fxLoadPresetFile(context_, "any.fx.json", &preset), FX_OK) << fxGetLastErrorMessage();
        EXPECT_EQ(fxUnloadPreset(context_, preset), FX_OK);
    });
    for (const char* callback : {"open", "close"})
        expectAll(results, callback, FX_ERROR_RE_ENTRANT);
    results = host_.during(destroy, [&] { EXPECT_EQ(fxDestroyScene(makeScene()), FX_OK); });
    expectAll(results, "release", FX_ERROR_RE_ENTRANT);
}

TEST_F(Reentrance, presetsAreNotLoadedFromInsideALoad)
{
    const auto results = host_.during(
        [&](CallingHost& host) {
            FxPresetId preset{};
            host.note("fxLoadPresetFile", fxLoadPresetFile(context_, "other.fx.json", &preset));
            host.note("fxLoadPresetLibrary", fxLoadPresetLibrary(context_, "sparks", &preset));
        },
        [&] {
            FxPresetId preset{};
            EXPECT_EQ(fxLoadPresetFile(context_, "any.fx.json", &preset), FX_OK) << fxGetLastErrorMessage();
        });
    for (const char* callback : {"open", "close"})
        expectAll(results, callback, FX_ERROR_RE_ENTRANT);
}

TEST_F(Reentrance, snapshotsAreReadFromEveryCallback)
{
    FxScene* const scene = makeScene(0);
    const auto results =
        host_.during([&](CallingHost& host) { callSnapshot(host, scene); }, [&] { play(scene, 4); });
    for (const char* callback : {"allocate", "parallelFor", "meet"})
        expectAll(results, callback, FX_OK);
}

TEST_F(Reentrance, aCallThatWasRefusedLeavesTheSceneAsItWas)
{
    FxScene* const disturbed = makeScene();
    (void)host_.during([&](CallingHost& host) { callScene(host, disturbed); },
                       [&] { EXPECT_EQ(fxScene_Update(disturbed, kFrame), FX_OK); });
    EXPECT_EQ(fxScene_Update(scene_, kFrame), FX_OK);
    uint64_t one = 0, other = 0;
    EXPECT_EQ(fxScene_GetSimulationHash(scene_, &one), FX_OK);
    EXPECT_EQ(fxScene_GetSimulationHash(disturbed, &other), FX_OK);
    EXPECT_EQ(one, other);
}

TEST_F(Reentrance, aCallThatFailsHasLeftTheSceneWhenItIsLogged)
{
    FxScene* const scene = makeScene();
    const auto results =
        host_.during([&](CallingHost& host) { host.note("fxDestroyScene", fxDestroyScene(scene)); },
                     [&] { EXPECT_EQ(fxScene_Update(scene, -1.0), FX_ERROR_INVALID_ARGUMENT); });
    expectAll(results, "log", FX_OK);
}
