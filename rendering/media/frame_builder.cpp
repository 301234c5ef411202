#include "rendering/media/frame_builder.h"

#include "foundation/memory/amortized_vector.h"
#include "rendering/frame/exposure.h"
#include "rendering/optics/black_body.h"
#include "shaders/formulas/formula.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <numeric>

namespace fx::render {

namespace {

/// Emitted light of a blob, and its scattered light without shadows of media. The remaining light is computed
/// when the blob is drawn.
/// @param exposure [m2/cd] exposed value per luminance
BlobInstance shadeBlob(const GatheredBlob& blob, float exposure)
{
    const glm::vec3 thermal = blob.tint * blackBodyLuminance(blob.temperature);
    const glm::vec3 emitted = ((1.0f - blob.albedo) * thermal + blob.emission) * exposure;

    BlobInstance instance;
    instance.centerRadius = {blob.center, blob.radius};
    instance.medium = {blob.crossSection, blob.heat, blob.detailAmount, blob.seed};
    instance.scatter = {blob.albedo, blob.anisotropy};
    instance.layer = {float(blob.layer) * 2.0f + blob.fireShare, blob.rank, float(blob.tile), 0.0f};
    const glm::vec3 share = (1.0f - blob.albedo) * thermal * exposure;
    const float total = emitted.x + emitted.y + emitted.z;
    const float thermalShare = total > 0.0f ? (share.x + share.y + share.z) / total : 0.0f;
    instance.emission = {emitted, thermalShare * formula::fxBlackBodyContrast(blob.temperature)};
    instance.lit = {blob.center, blob.detailScale};
    return instance;
}

} // namespace

FrameBuilder::FrameBuilder(std::pmr::memory_resource* memory)
    : gathered_(memory), casters_(memory), instances_(memory), shaded_(memory), fields_(memory),
      materials_(memory), marks_(memory), sortedMarks_(memory), effects_(memory), radii_(memory),
      sorted_(memory), distances_(memory), depthSort_(memory), impostors_(memory), impostorSort_(memory),
      takenSort_(memory), sortedImpostors_(memory), taken_(memory), sortedTaken_(memory),
      takenDistances_(memory), identity_(memory), takenTiles_(memory)
{}

void FrameBuilder::build(const base::SnapshotPair& snapshots, const FrameRequest& request,
                         const ViewSettings& settings, const CameraGeometry& camera, LevelOfDetail& lod,
                         uint64_t content, bool castsShadows, bool isSorted, std::span<const LateBalls> late,
                         const CameraGeometry* otherEye)
{
    gathered_.clear();
    casters_.clear();
    instances_.clear();
    fields_.details.clear();
    fields_.volumes.clear();
    fields_.runs.clear();
    names_ = request.instances;
    isMarked_ = settings.outputs != 0;
    beginImpostors(request, settings, camera, content);
    counts_ = gatherBlobs(snapshots, request.interpolation, camera, request.targets.height, gathered_,
                          casters_, instances_, settings.particleShare, &lod, &impostors_, castsShadows,
                          isSorted ? nullptr : &fields_, late, otherEye);
    impostors_.end();
    shade(settings, camera, isSorted);
    sort(camera, isSorted);
    sortImpostors(camera);
    eye_ = camera.eye;
    isSorted_ = isSorted;
}

void FrameBuilder::turnTo(const CameraGeometry& camera)
{
    const glm::dvec3 way = eye_ - camera.eye;
    const glm::vec3 step(way);
    for (BlobInstance& blob : shaded_) {
        blob.centerRadius += glm::vec4(step, 0.0f);
        blob.lit += glm::vec4(step, 0.0f);
    }
    for (MediumCaster& caster : casters_)
        caster.center += step;
    for (BlobEffect& effect : effects_) {
        effect.low += step;
        effect.high += step;
    }
    for (GroupDetail& detail : fields_.details)
        for (int i = 0; i < 2; ++i)
            detail.first[i] -= detail.toCells[i] * step;
    for (GroupVolume& volume : fields_.volumes)
        volume.first -= volume.toVoxels * way;
    eye_ = camera.eye;
    sort(camera, isSorted_);
}

void FrameBuilder::beginImpostors(const FrameRequest& request, const ViewSettings& settings,
                                  const CameraGeometry& camera, uint64_t content)
{
    if (!(settings.lighting == lighting_ && settings.hostLights == hostLights_ &&
          settings.slices == slices_ && settings.exposureEv100 == exposureEv100_))
        ++lightingRevision_;
    lighting_ = settings.lighting;
    hostLights_ = settings.hostLights;
    slices_ = settings.slices;
    exposureEv100_ = settings.exposureEv100;
    const bool isAllowed = !settings.layerOutputs && settings.outputs == 0 && !camera.orthographic;
    const float most = isAllowed ? settings.lod.impostorPixels : 0.0f;
    impostors_.begin({std::min(most, LodSettings::kMaxImpostorPixels), request.deltaTime, content,
                      lightingRevision_, request.resetHistory || mustForget_, settings.lod.hold},
                     camera);
    mustForget_ = false;
}

void FrameBuilder::shade(const ViewSettings& settings, const CameraGeometry& camera, bool isSorted)
{
    const float exposure = exposureFromEv100(settings.exposureEv100);
    anyHeat_ = false;
    anyDetail_ = false;
    shaded_.clear();
    effects_.clear();
    taken_.clear();
    materials_.clear();
    marks_.clear();
    for (const InstanceBlobs& instance : instances_)
        for (size_t i = instance.visibleBegin; isSorted && i < instance.visibleEnd; ++i)
            shade(gathered_[i], instance, exposure, camera);
    for (const BlobRun& run : fields_.runs) {
        const size_t begin = shaded_.size();
        for (size_t i = run.visibleBegin; i < run.visibleEnd; ++i) {
            shade(gathered_[i], instances_[run.instance], exposure, camera);
            if (shaded_.size() > materials_.size())
                materials_.push_back({{glm::vec4(gathered_[i].carried[0], float(run.detail + 1)),
                                       glm::vec4(gathered_[i].carried[1], 0.0f)}});
        }
        if (shaded_.size() > begin)
            addEffect(run, begin);
    }
}

void FrameBuilder::shade(const GatheredBlob& blob, const InstanceBlobs& instance, float exposure,
                         const CameraGeometry& camera)
{
    add(shadeBlob(blob, exposure), instance.plan, camera);
    if (isMarked_ && shaded_.size() > marks_.size())
        marks_.push_back({glm::vec4(blob.velocity, 0.0f), instanceWords(names_.of(instance.instance))});
    anyHeat_ = anyHeat_ || (blob.heat > 0.0f && instance.plan.blobShare > 0.0f);
    anyDetail_ = anyDetail_ || blob.detailAmount > 0.0f;
}

void FrameBuilder::addEffect(const BlobRun& run, size_t begin)
{
    BlobEffect effect{uint32_t(begin),
                      uint32_t(shaded_.size()),
                      shaded_[begin].centerRadius,
                      shaded_[begin].centerRadius,
                      shaded_[begin].centerRadius.w,
                      run.detail,
                      run.volume};
    const auto casters = std::span(casters_).subspan(run.mediumBegin, run.mediumEnd - run.mediumBegin);
    radii_.clear();
    float left = 0.0f;
    for (const MediumCaster& caster : casters) {
        effect.low = glm::min(effect.low, caster.center - caster.radius);
        effect.high = glm::max(effect.high, caster.center + caster.radius);
        radii_.push_back({caster.radius, caster.crossSection});
        left += 0.25f * caster.crossSection;
    }
    std::ranges::sort(radii_);
    for (const auto& [radius, crossSection] : radii_) {
        effect.radius = radius;
        if ((left -= crossSection) <= 0.0f)
            break;
    }
    effects_.push_back(effect);
}

/// To what is drawn, to a picture that is taken, or to both.
void FrameBuilder::add(const BlobInstance& blob, const ImpostorPlan& plan, const CameraGeometry& camera)
{
    if (plan.blobShare > 0.0f) {
        shaded_.push_back(blob);
        shaded_.back().medium.x *= plan.blobShare; // cross section
        shaded_.back().medium.y *= plan.blobShare; // heat
    }
    if (!plan.isTaken)
        return;
    BlobInstance placed = blob;
    float scale = 1.0f;
    const glm::vec3 place =
        placeInTaking(impostors_.taking(plan.slot), plan.slot, camera, glm::vec3(blob.centerRadius), scale);
    placed.centerRadius = {place, blob.centerRadius.w * scale};
    placed.lit.w = -1.0f - blob.lit.w;
    placed.medium.x *= scale * scale;
    taken_.push_back(placed);
}

void FrameBuilder::sort(const CameraGeometry& camera, bool isSorted)
{
    if (!isSorted) {
        base::assignAmortized(sorted_, shaded_);
        base::assignAmortized(sortedMarks_, marks_);
        identity_.resize(shaded_.size());
        std::iota(identity_.begin(), identity_.end(), 0u);
        order_ = identity_;
        base::assignAmortized(distances_, shaded_.size(), 0.0f);
        depthSort_.forget();
        return;
    }
    distances_.clear();
    for (const BlobInstance& blob : shaded_) {
        const glm::vec3 center(blob.centerRadius);
        distances_.push_back(camera.orthographic ? glm::dot(center, camera.forward)
                                                 : glm::dot(center, center));
    }
    sorted_.clear();
    order_ = depthSort_.farthestFirst(distances_);
    isParallel_ = camera.orthographic;
    for (const uint32_t index : order_)
        sorted_.push_back(shaded_[index]);
    sortedMarks_.clear();
    for (size_t i = 0; i < order_.size() && isMarked_; ++i)
        sortedMarks_.push_back(marks_[order_[i]]);
}

void FrameBuilder::sortImpostors(const CameraGeometry& camera)
{
    sortedImpostors_.clear();
    impostorOrder_ = impostorSort_.farthestFirst(impostors_.distances());
    for (const uint32_t index : impostorOrder_)
        sortedImpostors_.push_back(impostors_.shown()[index]);
    takenTiles_.clear();
    for (const ImpostorTaking& taking : impostors_.takings())
        takenTiles_.push_back(taking.tile);
    takenDistances_.clear();
    for (const BlobInstance& blob : taken_)
        takenDistances_.push_back(glm::dot(glm::vec3(blob.centerRadius), camera.forward));
    sortedTaken_.clear();
    for (const uint32_t index : takenSort_.farthestFirst(takenDistances_))
        sortedTaken_.push_back(taken_[index]);
}

DrawStream FrameBuilder::impostorStream() const
{
    DrawStream stream;
    stream.count = uint32_t(impostorOrder_.size());
    stream.distances = impostors_.distances().data();
    stream.order = impostorOrder_.data();
    return stream;
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
