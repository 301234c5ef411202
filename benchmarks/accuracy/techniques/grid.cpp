/// @file grid.cpp
/// A medium on voxels: opacity by OpenGL in each composition, and of coarser voxels, against the ray integral
/// through the voxels.

#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/scenes/detail_scene.h"
#include "benchmarks/scenes/volume_scene.h"
#include "fxsdk/cli/import/brick_volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

namespace fx::cli {
namespace {

constexpr double kDistance = 5.0; ///< [m] of the eye from the center of the cloud
constexpr double kHalf = 1.2;     ///< [m] half of the side of the picture, at the center of the cloud

struct GridScene
{
    const char* name;
    double depth; ///< [1] through the middle
    double side;  ///< [m] of a voxel
    int pixels;   ///< along a side of the picture
    int rays;     ///< along a side of a pixel; opacity is the mean over the rays
};
/// Pixels of 0.019 m at the center of the cloud, of 0.023 at its far end; of `coarse-pixels` four times as
/// large, so that the view replaces the voxels by larger ones.
constexpr std::array<GridScene, 5> kScenes{{{"tau-1", 1.0, 0.025, 128, 1},
                                            {"tau-5", 5.0, 0.025, 128, 1},
                                            {"tau-20", 20.0, 0.025, 128, 1},
                                            {"coarse-pixels", 5.0, 0.025, 32, 8},
                                            {"tau-5-small", 5.0, 0.1, 32, 1}}};

struct GridSetting
{
    const char* name;
    const char* tier;
    render::Composition composition;
    int slabs;
    double coarser; ///< [1] times the side of the scene's voxels
};
constexpr std::array<GridSetting, 6> kSettings{
    {{"sorted", "", render::Composition::Sorted, 16, 1.0},
     {"slabs-6", "", render::Composition::Slabs, 6, 1.0},
     {"slabs-16", "", render::Composition::Slabs, 16, 1.0},
     {"volume", "default", render::Composition::Volume, 16, 1.0},
     {"volume-half", "", render::Composition::Volume, 16, 2.0},
     {"volume-quarter", "", render::Composition::Volume, 16, 4.0}}};

double opacityOf(double depth)
{
    return -std::expm1(-depth);
}

class GridAccuracy final : public AccuracyTechnique
{
public:
    explicit GridAccuracy(const GridScene& scene) : scene_(scene), tasks_(base::makeTbbRunner())
    {
        for (const GridSetting& setting : kSettings)
            settings_.push_back({setting.name, setting.tier, {{"voxel_side", scene.side * setting.coarser}}});
    }

    std::string_view scene() const override { return scene_.name; }
    const std::vector<AccuracySetting>& settings() const override { return settings_; }

    base::Result<AccuracySample> run(size_t index, const std::function<bool()>& stop) override
    {
        const GridSetting& setting = kSettings[index];
        if (truth_.empty())
            if (base::Status status = integrate(); !status)
                return status;
        if (stop())
            return base::Status(base::Code::Interrupted, "interrupted");
        const auto volume = volumeOf(setting.coarser);
        if (!volume.ok())
            return volume.status();
        render::ViewSettings view = detailViewSettings();
        view.composition = setting.composition;
        view.slabs = setting.slabs;
        auto renderer = SnapshotRenderer::create((*volume)->schema(), view, scene_.pixels, scene_.pixels);
        if (!renderer.ok())
            return renderer.status();
        (*renderer)->setAssets(&(*volume)->assets());
        for (int i = 0; i < 2; ++i) // the first compiles and uploads
            if (base::Status status = (*renderer)->render((*volume)->moment(), camera(), 0.0); !status)
                return status;
        return sampleOf((*renderer)->read().color, 1e-3 * (*renderer)->millisecondsRender(),
                        (*renderer)->device().textureBytes() + (*renderer)->device().bufferBytes());
    }

private:
    static render::ReferenceCamera camera()
    {
        const glm::dvec3 eye = kDistance * glm::dvec3(0.6, 0.48, 0.64);
        auto camera = render::ReferenceCamera::lookAt(eye, glm::dvec3(0.0), {0.0, 1.0, 0.0});
        camera.halfHeight = kHalf / kDistance;
        camera.nearDistance = 1e-3;
        return camera;
    }

    base::Result<std::unique_ptr<VolumeScene>> volumeOf(double coarser)
    {
        auto volume = voxelVolumeOf(lumpyGrid(scene_.depth, scene_.side * coarser, *tasks_), 0.0);
        if (!volume)
            return volume.status();
        return VolumeScene::create(std::move(*volume));
    }

    base::Status integrate()
    {
        const auto volume = volumeOf(1.0);
        if (!volume.ok())
            return volume.status();
        const int side = scene_.pixels * scene_.rays;
        const std::vector<float> depths = integratedDepth((*volume)->reference(camera()), side, side);
        truth_.assign(size_t(scene_.pixels) * size_t(scene_.pixels), 0.0);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                truth_[size_t(y / scene_.rays * scene_.pixels + x / scene_.rays)] +=
                    opacityOf(double(depths[size_t(y * side + x)])) / (scene_.rays * scene_.rays);
        return {};
    }

    /// Errors of covered pixels, relative to the largest opacity of the picture.
    AccuracySample sampleOf(const Picture& drawn, double seconds, uint64_t bytes) const
    {
        const double largest = *std::ranges::max_element(truth_);
        std::vector<double> errors;
        for (size_t i = 0; i < truth_.size(); ++i) {
            const double is = double(drawn.pixels[4 * i + 3]);
            if (truth_[i] > kCovered || is > kCovered)
                errors.push_back((is - truth_[i]) / largest);
        }
        AccuracySample sample;
        sample.items = double(truth_.size());
        sample.seconds = seconds;
        sample.work = {{"covered", errors.size()}, {"bytes", bytes}, {"largest_opacity", largest}};
        storeErrors(std::move(errors), sample);
        return sample;
    }

    static constexpr double kCovered = 1e-3; ///< [1] opacity

    GridScene scene_;
    std::unique_ptr<base::TaskRunner> tasks_;
    std::vector<AccuracySetting> settings_;
    std::vector<double> truth_; ///< opacities
};

std::unique_ptr<AccuracyTechnique> make(const std::string& name, const AccuracyScale&)
{
    const auto scene = std::ranges::find(kScenes, name, &GridScene::name);
    return std::make_unique<GridAccuracy>(*scene);
}

} // namespace

AccuracyTechniqueEntry gridAccuracy()
{
    return {"grid",
            "a medium on voxels: opacity by OpenGL against the ray integral through the voxels",
            "pixel",
            ShownError::P99,
            {"tau-1", "tau-5", "tau-20", "coarse-pixels", "tau-5-small"},
            4,
            false,
            make};
}

} // namespace fx::cli
