#include "rendering/compositions/volume/volume_view.h"

#include "rendering/lights/slices/light_list.h"
#include "rendering/passes/blob_light_pass.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

VolumeView::VolumeView(const TechniqueSetup& setup)
    : device_(*setup.device), fields_(setup, FieldMedia::Use::Pictures), glow_(*setup.device),
      network_(*setup.device, setup.memory), loose_(setup), looseBlobs_(setup.memory)
{}

base::Status VolumeView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    filledFor_ = nullptr;
    fields_.build(in, io);
    gatherLoose(in, io);
    eye_ = in.camera->eye;
    return makeRoom();
}

void VolumeView::gatherLoose(const GatherInputs& in, GatheredFrame& io)
{
    loose_.gather(in, io);
    looseBlobs_.clear();
    bool anyDetail = false;
    for (const uint32_t number : fields_.plan().loose()) {
        looseBlobs_.push_back(io.blobs[number]);
        anyDetail = anyDetail || io.blobs[number].medium.z > 0.0f;
    }
    for (const NearBall& ball : fields_.plan().near().balls()) {
        if (ball.detail >= 0)
            continue; // of the march, see FieldTexels
        looseBlobs_.push_back(io.blobs[ball.number]);
        looseBlobs_.back().medium.x *= ball.share;
        looseBlobs_.back().medium.z = 0.0f; // the rest of it in the field has none
    }
    looseSource_.detail = in.settings->detail && anyDetail;
    loose_.replaceBalls(looseBlobs_.empty() ? nullptr : &looseSource_);
}

base::Status VolumeView::makeRoom()
{
    base::Status status = fields_.makeRoom();
    const size_t loose = looseBlobs_.size();
    if (status)
        status = render::makeRoom(device_, looseBuffer_, loose * sizeof(BlobInstance), "loose blobs");
    if (status)
        status = render::makeRoom(device_, looseLights_, loose * kBlobLightBytes, "loose blob lights");
    if (status)
        status = glow_.makeRoom(fields_.glows());
    return status ? network_.makeRoom(fields_.networks(), eye_) : status;
}

void VolumeView::importAll(FrameGraph& graph)
{
    fields_.importAll(graph);
    glow_.importAll(graph, fields_.glows());
    network_.importAll(graph);
}

void VolumeView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    slabs_ = frame.settings->slabs;
    loose_.begin(*frame.settings);
    if (!looseBlobs_.empty())
        addLooseBalls(graph, frame);
    if (!fields_.isEmpty())
        addFields(graph, frame);
}

MediaPass::Outputs VolumeView::compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                       const MediaPass::Outputs& under)
{
    if (fields_.isEmpty())
        return SlabPass::addTo(
            graph, loose_.list(graph, in, {.maxOfTile = 0, .slabs = slabs_}).inSlabs(in, slabs_), under);
    FieldMarchPass::Inputs march{&in, fields_.textures(), fields_.texels(), fields_.list(FieldMedia::Tiles),
                                 fields_.lumpTile()};
    if (!loose_.isEmpty()) {
        const SlabMedia::Lists lists = loose_.list(graph, in, {FieldMarchPass::kMaxLooseOfTile, march.tiles});
        march.loose = {lists.tiles.tiles, lists.tiles.lists, lists.balls, lists.cards, slabs_};
    }
    return FieldMarchPass::addTo(graph, march, under);
}

void VolumeView::addLooseBalls(FrameGraph& graph, const PassFrame& frame)
{
    const std::span<const BlobInstance> blobs = looseBlobs_;
    looseSource_.blobs =
        graph.importBuffer({"loose blobs", std::bit_ceil(blobs.size_bytes())}, looseBuffer_.name());
    looseSource_.blobLights = graph.importBuffer(
        {"loose blob lights", std::bit_ceil(blobs.size() * kBlobLightBytes)}, looseLights_.name());
    if (!isKept_)
        graph.addPass("loose blob upload", [&](FrameGraph::Builder& builder) {
            looseSource_.blobs = builder.write(looseSource_.blobs);
            return [buffer = looseSource_.blobs, blobs](Backend& backend) {
                backend.upload(buffer, std::as_bytes(blobs));
            };
        });
    if (!isKept_ || frame.mayShadowChange())
        looseSource_.blobLights =
            BlobLightPass::addTo(graph, {looseSource_.blobs, looseSource_.blobLights, frame.lights,
                                         &frame.view, uint32_t(blobs.size())})
                .blobLights;
    looseSource_.list = {looseSource_.blobs, looseSource_.blobLights, blobs, looseSource_.detail};
}

/// What detail makes of fields gets into the slices before anything reads them. Fields are filled for that,
/// and not again by addFields().
LightBindings VolumeView::addLightPasses(FrameGraph& graph, const LightBindings& lights)
{
    const bool corrects = fields_.differsFromBalls() && !fields_.isEmpty() && !lights.stacks.empty() &&
                          lights.planes.valid() && corrected_ != lights.filled;
    if (!corrects || !fields_.setStacks(lights.stacks))
        return lights; // that of smooth balls
    importAll(graph);
    fields_.upload(graph);
    fields_.fill(graph, fields_.list(FieldMedia::Blobs));
    filledFor_ = &graph;
    corrected_ = lights.filled;
    return FieldSlicesPass::addTo(graph, {fields_.texels(), fields_.textures().table,
                                          fields_.textures().change, fields_.list(FieldMedia::Stacks), lights,
                                          uint32_t(fields_.plan().fields().size()),
                                          uint32_t(lights.stacks.size() / sizeof(SliceStackBlock))});
}

/// The textures hold the light of a frame that was kept; the host's shadow map may have changed under it.
void VolumeView::addFields(FrameGraph& graph, PassFrame& frame)
{
    if (filledFor_ != &graph)
        importAll(graph);
    if (!isKept_ && !filledFor_)
        fields_.upload(graph);
    const bool isFilled = filledFor_ != nullptr; // here, or when lights were prepared
    const bool sweeps = !network_.isEmpty() && !network_.isSettled() && !frame.request->range.isContinued;
    if (!isKept_ || isFilled || sweeps || frame.mayShadowChange()) {
        if (!isFilled)
            fields_.fill(graph, frame.blobs);
        addFieldLight(graph, frame);
    }
    filledFor_ = nullptr;
}

void VolumeView::addFieldLight(FrameGraph& graph, const PassFrame& frame)
{
    if (frame.lights.lights.valid()) {
        glow_.addPasses(graph, fields_.sources(), fields_.glows());
        network_.addPasses(graph, fields_.sources(), frame.lights, isKept_);
    }
    if (fields_.plan().near().hasSmooth())
        takeNearOut(graph, frame.blobs, false);
    FieldLightPass::Inputs light{fields_.list(FieldMedia::Fields),
                                 fields_.list(FieldMedia::Bricks),
                                 fields_.textures(),
                                 frame.lights,
                                 &frame.view,
                                 uint32_t(fields_.plan().bricks().size())};
    light.glow = glow_.light();
    const BlobLightPass::Networks networks = network_.bindings();
    light.network = networks.moments;
    light.networkBlock = networks.block;
    light.grids = network_.isEmpty() ? glow_.grids() : networks.grids;
    fields_.setTextures(FieldLightPass::addTo(graph, light).textures);
    if (fields_.plan().near().hasDetailed())
        takeNearOut(graph, frame.blobs, true);
}

void VolumeView::takeNearOut(FrameGraph& graph, ResourceId blobs, bool detail)
{
    const size_t bricks = fields_.plan().near().bricks().size();
    if (bricks > 0)
        fields_.setTextures(
            FieldNearPass::addTo(graph,
                                 {blobs, fields_.texels(), fields_.list(FieldMedia::Bricks),
                                  fields_.list(FieldMedia::NearBricks), fields_.list(FieldMedia::NearParts),
                                  fields_.textures(), uint32_t(bricks), detail})
                .textures);
}

/// What the frame was to write once is not there.
void VolumeView::forget()
{
    fields_.forget();
    corrected_ = 0;
    filledFor_ = nullptr;
    loose_.forget();
}

void VolumeView::endFrame(bool)
{
    unused_ = fields_.isEmpty() && looseBlobs_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        release();
}

void VolumeView::rest()
{
    loose_.forget();
    fields_.clear();
    looseBlobs_.clear();
    if (++unused_ == kIdleFrames)
        release();
}

void VolumeView::release()
{
    fields_.release();
    looseBuffer_ = {};
    looseLights_ = {};
    glow_.release();
    network_.release();
}

uint64_t VolumeView::bytes() const
{
    return fields_.bytes() + looseBuffer_.bytes() + looseLights_.bytes() + glow_.bytes() + network_.bytes();
}

} // namespace fx::render
