#include "rendering/view/frame_builder.h"

#include "rendering/view/blob_shading.h"

#include <glm/geometric.hpp>

namespace fx::render {

FrameBuilder::FrameBuilder(std::pmr::memory_resource* memory)
    : gathered_(memory), gridBlobs_(memory), instances_(memory), shaded_(memory), sorted_(memory),
      distances_(memory), fires_(memory), grid_(memory), depthSort_(memory)
{}

void FrameBuilder::build(const base::SnapshotPair& snapshots, const FrameRequest& request,
                         const ViewSettings& settings, const CameraGeometry& camera)
{
    gathered_.clear();
    gridBlobs_.clear();
    instances_.clear();
    counts_ = gatherBlobs(snapshots, request.interpolation, camera, request.targets.height, gathered_,
                          gridBlobs_, instances_, settings.particleShare);
    shade(snapshots, settings, camera);
    sort(camera);
}

void FrameBuilder::shade(const base::SnapshotPair& snapshots, const ViewSettings& settings,
                         const CameraGeometry& camera)
{
    lightCount_ = snapshots.newer ? effectLights(*snapshots.newer, lights_) : 0;
    fires_.clear();
    for (const EffectLight& light : lights())
        fires_.emplace_back(glm::vec3(light.position - camera.eye), light.intensity, light.radius);

    const DirectionalLight sun(settings.lighting.sunDirection, settings.lighting.sunIlluminance);
    const ShadingContext context{
        &settings.lighting,  &sun,          &grid_, fires_, exposureFromEv100(settings.exposureEv100),
        camera.orthographic, camera.forward};
    anyHeat_ = false;
    anyDetail_ = false;
    shaded_.clear();
    for (const InstanceBlobs& instance : instances_)
    { // each effect shadows itself: its grid fits it, wherever others are
        if (instance.visibleBegin == instance.visibleEnd)
            continue;
        grid_.build(
            std::span(gridBlobs_).subspan(instance.mediumBegin, instance.mediumEnd - instance.mediumBegin));
        for (size_t i = instance.visibleBegin; i < instance.visibleEnd; ++i) {
            const GatheredBlob& blob = gathered_[i];
            shaded_.push_back(shadeBlob(blob, context));
            anyHeat_ = anyHeat_ || blob.heat > 0.0f;
            anyDetail_ = anyDetail_ || blob.detailAmount > 0.0f;
        }
    }
}

void FrameBuilder::sort(const CameraGeometry& camera)
{
    distances_.clear();
    for (const GatheredBlob& blob : gathered_)
        distances_.push_back(camera.orthographic ? glm::dot(blob.center, camera.forward)
                                                 : glm::dot(blob.center, blob.center));
    sorted_.clear();
    order_ = depthSort_.farthestFirst(distances_);
    isParallel_ = camera.orthographic;
    for (const uint32_t index : order_)
        sorted_.push_back(shaded_[index]);
}

DrawStream FrameBuilder::stream() const
{
    DrawStream stream;
    stream.count = uint32_t(order_.size());
    stream.distances = distances_.data();
    stream.order = order_.data();
    stream.isSquared = !isParallel_;
    return stream;
}

} // namespace fx::render
