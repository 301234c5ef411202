/// @file light.cpp
/// How media are lit by OpenGL: with light that is scattered once against the ray integral with exact shadow
/// rays, with the closed form of all light against paths, with and without the shadows of light slices.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/accuracy/techniques/light_clouds.h"
#include "benchmarks/scenes/lit_media.h"
#include "rendering/lights/slices/slice_stack.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

namespace fx::cli {
namespace {

/// A scene of examples/scenes without its level.
struct MediaScene
{
    const char* name;
    double time; ///< [s]
    glm::dvec3 eye, target;
    double fovYDegrees;
};
constexpr std::array<MediaScene, 3> kPresets{{
    {"smoke-column", 6.0, {6.0, 2.2, 20.0}, {0.0, 7.0, 0.0}, 55.0},
    {"steam", 4.0, {1.0, 1.7, 7.0}, {0.0, 1.7, 0.0}, 45.0},
    {"dust-burst", 1.0, {1.0, 1.8, 9.0}, {0.0, 1.2, 0.0}, 45.0},
}};

struct LitSetting
{
    const char* name;
    const char* tier;
    bool slices;
    bool multiple; ///< the truth is path traced
    bool sky;
    int samples;          ///< of the sun's light on a ray; 4: and as many planes and texels as there may be
    int voxels = 0;       ///< of the composition volume; 0: another
    int networkCells = 0; ///< of its illumination network; 0: none
    int slabs = 0;        ///< of the composition slabs; 0: another
    int planes = 32;      ///< of the light slices of the sun
};
constexpr std::array<LitSetting, 16> kSettings{
    {{"single", "", true, false, true, 2},
     {"single-no-slices", "", false, false, true, 2},
     {"single-sun", "", true, false, false, 2},
     {"single-sun-1", "", true, false, false, 1},
     {"single-sun-fine", "", true, false, false, 4},
     {"single-sun-no-slices", "", false, false, false, 2},
     {"single-sun-volume", "", true, false, false, 2, 96},
     {"single-sun-slabs", "", true, false, false, 2, 0, 0, 16},
     {"single-sun-slabs-64", "", true, false, false, 2, 0, 0, 16, 64},
     {"single-sun-volume-64", "", true, false, false, 2, 96, 0, 0, 64},
     {"multiple", "default", true, true, true, 2},
     {"multiple-no-slices", "", false, true, true, 2},
     {"volume", "", true, true, true, 2, 96},
     {"network-24", "", true, true, true, 2, 96, 24},
     {"network-32", "", true, true, true, 2, 96, 32},
     {"network-48", "", true, true, true, 2, 96, 48}}};

/// Size of the light slices that a setting uses.
render::SliceResolution resolutionOf(const LitSetting& setting)
{
    render::SliceResolution resolution;
    resolution.planes = setting.planes;
    if (setting.samples == 4)
        resolution = {render::kMaxSliceTexels, render::kMaxSlicePlanes};
    return resolution;
}

/// [s] in which the path tracer has the error `rms`: its variance goes with one over its time. An error that
/// is not told from the reference's noise counts as that noise, so that the time is too short rather than
/// too long.
/// @param differences to the reference, in the unit of `rms`: they have its noise, which `rms` has not
double secondsOfPaths(const LitPicture& reference, const std::vector<double>& differences, double rms)
{
    double squares = 0.0;
    for (const double difference : differences)
        squares += difference * difference;
    const double noise = std::max(squares / double(std::max<size_t>(differences.size(), 1)) - rms * rms, 0.0);
    return reference.seconds * noise / std::max({rms * rms, noise, 1e-30});
}

class LightAccuracy final : public AccuracyTechnique
{
public:
    explicit LightAccuracy(const std::string& scene) : scene_(scene)
    {
        size_ = {128, 72, 64, 4, 3};
        for (const MediaScene& preset : kPresets)
            if (scene == preset.name) {
                preset_ = &preset;
                view_.eye = preset.eye;
                view_.target = preset.target;
                view_.fovYDegrees = preset.fovYDegrees;
            }
        if (!preset_)
            size_ = {scene == "blobs-270" ? 72 : 32, scene == "blobs-270" ? 72 : 32, 64, 1, 3};
        for (const LitSetting& setting : kSettings)
            settings_.push_back({setting.name,
                                 setting.tier,
                                 {{"slices", setting.slices},
                                  {"scattering", setting.networkCells > 0 ? "network"
                                                 : setting.multiple       ? "multiple"
                                                                          : "single"},
                                  {"voxels", setting.voxels},
                                  {"network_cells", setting.networkCells},
                                  {"slabs", setting.slabs},
                                  {"planes", resolutionOf(setting).planes},
                                  {"sky", setting.sky},
                                  {"samples", setting.samples}}});
    }

    std::string_view scene() const override { return scene_; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }
    base::Result<AccuracySample> run(size_t setting, const std::function<bool()>& stop) override;

private:
    base::Status start();
    LitView viewOf(const LitSetting& setting) const;
    /// Made when it is needed.
    base::Result<const LitPicture*> truthOf(const LitSetting& setting, const std::function<bool()>& stop);

    std::string scene_;
    const MediaScene* preset_ = nullptr; ///< null: 270 blobs in a ball
    LitSize size_;
    LitView view_;
    std::vector<AccuracySetting> settings_;
    std::vector<render::MediumBlob> blobs_;
    std::unique_ptr<LitPainter> painter_;
    std::optional<LitPicture> truths_[2][2]; ///< [multiple][sky]
};

base::Status LightAccuracy::start()
{
    if (painter_)
        return {};
    if (preset_) {
        auto blobs = presetMedia(preset_->name, preset_->time);
        if (!blobs.ok())
            return blobs.status();
        blobs_ = std::move(*blobs);
    } else {
        blobs_ = blobsOf({270, 0.3, 4.0, 0.9, 0.5});
    }
    auto painter = LitPainter::create(size_.width, size_.height);
    if (!painter.ok())
        return painter.status();
    painter_ = std::move(*painter);
    return {};
}

LitView LightAccuracy::viewOf(const LitSetting& setting) const
{
    LitView view = view_;
    view.lighting = daylight();
    if (!setting.sky) {
        view.lighting.skyLuminance = glm::vec3(0.0f);
        view.lighting.groundAlbedo = 0.0f;
    }
    return view;
}

base::Result<const LitPicture*> LightAccuracy::truthOf(const LitSetting& setting,
                                                       const std::function<bool()>& stop)
{
    std::optional<LitPicture>& truth = truths_[setting.multiple ? 1 : 0][setting.sky ? 1 : 0];
    if (!truth) {
        auto picture = (setting.multiple ? traced : integrated)(blobs_, viewOf(setting), size_, stop);
        if (!picture.ok())
            return picture.status();
        truth = std::move(*picture);
    }
    return const_cast<const LitPicture*>(&*truth);
}

base::Result<AccuracySample> LightAccuracy::run(size_t index, const std::function<bool()>& stop)
{
    if (base::Status status = start(); !status)
        return status;
    const LitSetting& setting = kSettings[index];
    const auto truth = truthOf(setting, stop);
    if (!truth.ok())
        return truth.status();
    render::SliceSettings slices;
    slices.enabled = setting.slices;
    slices.multiple = setting.multiple;
    slices.samples = setting.samples;
    slices.network = setting.networkCells > 0;
    slices.networkCells = uint8_t(setting.networkCells);
    slices.resolution = resolutionOf(setting);
    painter_->settings().composition = setting.voxels > 0  ? render::Composition::Volume
                                       : setting.slabs > 0 ? render::Composition::Slabs
                                                           : render::Composition::Sorted;
    painter_->settings().voxels = std::max(setting.voxels, 16);
    painter_->settings().slabs = std::max(setting.slabs, 6);
    // The first picture compiles programs; without media the light of networks is forgotten.
    for (const bool isEmpty : {false, true})
        if (const auto warm = painter_->paint(isEmpty ? std::span<const render::MediumBlob>() : blobs_,
                                              viewOf(setting), slices);
            !warm.ok())
            return warm.status();
    const auto picture = painter_->paint(blobs_, viewOf(setting), slices);
    if (!picture.ok())
        return picture.status();
    AccuracySample sample;
    std::vector<double> errors;
    const double rms = relativeError(*picture, **truth, &errors);
    const double sameError = secondsOfPaths(**truth, errors, rms);
    storeErrors(std::move(errors), sample);
    sample.seconds = picture->seconds;
    sample.items = double(picture->light.size());
    const double brightness = meanLight(*picture) / meanLight(**truth);
    sample.work = {{"blobs", blobs_.size()},
                   {"error_rms", rms},
                   {"brightness", brightness},
                   {"noise", std::sqrt((*truth)->variance)},
                   {"seconds_reference", (*truth)->seconds}};
    if (setting.multiple) { // the reference is path traced
        sample.work["seconds_paths"] = sameError;
        sample.work["times_faster"] = sameError / picture->seconds;
    }
    char note[96];
    std::snprintf(note, sizeof note, "RMSE %.1f %%, mean %+.1f %%", 1e2 * rms, 1e2 * (brightness - 1.0));
    sample.note = note;
    if (setting.multiple) {
        std::snprintf(note, sizeof note, ", %.3g s for %.3g s of paths", picture->seconds, sameError);
        sample.note += note;
    }
    return sample;
}

std::unique_ptr<AccuracyTechnique> make(const std::string& scene, const AccuracyScale&)
{
    if (scene.rfind("clouds", 0) == 0)
        return makeLightClouds(scene == "clouds-small");
    return std::make_unique<LightAccuracy>(scene);
}

} // namespace

AccuracyTechniqueEntry lightAccuracy()
{
    return {"light",
            "media in light by OpenGL, against exact single scattering and against paths",
            "pixel",
            ShownError::Mean,
            {"smoke-column", "steam", "dust-burst", "blobs-270", "clouds", "blobs-270-small", "clouds-small"},
            4,
            false,
            make};
}

} // namespace fx::cli
