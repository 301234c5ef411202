#include "fxsdk/editor/preview/preview.h"

#include "fxsdk/assets/asset_resolver.h"
#include "fxsdk/assets/read_file.h"
#include "fxsdk/cli/scene/api_status.h"
#include "fxsdk/cli/scene/default_stage.h"
#include "fxsdk/cli/scene/instance_definition.h"
#include "fxsdk/cli/scene/view_settings.h"
#include "fxsdk/editor/preview/instance_motion.h"
#include "fxsdk/editor/preview/overlay_data.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/techniques.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory_resource>

namespace fx::editor {

namespace {

constexpr const char* kEdited = "edited-text.fx.json"; // the name by which the context reads an edited text
constexpr double kStep = 1.0 / 60.0;                   // [s] of the scene
constexpr float kNear = 0.05f;                         // [m]
constexpr double kFramedSeconds = 4.0;                 // longest time simulated to place a camera

base::Status statusOf(const fxsdk::Error& error)
{
    return {base::Code(error.code()), error.what()};
}

/// The name of the file instead of that by which the context reads its text.
base::Status loadStatus(const fxsdk::Error& error, const std::string& file)
{
    std::string message = error.what();
    constexpr std::string_view kCall = "fxLoadPresetFile: ", kName = kEdited;
    if (message.starts_with(kCall))
        message.erase(0, kCall.size());
    for (size_t at = message.find(kName); at != std::string::npos; at = message.find(kName, at + file.size()))
        message.replace(at, kName.size(), file);
    return {base::Code(error.code()), message};
}

/// What stage and camera depend on.
std::string stageKeyOf(const std::string& text, DocumentKind kind, MotionKind motion)
{
    if (kind == DocumentKind::Scene)
        return text;
    const Json preset = Json::parse(text, nullptr, false);
    if (!preset.is_object() || !preset.contains("preview"))
        return "none";
    // Triggers name events of the emitters.
    const bool namesEvents = motion == MotionKind::Document && preset["preview"].contains("instance");
    return namesEvents ? text : preset["preview"].dump();
}

/// Pointers of the elements of a preset in the order in which they become solvers.
std::vector<std::string> elementsOf(const std::string& text)
{
    const Json preset = Json::parse(text, nullptr, false);
    std::vector<std::string> elements;
    for (const preset::Technique& technique : preset::techniques()) {
        const std::string name(technique.presetMember);
        const size_t count = preset.is_object() && preset.contains(name) ? preset[name].size() : 0;
        for (size_t i = 0; i < count; ++i)
            elements.push_back("/" + name + "/" + std::to_string(i));
    }
    return elements;
}

std::string motionKeyOf(const MotionChoice& motion)
{
    return std::to_string(int(motion.kind)) + " " + std::to_string(motion.radius) + " " +
           std::to_string(motion.speed) + " ";
}

/// Local time [s] at which an instance begins: what its preset simulates before its first step.
double prewarmOf(const std::string& text)
{
    const Json preset = Json::parse(text, nullptr, false);
    const auto member = preset.is_object() ? preset.find("prewarm") : preset.end();
    return preset.is_object() && member != preset.end() && member->is_number() ? member->get<double>() : 0.0;
}

} // namespace

base::Result<std::unique_ptr<Preview>> Preview::create(const render::GlLoader& loader)
{
    std::unique_ptr<Preview> preview(new Preview);
    if (base::Status status = preview->start(loader); !status)
        return status;
    return preview;
}

Preview::~Preview()
{
    view_.reset();
    fxScene_.reset();
    context_.reset();
    stage_.reset();
}

base::Status Preview::start(const render::GlLoader& loader)
{
    auto device = render::GlDevice::create(loader, std::pmr::get_default_resource());
    if (!device)
        return device.status();
    device_ = std::move(*device);
    stage_ = std::make_unique<render::StageRenderer>(device_.get());
    try {
        FxContextDef def = fxDefaultContextDef();
        def.gl = {loader.user, loader.getProcAddress};
        def.assets = {this, &openAsset, &closeAsset};
        def.flags = FX_CONTEXT_PLACEHOLDERS;
        context_ = std::make_unique<fxsdk::Context>(def);
        fxScene_ = newScene();
        view_ = std::make_unique<fxsdk::View>(*context_, *fxScene_);
    } catch (const fxsdk::Error& error) {
        return statusOf(error);
    }
    return {};
}

std::unique_ptr<fxsdk::Scene> Preview::newScene() const
{
    FxSceneDef def = fxDefaultSceneDef();
    def.workBudget = 0; // a seek ends before the picture
    return std::make_unique<fxsdk::Scene>(*context_, def);
}

const void* Preview::openAsset(void* user, const char* name, size_t* outSize)
{
    const auto& self = *static_cast<const Preview*>(user);
    auto bytes = std::string_view(name) == kEdited
                     ? base::Result<std::string>(self.assetText_)
                     : asset::readFile(self.assetFolder_ + name, scene_file::kImageBytes);
    if (!bytes)
        return nullptr;
    *outSize = bytes->size();
    auto copy = std::make_unique_for_overwrite<char[]>(bytes->size() + 1);
    std::copy(bytes->begin(), bytes->end(), copy.get());
    return copy.release();
}

void Preview::closeAsset(void*, const void* data, size_t)
{
    delete[] static_cast<const char*>(data);
}

/// Reads stage, camera and instances with the chosen motion, and places the camera of a preset without one.
base::Result<scene_file::SceneFile> Preview::readScene(const std::string& text, const std::string& name,
                                                       DocumentKind kind, bool& outHasCamera) const
{
    const std::string folder = preset::folderOf(name);
    const asset::AssetResolver resolver(folder.empty() ? "." : folder, preset::libraryFiles());
    scene_file::Preview preview;
    auto file = kind == DocumentKind::Scene ? scene_file::loadSceneText(text, name, resolver)
                                            : cli::sceneOfPresetText(text, name, &preview);
    if (!file)
        return file.status();
    outHasCamera = kind == DocumentKind::Scene || preview.hasCamera;
    if (!outHasCamera && isFirst_) // reads the file, which may be gone: the camera then stays where it is
        (void)cli::frameEffect(*file, base::toTicks(kFramedSeconds), {});
    else if (!outHasCamera && !hasCamera_)
        file->camera = file_.camera;
    for (scene_file::SceneInstance& instance : file->instances)
        editor::setMotion(motion_, preview.time.value_or(instance.start), instance);
    cli::followPresets(*file);
    return file;
}

/// Takes over lights, mesh and background.
base::Status Preview::setStage(const scene_file::SceneFile& file)
{
    std::vector<FxLight> lights;
    for (const render::SceneLight& light : shownLights(file))
        lights.push_back(cli::toApi(light));
    if (base::Status status =
            cli::toStatus(fxView_SetLights(view_->get(), lights.data(), uint32_t(lights.size())));
        !status)
        return status;
    if (base::Status status = stage_->setMesh(file.mesh); !status)
        return status;
    return stage_->setBackground(file.background);
}

base::Result<std::vector<FxPresetId>>
Preview::loadPresets(const std::vector<scene_file::ScenePreset>& presets)
{
    std::vector<FxPresetId> loaded;
    std::string name;
    try {
        for (const scene_file::ScenePreset& preset : presets) {
            assetText_ = preset.text;
            assetFolder_ = preset::folderOf(preset.file);
            name = preset.name;
            loaded.push_back(context_->loadFile(kEdited));
        }
    } catch (const fxsdk::Error& error) {
        unload(loaded);
        return loadStatus(error, name);
    }
    return loaded;
}

void Preview::unload(const std::vector<FxPresetId>& presets)
{
    for (const FxPresetId preset : presets)
        (void)fxUnloadPreset(context_->get(), preset);
}

/// All that can fail comes first, so that stage, presets and instances always belong to one text.
base::Status Preview::show(const std::string& text, const std::string& name, DocumentKind kind)
{
    std::string key = motionKeyOf(motion_) + stageKeyOf(text, kind, motion_.kind);
    std::optional<scene_file::SceneFile> file; // empty: only the preset differs
    bool hasCamera = hasCamera_;
    if (key != stageKey_ || isFirst_) {
        auto read = readScene(text, name, kind, hasCamera);
        if (!read)
            return read.status();
        file = std::move(*read);
    }
    std::vector<scene_file::ScenePreset> presets = file ? file->presets : file_.presets;
    if (kind == DocumentKind::Preset)
        presets[0].text = text;
    auto loaded = loadPresets(presets);
    if (!loaded)
        return loaded.status();
    if (file) {
        if (base::Status status = setStage(*file); !status) {
            unload(*loaded);
            if (!isFirst_)
                (void)setStage(file_);
            return status;
        }
        file_ = std::move(*file);
        stageKey_ = std::move(key);
        hasCamera_ = hasCamera;
        isFirst_ = false;
    }
    file_.presets = std::move(presets);
    elements_ = kind == DocumentKind::Preset ? elementsOf(text) : std::vector<std::string>();
    for (const Shown& shown : shown_)
        if (shown.id && fxScene_->isValid(*shown.id))
            fxScene_->destroy(*shown.id);
    unload(presets_);
    presets_ = std::move(*loaded);
    shown_.assign(file_.instances.size(), {});
    prewarms_.clear();
    for (const scene_file::ScenePreset& preset : file_.presets)
        prewarms_.push_back(prewarmOf(preset.text));
    director_.reset();
    return seek(time_);
}

/// A new instance begins with the next step.
void Preview::create(size_t index)
{
    const scene_file::SceneInstance& instance = file_.instances[index];
    FxInstanceDef def = cli::instanceDefinition(instance, presets_[instance.preset], instance.start);
    def.quality = simulationQuality_;
    shown_[index] = {fxScene_->create(def), -1.0};
}

/// Seeks one instance. One that has ended by then is not shown. @param seconds since its start
void Preview::place(size_t index, double seconds)
{
    Shown& shown = shown_[index];
    for (int attempt = 0; attempt < 2; ++attempt) {
        if (!shown.id) {
            create(index);
            (void)step(); // without a director it only throws
        }
        const double local = seconds + prewarms_[file_.instances[index].preset];
        if (fxScene_SeekInstance(fxScene_->get(), *shown.id, local) == FX_OK) {
            shown.at = seconds;
            return;
        }
        fxScene_->destroy(*shown.id);
        shown.id.reset();
    }
}

/// Creates a new scene, because the clock of a scene cannot go back.
void Preview::restart()
{
    std::unique_ptr<fxsdk::Scene> scene = newScene();
    view_->setScene(*scene);
    fxScene_ = std::move(scene);
    director_ = std::make_unique<cli::InstanceDirector>();
    step_ = 0;
    for (size_t i = 0; i < shown_.size(); ++i) {
        const scene_file::SceneInstance& instance = file_.instances[i];
        FxInstanceDef def = cli::instanceDefinition(instance, presets_[instance.preset], instance.start);
        def.startTick = base::toTicks(instance.start);
        def.quality = simulationQuality_;
        shown_[i] = {fxScene_->create(def), -1.0};
        director_->add(instance, *shown_[i].id);
    }
}

/// Plays the steps up to a time as fx render does; back in time from the beginning.
base::Status Preview::seekPlayed(double seconds)
{
    const int64_t target = std::llround(seconds / kStep) + 1; // the picture is between the last two steps
    if (!director_ || step_ > target)
        restart();
    while (step_ < target)
        if (base::Status status = step(); !status)
            return status;
    return {};
}

/// Takes one step of the scene.
base::Status Preview::step()
{
    if (director_) {
        constexpr base::Ticks kTicks = base::kTicksPerSecond / 60;
        const base::Ticks from = step_ * kTicks;
        if (base::Status status = director_->beforeStep(fxScene_->get(), from, from + kTicks); !status)
            return status;
    }
    fxScene_->update(kStep);
    ++step_;
    return {};
}

base::Status Preview::seek(double seconds)
{
    time_ = seconds;
    try {
        if (isPlayed(file_))
            return seekPlayed(seconds);
        for (size_t i = 0; i < shown_.size(); ++i) {
            const double local = seconds - file_.instances[i].start;
            if (local < 0.0 && shown_[i].id) {
                fxScene_->destroy(*shown_[i].id);
                shown_[i].id.reset();
            }
            if (local >= 0.0 && (!shown_[i].id || shown_[i].at != local))
                place(i, local);
        }
        fxScene_->update(0.0);
    } catch (const fxsdk::Error& error) {
        return statusOf(error);
    }
    return {};
}

uint32_t Preview::particles()
{
    uint32_t sum = 0;
    for (const Shown& shown : shown_) {
        uint32_t count = 0;
        if (shown.id && fxScene_GetInstanceState(fxScene_->get(), *shown.id, nullptr, &count) == FX_OK)
            sum += count;
    }
    return sum;
}

std::map<std::string, uint32_t> Preview::elementCounts() const
{
    std::map<std::string, uint32_t> counts;
    if (isFirst_ || elements_.empty())
        return counts;
    const std::vector<uint32_t> bySolver = countsBySolver(*fxScene_, elements_.size());
    for (size_t i = 0; i < elements_.size(); ++i)
        counts[elements_[i]] = bySolver[i];
    return counts;
}

FxViewSettings Preview::settingsOf(const PreviewFrame& frame) const
{
    FxViewSettings settings = cli::toApi(file_.view);
    settings.exposureEv100 = frame.exposureEv100.value_or(settings.exposureEv100);
    settings.toneMap = frame.isLinear ? 0 : 1;
    if (frame.quality != PreviewQuality::High) {
        settings.billboardForm = FX_BILLBOARD_CONSTANT;
        settings.detail = 0;
    }
    if (frame.quality == PreviewQuality::Low)
        settings.shimmerStrength = 0.0f;
    if (frame.isLinear) {
        settings.shimmerStrength = 0.0f;
        settings.dazzle = 0;
        settings.multipleScattering = 0;
    }
    settings.dazzleRiseTime = settings.dazzleFallTime = 0.0f; // a still has no history
    return settings;
}

EffectPlacement Preview::placement() const
{
    if (file_.instances.empty())
        return {};
    const scene_file::SceneInstance& instance = file_.instances.front();
    const base::Placement place = instance.placementAt(time_);
    return {place.position, glm::dquat(place.rotation), double(instance.scale)};
}

OverlayData Preview::overlays(const OverlayChoice& choice, const PreviewFrame& frame)
{
    OverlayData data;
    if (isFirst_)
        return data;
    if (choice.bounds || choice.velocities)
        addParticleWires(*fxScene_, choice, data);
    if (choice.overdraw || choice.slice) {
        OrbitCamera camera;
        camera.look(frame.pose.position, frame.pose.target);
        camera.fovYDegrees = frame.fovYDegrees;
        const ViewProjection view(camera, {0.0, 0.0}, {double(frame.width), double(frame.height)});
        if (choice.overdraw)
            data.overdraw = overdrawOf(*fxScene_, view, frame.width, frame.height);
        if (choice.slice)
            data.slice = sliceOf(*fxScene_, view, frame.width, frame.height, frame.pose.target);
    }
    if (choice.lightSlices)
        addLightSlices(lit_.lighting().sunShadow, cameraOf(frame).origin, data);
    return data;
}

std::vector<std::string> Preview::causes(const PreviewFrame& frame)
{
    const FxFrameDef camera = frameOf(cameraOf(frame), frame);
    std::vector<std::string> causes;
    for (size_t i = 0; i < shown_.size(); ++i) {
        FxVisibility report{};
        report.structSize = sizeof report;
        const bool isShown = shown_[i].id && fxScene_ExplainVisibility(fxScene_->get(), *shown_[i].id,
                                                                       &camera, &report) == FX_OK;
        const std::string name = shown_.size() > 1 ? "Instance " + std::to_string(i) + ": " : std::string();
        causes.push_back(name + (isShown
                                     ? fxGetVisibilityText(report.cause)
                                     : "It has not started, or has ended by then: scrub to another time."));
    }
    return causes;
}

render::CameraView Preview::cameraOf(const PreviewFrame& frame)
{
    const float aspect = float(frame.width) / float(frame.height);
    return render::perspectiveView(frame.pose, glm::radians(frame.fovYDegrees), aspect, kNear);
}

FxFrameDef Preview::frameOf(const render::CameraView& camera, const PreviewFrame& frame)
{
    FxFrameDef def = fxDefaultFrameDef();
    for (int i = 0; i < 3; ++i)
        def.origin[i] = camera.origin[i];
    std::copy_n(glm::value_ptr(camera.view), 16, def.view);
    std::copy_n(glm::value_ptr(camera.projection), 16, def.projection);
    def.width = frame.width;
    def.height = frame.height;
    def.resetHistory = 1;
    return def;
}

/// Fires of the effects light the stage, and their media darken it.
base::Status Preview::lightStage(const FxFrameDef& frame)
{
    if (base::Status status = cli::toStatus(fxView_PrepareLights(view_->get(), &frame)); !status)
        return status;
    uint32_t count = 0;
    std::array<render::EffectLight, cli::kMaxStageEffects> lights;
    base::Status status = cli::toStatus(fxView_GetEffectLightCount(view_->get(), &count));
    count = std::min(count, uint32_t(lights.size()));
    for (uint32_t i = 0; i < count && status.ok(); ++i) {
        FxLight light = fxDefaultLight();
        status = cli::toStatus(fxView_GetEffectLight(view_->get(), i, &light));
        lights[i] = {glm::make_vec3(light.position), glm::make_vec3(light.intensity), light.radius};
    }
    return status.ok() ? lit_.read(view_->get(), std::span(lights).first(count), shownLights(file_),
                                   file_.view.lighting)
                       : status;
}

/// As many as a view takes.
std::span<const render::SceneLight> Preview::shownLights(const scene_file::SceneFile& file)
{
    return std::span(file.lights).first(std::min(file.lights.size(), size_t(FX_MOST_LIGHTS)));
}

base::Status Preview::render(const PreviewFrame& frame)
{
    return renderStages(frame, nullptr);
}

} // namespace fx::editor
