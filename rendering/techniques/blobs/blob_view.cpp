#include "rendering/techniques/blobs/blob_view.h"

#include "foundation/memory/amortized_vector.h"
#include "rendering/gl/gl_backend.h"
#include "rendering/gl/gl_read_texture.h"
#include "rendering/media/blob_estimate.h"
#include "rendering/passes/blob_light_pass.h"
#include "rendering/passes/media_pass.h"
#include "rendering/passes/overdraw_pass.h"
#include "rendering/passes/scene_distance_pass.h"

#include <algorithm>
#include <bit>

namespace fx::render {

BlobView::BlobView(const TechniqueSetup& setup) : device_(*setup.device), builder_(setup.memory) {}

base::Status BlobView::gather(const GatherInputs& in, GatheredFrame& io)
{
    builder_.build(*in.snapshots, *in.request, *in.settings, *in.camera, *in.lod, in.content, in.castsShadows,
                   in.needsOrder, io.late, in.otherEye);
    return handOut(in, io);
}

/// Tiles of blocks and impostors are chosen for one camera.
base::Status BlobView::gatherOtherEye(const GatherInputs& in, GatheredFrame& io)
{
    if (!io.late.empty() || in.settings->lod.impostorPixels > 0.0f)
        return gather(in, io);
    builder_.turnTo(*in.camera);
    return handOut(in, io);
}

base::Status BlobView::handOut(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    restingFrames_ = 0;
    const HostTargets& targets = in.request->targets;
    io.blobs = builder_.blobs();
    io.effects = builder_.effects();
    io.marks = builder_.marks();
    io.materials = builder_.materials();
    io.details = builder_.details();
    io.volumes = builder_.volumes();
    base::reserveAmortized(*io.casters, io.casters->size() + builder_.casters().size());
    io.casters->insert(io.casters->end(), builder_.casters().begin(), builder_.casters().end());
    io.anyHeat = builder_.anyHeat();
    io.fragments = estimateFragments(builder_.blobs(), *in.camera, targets.width, targets.height);
    if (builder_.stream().count > 0) {
        io.streams->push_back(builder_.stream());
        io.streams->back().source = &blobs_;
    }
    if (builder_.impostorStream().count > 0) {
        io.streams->push_back(builder_.impostorStream());
        io.streams->back().source = &impostors_;
    }
    if (base::Status status = makeRoom(device_, blobBuffer_, builder_.blobs().size_bytes(), "blobs"); !status)
        return status;
    if (base::Status status =
            makeRoom(device_, lightBuffer_, builder_.blobs().size() * kBlobLightBytes, "blob lights");
        !status)
        return status;
    return makeRoomForImpostors();
}

void BlobView::keep()
{
    isKept_ = true;
    restingFrames_ = 0;
}

base::Status BlobView::makeRoomForImpostors()
{
    if (base::Status status =
            makeRoom(device_, impostorBuffer_, builder_.impostors().size_bytes(), "impostors");
        !status)
        return status;
    if (builder_.takenTiles().empty() || impostorAtlas_.name() != 0)
        return {};
    auto created = GlTexture::create(device_, kImpostorColumns * kImpostorTile, kImpostorRows * kImpostorTile,
                                     glInternalFormat(Format::RGBA16F), "impostors");
    if (!created)
        return created.status();
    impostorAtlas_ = std::move(*created);
    return {};
}

void BlobView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    switch (stage) {
    case PassStage::Pictures:
        overdraw_ = {};
        addPictures(graph, frame);
        break;
    case PassStage::Upload:
        if (!builder_.blobs().empty())
            uploadBlobs(graph, frame);
        break;
    case PassStage::Measure:
        if (frame.settings->countOverdraw && !builder_.blobs().empty())
            countOverdraw(graph, frame);
        break;
    default:
        break;
    }
}

/// Takes the pictures of this frame and makes all of them ready to be drawn.
void BlobView::addPictures(FrameGraph& graph, PassFrame& frame)
{
    if (impostorAtlas_.name() == 0)
        return;
    impostors_.atlas = graph.importTexture(
        {"impostors", kImpostorColumns * kImpostorTile, kImpostorRows * kImpostorTile, Format::RGBA16F},
        impostorAtlas_.name());
    if (!isKept_ && !builder_.takenTiles().empty()) {
        takePictures(graph, frame);
        frame.anyPass = true;
    }
    if (!builder_.impostors().empty())
        uploadImpostors(graph);
}

void BlobView::uploadImpostors(FrameGraph& graph)
{
    const std::span<const ImpostorInstance> shown = builder_.impostors();
    impostors_.instances =
        graph.importBuffer({"impostors", std::bit_ceil(shown.size_bytes())}, impostorBuffer_.name());
    if (isKept_)
        return;
    graph.addPass("media impostor upload", [&](FrameGraph::Builder& builder) {
        impostors_.instances = builder.write(impostors_.instances);
        return [buffer = impostors_.instances, shown](Backend& backend) {
            backend.upload(buffer, std::as_bytes(shown));
        };
    });
}

void BlobView::takePictures(FrameGraph& graph, const PassFrame& frame)
{
    constexpr int kSide = kTakingColumns * kImpostorTile;
    const ViewBlock view = [&] {
        ViewBlock block = makeViewBlock(takingCamera(cameraGeometry(frame.request->camera)), kSide, kSide);
        block.forward.w = frame.settings->detail ? 1.0f : 0.0f;
        block.sunDirection = {frame.settings->lighting.sunDirection, block.sunDirection.w};
        return block;
    }();
    const std::span<const uint32_t> kept = builder_.takenTiles();
    ResourceId tiles;
    graph.addPass("media impostor blobs", [&](FrameGraph::Builder& builder) {
        const std::span<const BlobInstance> taken = builder_.takenBlobs();
        const size_t bytes = std::max(taken.size_bytes(), sizeof(BlobInstance));
        takenBlobs_.blobs = builder.write(builder.create(BufferDesc{"impostor blobs", std::bit_ceil(bytes)}));
        tiles = builder.write(builder.create(BufferDesc{"impostor tiles", std::bit_ceil(kept.size_bytes())}));
        return [blobs = takenBlobs_.blobs, tiles, taken, kept](Backend& backend) {
            backend.upload(blobs, std::as_bytes(taken));
            backend.upload(tiles, std::as_bytes(kept));
        };
    });
    takenBlobs_.form = frame.settings->form;
    takenBlobs_.detail = frame.settings->detail && builder_.anyDetail();
    const size_t lightBytes = std::max<size_t>(builder_.takenBlobs().size(), 1) * kBlobLightBytes;
    graph.addPass("impostor lights", [&](FrameGraph::Builder& builder) {
        takenBlobs_.blobLights =
            builder.write(builder.create(BufferDesc{"impostor lights", std::bit_ceil(lightBytes)}));
        return [](Backend&) {};
    });
    takenBlobs_.blobLights =
        BlobLightPass::addTo(graph, {takenBlobs_.blobs, takenBlobs_.blobLights, frame.lights, &frame.view,
                                     uint32_t(builder_.takenBlobs().size())})
            .blobLights;
    takenBatch_ = {0, 0, uint32_t(builder_.takenBlobs().size()), &takenBlobs_};
    const ResourceId nothing = SceneDistancePass::addTo(graph, {{}, kSide, kSide, view}).distance;
    const auto drawn = MediaPass::addTo(
        graph, {{&takenBatch_, 1}, nothing, kSide, kSide, view, false, false, frame.lights}, {});
    impostors_.atlas =
        ImpostorKeepPass::addTo(graph, {drawn.media, impostors_.atlas, tiles, uint32_t(kept.size())}).atlas;
    graph.keep(impostors_.atlas); // later frames show it
}

void BlobView::uploadBlobs(FrameGraph& graph, PassFrame& frame)
{
    blobs_.form = frame.settings->form;
    blobs_.detail = frame.settings->detail && builder_.anyDetail();
    const std::span<const BlobInstance> blobs = builder_.blobs();
    const size_t capacity = std::bit_ceil(blobs.size_bytes());
    blobs_.blobs = graph.importBuffer({"blobs", capacity}, blobBuffer_.name());
    if (!isKept_)
        graph.addPass("blob upload", [&](FrameGraph::Builder& builder) {
            blobs_.blobs = builder.write(blobs_.blobs);
            return [buffer = blobs_.blobs, blobs](Backend& backend) {
                backend.upload(buffer, std::as_bytes(blobs));
            };
        });
    frame.blobs = blobs_.blobs;
    addLights(graph, frame);
}

void BlobView::addLights(FrameGraph& graph, const PassFrame& frame)
{
    blobs_.blobLights = graph.importBuffer(
        {"blob lights", std::bit_ceil(builder_.blobs().size() * kBlobLightBytes)}, lightBuffer_.name());
    if (!isKept_ || frame.mayShadowChange())
        blobs_.blobLights = BlobLightPass::addTo(graph, {blobs_.blobs, blobs_.blobLights, frame.lights,
                                                         &frame.view, uint32_t(builder_.blobs().size())})
                                .blobLights;
    blobs_.list = {blobs_.blobs, blobs_.blobLights, builder_.blobs(), blobs_.detail, frame.tiles};
}

void BlobView::countOverdraw(FrameGraph& graph, const PassFrame& frame)
{
    layerWidth_ = frame.layerWidth;
    layerHeight_ = frame.layerHeight;
    overdraw_ =
        OverdrawPass::addTo(graph, {blobs_.blobs, frame.layerDistance, uint32_t(builder_.blobs().size()),
                                    layerWidth_, layerHeight_, frame.layerView, frame.hasSmallLayers})
            .count;
    graph.keep(overdraw_);
}

/// Gives back what many frames in a row have drawn nothing from.
void BlobView::endFrame(bool)
{
    blobsUnused_ = builder_.blobs().empty() ? blobsUnused_ + 1 : 0;
    if (blobsUnused_ == kIdleFrames)
        releaseBlobs();
    impostorsUnused_ = builder_.impostors().empty() ? impostorsUnused_ + 1 : 0;
    if (impostorsUnused_ == kIdleFrames)
        releaseImpostors();
}

void BlobView::forget()
{
    overdraw_ = {};
    builder_.forgetPictures();
}

void BlobView::rest()
{
    overdraw_ = {};
    if (++restingFrames_ != kIdleFrames)
        return;
    releaseBlobs();
    releaseImpostors();
}

void BlobView::releaseBlobs()
{
    blobBuffer_ = {};
    lightBuffer_ = {};
}

void BlobView::releaseImpostors()
{
    impostorBuffer_ = {};
    impostorAtlas_ = {};
    builder_.forgetPictures();
}

void BlobView::count(FrameStatistics& statistics) const
{
    statistics.blobs += uint32_t(builder_.blobs().size());
    statistics.blobsCulled += builder_.counts().culled;
    statistics.blobsNonFinite += builder_.counts().nonFinite;
    statistics.blobsThinned += builder_.counts().thinned;
    statistics.impostors += uint32_t(builder_.impostors().size());
    if (isKept_)
        return;
    statistics.impostorsTaken += uint32_t(builder_.takenTiles().size());
    statistics.uploadedBytes += builder_.blobs().size_bytes() + builder_.impostors().size_bytes() +
                                builder_.takenBlobs().size_bytes();
    statistics.sortedElements += builder_.blobs().size();
}

void BlobView::readBack(const GlBackend& backend, FrameStatistics& statistics)
{
    if (!overdraw_.valid())
        return;
    for (const float count :
         readTexture(device_, backend.textureName(overdraw_), layerWidth_, layerHeight_, 1)) {
        statistics.coveredPixels += count > 0.0f ? 1 : 0;
        statistics.shadedFragments += uint64_t(count);
    }
}

void BlobView::cover(const CameraGeometry& camera, ScreenShare& share) const
{
    share = screenShare(builder_.blobs(), camera);
}

uint64_t BlobView::bytes() const
{
    return blobBuffer_.bytes() + lightBuffer_.bytes() + impostorBuffer_.bytes() + impostorAtlas_.bytes();
}

} // namespace fx::render
