/// @file fxsdk.hpp
/// C++17 form of the C API, in this header alone: objects that destroy themselves, and exceptions in place of
/// result codes. Everything else, such as structs, units and thread tags, is that of the C API; get()
/// gives the C object for functions that have no method here.
///
///     fxsdk::Context context;
///     fxsdk::Scene scene(context);
///     scene.create(context.loadLibrary("explosion"));
///     scene.update(1.0 / 60.0);
///
/// Order: a context outlives its scenes and views, and a scene outlives its views and snapshots, as members
/// and local variables do that are declared in this order.
/// Threads: those of the functions of C that a method calls. A destructor runs on the thread of the object.
#ifndef FXSDK_FXSDK_HPP
#define FXSDK_FXSDK_HPP

#include "fxsdk/fxsdk.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fxsdk {

/// A failed call. what() is the message of fxGetLastErrorMessage().
class Error : public std::runtime_error
{
public:
    Error(FxResult code, const char* message) : std::runtime_error(message), code_(code) {}
    FxResult code() const noexcept { return code_; }

private:
    FxResult code_;
};

/// Throws an Error unless `result` is FX_OK.
inline void check(FxResult result)
{
    if (result != FX_OK)
        throw Error(result, fxGetLastErrorMessage());
}

namespace detail {

/// Destroys an object of the C API. A destructor cannot report a failure; the context writes it to its log.
struct Destroy
{
    void operator()(FxContext* context) const { (void)fxDestroyContext(context); }
    void operator()(FxScene* scene) const { (void)fxDestroyScene(scene); }
    void operator()(FxView* view) const { (void)fxDestroyView(view); }
    void operator()(FxPresetLoad* load) const { (void)fxDestroyPresetLoad(load); }
};

template <class T>
using Owner = std::unique_ptr<T, Destroy>;

/// Calls `read`, a function of C that fills a struct with a member structSize.
template <class T, class Read>
T filled(Read&& read)
{
    T out{};
    out.structSize = sizeof(T);
    check(read(&out));
    return out;
}

} // namespace detail

/// An instance definition of a preset, with the defaults of fxDefaultInstanceDef().
inline FxInstanceDef instanceOf(FxPresetId preset)
{
    FxInstanceDef def = fxDefaultInstanceDef();
    def.preset = preset;
    return def;
}

/// Presets, scenes, views, and the hooks of the host.
class Context
{
public:
    explicit Context(const FxContextDef& def = fxDefaultContextDef())
    {
        FxContext* context = nullptr;
        check(fxCreateContext(&def, &context));
        context_.reset(context);
    }

    FxPresetId loadLibrary(const std::string& name)
    {
        FxPresetId preset{};
        check(fxLoadPresetLibrary(get(), name.c_str(), &preset));
        return preset;
    }

    FxPresetId loadFile(const std::string& path)
    {
        FxPresetId preset{};
        check(fxLoadPresetFile(get(), path.c_str(), &preset));
        return preset;
    }

    /// @param displayName name of the text in messages
    FxPresetId loadText(std::string_view text, const std::string& displayName = "preset")
    {
        FxPresetId preset{};
        check(fxLoadPresetText(get(), text.data(), text.size(), displayName.c_str(), &preset));
        return preset;
    }

    /// @param path file of which the text is an edited version
    FxPresetId loadTextAt(std::string_view text, const std::string& path)
    {
        FxPresetId preset{};
        check(fxLoadPresetTextAt(get(), text.data(), text.size(), path.c_str(), &preset));
        return preset;
    }

    /// Instances that are created with `preset` from now on have the effect of `target`.
    void redirect(FxPresetId preset, FxPresetId target) { check(fxRedirectPreset(get(), preset, target)); }

    std::vector<FxPresetId> presets()
    {
        uint32_t count = 0;
        check(fxGetPresets(get(), nullptr, 0, &count));
        std::vector<FxPresetId> all(count);
        if (count > 0)
            check(fxGetPresets(get(), all.data(), count, &count));
        all.resize(count);
        return all;
    }

    /// File of a preset, or the name of its text.
    std::string source(FxPresetId preset)
    {
        size_t size = 0;
        check(fxGetPresetSource(get(), preset, nullptr, 0, &size));
        std::string text(size, '\0');
        check(fxGetPresetSource(get(), preset, text.data(), size, &size));
        text.resize(size - 1);
        return text;
    }

    /// Living instances continue.
    void unload(FxPresetId preset) { check(fxUnloadPreset(get(), preset)); }

    FxPresetInfo info(FxPresetId preset)
    {
        return detail::filled<FxPresetInfo>([&](auto* out) { return fxGetPresetInfo(get(), preset, out); });
    }

    /// How the author of the preset shows it.
    FxPresetPreview preview(FxPresetId preset)
    {
        return detail::filled<FxPresetPreview>(
            [&](auto* out) { return fxGetPresetPreview(get(), preset, out); });
    }

    /// `settings` with exposure, light and composition with which the author of the preset shows it.
    FxViewSettings previewSettings(FxPresetId preset, FxViewSettings settings = fxDefaultViewSettings())
    {
        check(fxSetPreviewSettings(get(), preset, &settings));
        return settings;
    }

    /// `frame`, whose size is set, with a camera that looks from `eye` to `target`, see fxSetFrameCamera().
    FxFrameDef withCamera(FxFrameDef frame, const double (&eye)[3], const double (&target)[3], float fovY,
                          float nearDistance)
    {
        check(fxSetFrameCamera(get(), eye, target, fovY, nearDistance, &frame));
        return frame;
    }

    /// Handle of a parameter for Scene::set(), such as "tint".
    FxParameterId findParameter(FxPresetId preset, const std::string& name)
    {
        FxParameterId parameter{};
        check(fxFindParameter(get(), preset, name.c_str(), &parameter));
        return parameter;
    }

    /// Index of a cue of a preset, as in FxEvent::cue.
    uint32_t findCue(FxPresetId preset, const std::string& name)
    {
        uint32_t cue = FX_NO_CUE;
        check(fxFindPresetCue(get(), preset, name.c_str(), &cue));
        return cue;
    }

    /// Name of a cue of a preset.
    std::string cueName(FxPresetId preset, uint32_t cue)
    {
        return detail::filled<FxPresetCue>([&](auto* out) { return fxGetPresetCue(get(), preset, cue, out); })
            .name;
    }

    /// Compiles all GPU programs.
    void warmUp() { check(fxContext_WarmUp(get())); }

    /// The OpenGL context is lost: nothing calls OpenGL until restoreGl().
    void reportGlLoss() { check(fxContext_ReportGlLoss(get())); }

    /// Views continue in the OpenGL context that is current. @param gl null: the loader of the definition
    void restoreGl(const FxGlLoader* gl = nullptr) { check(fxContext_RestoreGl(get(), gl)); }

    FxMemoryStats memory()
    {
        return detail::filled<FxMemoryStats>([&](auto* out) { return fxContext_GetMemoryStats(get(), out); });
    }

    FxContext* get() const noexcept { return context_.get(); }

private:
    detail::Owner<FxContext> context_;
};

/// A preset that a worker thread loads.
class PresetLoad
{
public:
    /// @param path file, or "library:NAME"  @param text of the file, if it need not be read; empty: none
    PresetLoad(const Context& context, const std::string& path, std::string_view text = {})
    {
        FxPresetLoad* load = nullptr;
        check(fxBeginPresetLoad(context.get(), path.c_str(), text.empty() ? nullptr : text.data(),
                                text.size(), &load));
        load_.reset(load);
    }

    /// Loads, on the thread that calls.
    void run() { check(fxPresetLoad_Run(get())); }

    FxPresetLoadProgress progress()
    {
        return detail::filled<FxPresetLoadProgress>(
            [&](auto* out) { return fxPresetLoad_GetProgress(get(), out); });
    }

    void cancel() { check(fxPresetLoad_Cancel(get())); }

    /// The preset of a load that has ended.
    FxPresetId finish()
    {
        FxPresetId preset{};
        check(fxPresetLoad_Finish(get(), &preset));
        return preset;
    }

    FxPresetLoad* get() const noexcept { return load_.get(); }

private:
    detail::Owner<FxPresetLoad> load_;
};

/// Instances of effects, and a clock.
class Scene
{
public:
    explicit Scene(const Context& context, const FxSceneDef& def = fxDefaultSceneDef())
    {
        FxScene* scene = nullptr;
        check(fxCreateScene(context.get(), &def, &scene));
        scene_.reset(scene);
    }

    FxInstanceId create(const FxInstanceDef& def)
    {
        FxInstanceId instance{};
        check(fxScene_CreateInstance(get(), &def, &instance));
        return instance;
    }

    /// An instance at the origin that starts at once.
    FxInstanceId create(FxPresetId preset) { return create(instanceOf(preset)); }

    void destroy(FxInstanceId instance) { check(fxScene_DestroyInstance(get(), instance)); }
    bool isValid(FxInstanceId instance) { return fxScene_IsValid(get(), instance) != 0; }

    /// @param seconds [s] >= 0; of more than FxSceneDef::maxFrameTicks, 1/15 s by default, the rest is
    /// dropped
    void update(double seconds) { check(fxScene_Update(get(), seconds)); }
    /// Updates the scene by steps of 1/60 s, and by what remains. @param seconds [s] 0..1e6
    void advance(double seconds)
    {
        constexpr double kStep = 1.0 / 60.0;
        if (!(seconds >= 0.0 && seconds <= 1e6))
            throw Error(FX_ERROR_INVALID_ARGUMENT, "advance: seconds is not from 0 to 1e6");
        const auto steps = std::int64_t(seconds / kStep + 1e-6);
        for (std::int64_t i = 0; i < steps; ++i)
            update(kStep);
        if (const double rest = seconds - double(steps) * kStep; rest > 1e-6 * kStep)
            update(rest);
    }

    /// @param position [m] @param rotation unit quaternion x, y, z, w @param scale [1]
    void setTransform(FxInstanceId instance, const double (&position)[3], const float (&rotation)[4],
                      float scale = 1.0f)
    {
        check(fxScene_SetTransform(get(), instance, position, rotation, scale));
    }

    /// Adds a pose to the path of the instance.
    void setMotion(FxInstanceId instance, const FxMotion& motion)
    {
        check(fxScene_SetMotion(get(), instance, &motion));
    }

    /// Allocates the memory of `count` instances in advance; 0 frees it.
    void reserve(FxPresetId preset, uint32_t count, uint32_t quality = FX_QUALITY_DEFAULT)
    {
        check(fxScene_ReservePreset(get(), preset, quality, count));
    }

    FxReservationInfo reservation(FxPresetId preset, uint32_t quality = FX_QUALITY_DEFAULT)
    {
        return detail::filled<FxReservationInfo>(
            [&](auto* out) { return fxScene_GetReservation(get(), preset, quality, out); });
    }

    void setParameters(FxInstanceId instance, const FxInstanceParameters& parameters)
    {
        check(fxScene_SetParameters(get(), instance, &parameters));
    }

    /// Changes one parameter, which Context::findParameter() has found.
    void set(FxInstanceId instance, FxParameterId parameter, float value)
    {
        check(fxScene_SetParameter(get(), instance, parameter, FX_PARAMETER_FLOAT, &value));
    }
    void set(FxInstanceId instance, FxParameterId parameter, const float (&value)[3])
    {
        check(fxScene_SetParameter(get(), instance, parameter, FX_PARAMETER_FLOAT3, value));
    }
    void set(FxInstanceId instance, FxParameterId parameter, bool value)
    {
        const uint32_t flag = value ? 1 : 0;
        check(fxScene_SetParameter(get(), instance, parameter, FX_PARAMETER_BOOL, &flag));
    }

    /// Draws the instance with those of its layer, over all lower layers.
    void setLayer(FxInstanceId instance, int32_t layer, int32_t sortKey = 0)
    {
        check(fxScene_SetLayer(get(), instance, layer, sortKey));
    }

    /// Shows the instance only in frames whose FxFrameDef::visibilityMask shares a bit with `mask`.
    void setVisibilityMask(FxInstanceId instance, uint32_t mask)
    {
        check(fxScene_SetVisibilityMask(get(), instance, mask));
    }

    /// `frame`, whose size is set, with a camera that sees the instance, see fxScene_SetFrameCamera().
    FxFrameDef withCamera(FxFrameDef frame, FxInstanceId instance, float nearDistance)
    {
        check(fxScene_SetFrameCamera(get(), instance, nearDistance, &frame));
        return frame;
    }

    void trigger(FxInstanceId instance, const std::string& event, uint32_t count = 1)
    {
        check(fxScene_TriggerEvent(get(), instance, event.c_str(), count));
    }

    /// Reads all events and removes them from the scene, see fxScene_GetEvents().
    /// @param outLost receives the number of lost events; may be null
    std::vector<FxEvent> takeEvents(uint64_t* outLost = nullptr)
    {
        uint32_t count = 0;
        check(fxScene_GetEvents(get(), nullptr, 0, &count, outLost));
        std::vector<FxEvent> events(count);
        if (count > 0) {
            events.front().structSize = sizeof(FxEvent);
            check(fxScene_GetEvents(get(), events.data(), count, &count, outLost));
        }
        events.resize(count);
        return events;
    }

    void setUserData(FxInstanceId instance, uint64_t number)
    {
        check(fxScene_SetUserData(get(), instance, number));
    }
    uint64_t userData(FxInstanceId instance)
    {
        uint64_t number = 0;
        check(fxScene_GetUserData(get(), instance, &number));
        return number;
    }

    /// @param seconds [s] local time of the instance
    void seek(FxInstanceId instance, double seconds)
    {
        check(fxScene_SeekInstance(get(), instance, seconds));
    }

    /// Lets all instances of `oldPreset` continue with `newPreset`. @return their number
    uint32_t replacePreset(FxPresetId oldPreset, FxPresetId newPreset, FxReplaceMode mode = FX_REPLACE_SEEK)
    {
        uint32_t count = 0;
        check(fxScene_ReplacePreset(get(), oldPreset, newPreset, uint32_t(mode), &count));
        return count;
    }

    FxInstanceInfo info(FxInstanceId instance)
    {
        return detail::filled<FxInstanceInfo>(
            [&](auto* out) { return fxScene_GetInstanceInfo(get(), instance, out); });
    }

    FxInstanceState state(FxInstanceId instance)
    {
        FxInstanceState state{};
        check(fxScene_GetInstanceState(get(), instance, &state, nullptr));
        return state;
    }

    std::vector<FxInstanceId> instances()
    {
        uint32_t count = 0;
        check(fxScene_GetInstances(get(), nullptr, 0, &count));
        std::vector<FxInstanceId> all(count);
        if (count > 0)
            check(fxScene_GetInstances(get(), all.data(), count, &count));
        all.resize(count);
        return all;
    }

    /// State of the scene, for restoreState().
    std::vector<unsigned char> saveState()
    {
        size_t size = 0;
        check(fxScene_SaveState(get(), nullptr, 0, &size));
        std::vector<unsigned char> state(size);
        check(fxScene_SaveState(get(), state.data(), state.size(), &size));
        state.resize(size);
        return state;
    }
    void restoreState(const std::vector<unsigned char>& state)
    {
        check(fxScene_RestoreState(get(), state.data(), state.size()));
    }

    FxSceneStatistics statistics()
    {
        return detail::filled<FxSceneStatistics>(
            [&](auto* out) { return fxScene_GetStatistics(get(), out); });
    }

    FxScene* get() const noexcept { return scene_.get(); }

private:
    detail::Owner<FxScene> scene_;
};

/// The newest two steps of a scene, held until destruction.
class Snapshot
{
public:
    explicit Snapshot(const Scene& scene) : scene_(scene.get())
    {
        check(fxScene_AcquireSnapshot(scene_, &id_));
    }
    ~Snapshot()
    {
        if (scene_)
            (void)fxScene_ReleaseSnapshot(scene_, id_);
    }
    Snapshot(Snapshot&& other) noexcept : scene_(other.scene_), id_(other.id_) { other.scene_ = nullptr; }
    Snapshot& operator=(Snapshot&& other) noexcept
    {
        std::swap(scene_, other.scene_);
        std::swap(id_, other.id_);
        return *this;
    }

    FxSnapshotInfo info() const
    {
        return detail::filled<FxSnapshotInfo>(
            [&](auto* out) { return fxScene_GetSnapshotInfo(scene_, id_, out); });
    }

    /// @param index 0 to info().groupsNewer - 1
    FxSnapshotGroup group(uint32_t index, FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
    {
        return detail::filled<FxSnapshotGroup>(
            [&](auto* out) { return fxScene_GetSnapshotGroup(scene_, id_, step, index, out); });
    }

    FxSnapshotColumn column(uint32_t group, uint32_t column, FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
    {
        return detail::filled<FxSnapshotColumn>(
            [&](auto* out) { return fxScene_GetSnapshotColumn(scene_, id_, step, group, column, out); });
    }

    /// @param name such as "x" or "radius"
    FxSnapshotColumn column(uint32_t group, const std::string& name,
                            FxSnapshotStep step = FX_SNAPSHOT_NEWER) const
    {
        return detail::filled<FxSnapshotColumn>([&](auto* out) {
            return fxScene_FindSnapshotColumn(scene_, id_, step, group, name.c_str(), out);
        });
    }

private:
    FxScene* scene_;
    FxSnapshotId id_{};
};

/// Draws a scene into an image of the host.
class View
{
public:
    View(const Context& context, const Scene& scene, const FxViewSettings& settings = fxDefaultViewSettings())
    {
        FxView* view = nullptr;
        check(fxCreateView(context.get(), scene.get(), &settings, &view));
        view_.reset(view);
    }

    void setSettings(const FxViewSettings& settings) { check(fxView_SetSettings(get(), &settings)); }
    void render(const FxFrameDef& frame) { check(fxView_Render(get(), &frame)); }
    void renderStereo(const FxFrameDef& first, const FxFrameDef& second)
    {
        check(fxView_RenderStereo(get(), &first, &second));
    }
    void setScene(const Scene& scene) { check(fxView_SetScene(get(), scene.get())); }

    FxViewStatistics statistics()
    {
        return detail::filled<FxViewStatistics>([&](auto* out) { return fxView_GetStatistics(get(), out); });
    }

    FxLayerTextures layerTextures()
    {
        return detail::filled<FxLayerTextures>(
            [&](auto* out) { return fxView_GetLayerTextures(get(), out); });
    }

    FxOutputTextures outputTextures()
    {
        return detail::filled<FxOutputTextures>(
            [&](auto* out) { return fxView_GetOutputTextures(get(), out); });
    }

    FxView* get() const noexcept { return view_.get(); }

private:
    detail::Owner<FxView> view_;
};

} // namespace fxsdk

#endif
