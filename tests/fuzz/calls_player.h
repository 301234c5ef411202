/// @file calls_player.h
/// Interprets bytes as a recording of calls of the C API, and executes the calls. There are three contexts
/// with scenes, instances, snapshots and views. Their callbacks also execute calls of the recording.
///
/// Each call takes 32 bytes. Two bytes choose the function. The other 30 bytes choose its objects and
/// arguments, which may be invalid. Zeros select typical values. Arguments with a documented unbounded cost,
/// such as the steps of one update or the cells of a mesh, are limited to small values.
#pragma once

#include "fxsdk/fxsdk.h"
#include "tests/fuzz/fuzz_host.h"

#include <array>
#include <memory>
#include <vector>

namespace fx::fuzz {

/// OpenGL functions of the host, and render targets of views. The targets are created once for all inputs.
struct GlHost
{
    FxGlLoader loader{};
    uint32_t color = 0, depth = 0; ///< GL names of textures
    int32_t size = 0;              ///< [pixel]
};

/// The OpenGL host. Without FX_FUZZ_WITH_GL, all members are 0.
const GlHost& glHost();

struct PlayedScene
{
    FxScene* scene = nullptr;
    std::vector<FxInstanceId> instances; ///< instances, including destroyed instances
    std::vector<FxSnapshotId> snapshots; ///< snapshots, including released snapshots
};

struct PlayedContext
{
    FuzzHost host; ///< host, which must outlive the context
    FxContext* context = nullptr;
    bool hasGl = false;
    std::vector<FxPresetId> presets; ///< presets, including unloaded presets
    std::array<PlayedScene, 2> scenes;
    std::array<FxView*, 2> views{};
};

class CallsPlayer
{
public:
    explicit CallsPlayer(std::span<const uint8_t> recording);
    CallsPlayer(const CallsPlayer&) = delete;
    CallsPlayer& operator=(const CallsPlayer&) = delete;

    /// Executes all calls, then destroys the remaining objects. Checks that no memory is still allocated.
    void play();

private:
    using Call = void (CallsPlayer::*)();
    static std::span<const Call> callsOfContexts();
    static std::span<const Call> callsOfScenes();
    static std::span<const Call> callsOfViews();

    void playOne();
    void intrude();
    void forget(const void* memory, size_t size);
    void destroyAll(PlayedContext& played);

    /// Selects a context. The first context is selected most often.
    PlayedContext& anyContext() { return contexts_[input_.one(4) ? 1 + input_.below(2) : 0]; }
    PlayedScene& sceneOf(PlayedContext& played) { return played.scenes[input_.one(4) ? 1 : 0]; }
    FxView*& viewOf(PlayedContext& played) { return played.views[input_.one(4) ? 1 : 0]; }
    PlayedScene& anyScene() { return sceneOf(anyContext()); }
    FxView* anyView() { return viewOf(anyContext()); }
    FxPresetId anyPreset(const PlayedContext& played);
    FxInstanceId anyInstance(const PlayedScene& played);
    FxSnapshotId anySnapshot(const PlayedScene& played);
    double number(double most);
    float floatNumber(double most) { return float(number(most)); }
    uint32_t structSize(size_t size); ///< value for the member structSize, in most cases `size`
    /// Creates a struct that a call fills.
    template <class Struct>
    Struct sized()
    {
        Struct result{};
        result.structSize = structSize(sizeof result);
        return result;
    }

    // calls_player.cpp
    void createContext();
    void destroyContext();
    void failAllocations();
    void loadPreset();
    void unloadPreset();
    void readContext();
    // calls_scene.cpp
    void createScene();
    void destroyScene();
    void createInstance();
    void destroyInstance();
    void updateScene();
    void changeInstance();
    void seekInstance();
    void triggerEvent();
    void setCollisionMesh();
    void setContactHook();
    void setFocus();
    void setActivation();
    void readScene();
    void saveAndRestore();
    void takeSnapshot();
    void readSnapshot();
    void releaseSnapshot();
    // calls_view.cpp
    void createView();
    void destroyView();
    void setSettings();
    void render();
    void readView();
    void setCalibration();
    FxViewSettings anySettings();

    InputReader recording_; ///< remaining calls
    InputReader input_;     ///< arguments of the present call
    std::array<PlayedContext, 3> contexts_;
    int depth_ = 0;          ///< depth of nested calls within callbacks
    uint32_t calls_ = 0;     ///< number of executed calls
    uint32_t intruders_ = 0; ///< number of callbacks that may still make a call
};

} // namespace fx::fuzz
