#include "rendering/view/frame_builder.h"

#include "rendering/view/blob_shading.h"

#include <glm/geometric.hpp>

#include <array>

namespace fx::render {

namespace {
constexpr size_t kMostFires = 4; ///< that light the smoke; more of them are too dim to tell
}

FrameBuilder::FrameBuilder(std::pmr::memory_resource* memory)
    : gathered_(memory), gridBlobs_(memory), shaded_(memory), sorted_(memory), distances_(memory),
      fires_(memory), grid_(memory), depthSort_(memory)
{}

void FrameBuilder::build(const base::SnapshotPair& snapshots, const FrameRequest& request,
                         const ViewSettings& settings, const CameraGeometry& camera)
{
    gathered_.clear();
    gridBlobs_.clear();
    counts_ =
        gatherBlobs(snapshots, request.interpolation, camera, request.targets.height, gathered_, gridBlobs_);
    shade(snapshots, settings, camera);
    sort(camera);
}

void FrameBuilder::shade(const base::SnapshotPair& snapshots, const ViewSettings& settings,
                         const CameraGeometry& camera)
{
    grid_.build(gridBlobs_);

    std::array<EffectLight, kMostFires> lights;
    const size_t lightCount = snapshots.newer ? effectLights(*snapshots.newer, lights) : 0;
    fires_.clear();
    for (size_t i = 0; i < lightCount; ++i)
        fires_.emplace_back(glm::vec3(lights[i].position - camera.eye), lights[i].intensity,
                            lights[i].radius);

    const ShadingContext context{
        &settings.lighting,  &grid_,        fires_, exposureFromEv100(settings.exposureEv100),
        camera.orthographic, camera.forward};
    anyHeat_ = false;
    anyDetail_ = false;
    shaded_.clear();
    for (const GatheredBlob& blob : gathered_) {
        shaded_.push_back(shadeBlob(blob, context));
        anyHeat_ = anyHeat_ || blob.heat > 0.0f;
        anyDetail_ = anyDetail_ || blob.detailAmount > 0.0f;
    }
}

void FrameBuilder::sort(const CameraGeometry& camera)
{
    distances_.clear();
    for (const GatheredBlob& blob : gathered_)
        distances_.push_back(camera.orthographic ? glm::dot(blob.center, camera.forward)
                                                 : glm::dot(blob.center, blob.center));
    sorted_.clear();
    for (const uint32_t index : depthSort_.farthestFirst(distances_))
        sorted_.push_back(shaded_[index]);
}

} // namespace fx::render
