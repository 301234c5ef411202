#include "rendering/compositions/volume/volume_view.h"

#include "rendering/passes/blob_light_pass.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr size_t kBricksOfALayer = size_t(kBrickColumns) * kBrickColumns;
constexpr std::string_view kListNames[] = {"fields",      "field bricks", "field table",
                                           "field balls", "field tiles",  "fields of tiles"};
constexpr std::string_view kTextureNames[] = {"field medium", "field scatter", "field shares"};

} // namespace

VolumeView::VolumeView(const TechniqueSetup& setup)
    : device_(*setup.device), plan_(setup.memory), looseSort_(setup.memory), looseDistances_(setup.memory),
      looseBlobs_(setup.memory)
{}

base::Status VolumeView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    std::erase_if(*io.streams, [](const DrawStream& stream) { return stream.source->balls() != nullptr; });
    const HostTargets& targets = in.request->targets;
    plan_.build({io.blobs, io.effects, in.camera, targets.width, targets.height, in.settings->voxels, 0});
    sortLoose(in, io.blobs);
    if (!looseBlobs_.empty())
        io.streams->push_back(looseStream());
    if (!plan_.isEmpty()) {
        source_.placeShells(plan_.nearest(), plan_.farthest());
        source_.tileCount = uint32_t(plan_.tiles().size());
        io.streams->push_back(source_.stream());
    }
    return makeRoom(in.settings->layerOutputs);
}

void VolumeView::sortLoose(const GatherInputs& in, std::span<const BlobInstance> blobs)
{
    looseDistances_.clear();
    bool anyDetail = false;
    for (const uint32_t number : plan_.loose()) {
        const glm::vec3 center(blobs[number].centerRadius);
        looseDistances_.push_back(in.camera->orthographic ? glm::dot(center, in.camera->forward)
                                                          : glm::length(center));
        anyDetail = anyDetail || blobs[number].medium.z > 0.0f;
    }
    looseOrder_ = looseSort_.farthestFirst(looseDistances_);
    looseBlobs_.clear();
    for (const uint32_t index : looseOrder_)
        looseBlobs_.push_back(blobs[plan_.loose()[index]]);
    looseSource_.form = in.settings->form;
    looseSource_.detail = in.settings->detail && anyDetail;
}

DrawStream VolumeView::looseStream() const
{
    DrawStream stream;
    stream.count = uint32_t(looseOrder_.size());
    stream.distances = looseDistances_.data();
    stream.order = looseOrder_.data();
    stream.source = &looseSource_;
    return stream;
}

std::array<std::span<const std::byte>, VolumeView::Lists> VolumeView::lists() const
{
    return {std::as_bytes(plan_.fields()), std::as_bytes(plan_.bricks()), std::as_bytes(plan_.table()),
            std::as_bytes(plan_.balls()),  std::as_bytes(plan_.tiles()),  std::as_bytes(plan_.tileFields())};
}

base::Status VolumeView::makeRoom(bool layers)
{
    const auto wanted = lists();
    for (size_t i = 0; i < Lists; ++i)
        if (base::Status status =
                render::makeRoom(device_, buffers_[i], wanted[i].size(), kListNames[i].data());
            !status)
            return status;
    const size_t loose = looseBlobs_.size();
    base::Status status =
        render::makeRoom(device_, looseBuffer_, loose * sizeof(BlobInstance), "loose blobs");
    if (status)
        status = render::makeRoom(device_, looseLights_, loose * kBlobLightBytes, "loose blob lights");
    return status ? makeTextures(layers ? 3 : 2) : status;
}

/// A half more than is needed when they grow, so that they do not grow in each frame.
base::Status VolumeView::makeTextures(size_t count)
{
    const int layers = int((plan_.bricks().size() + kBricksOfALayer - 1) / kBricksOfALayer);
    const int side = kBrickColumns * kBrickSamples;
    for (size_t i = 0; i < count; ++i) {
        const int there = textures_[i].name() != 0 ? textures_[i].depth() / kBrickSamples : 0;
        if (there >= layers)
            continue;
        const int most = std::max(device_.limits().volumeSize / kBrickSamples, layers);
        const int wanted = there > 0 ? std::min(layers + layers / 2, most) : layers;
        textures_[i] = {};
        auto created = GlTexture::createVolume(device_, side, side, wanted * kBrickSamples,
                                               glInternalFormat(kFieldFormats[i]), kTextureNames[i].data());
        if (!created)
            return created.status();
        textures_[i] = std::move(*created);
    }
    return {};
}

void VolumeView::importAll(FrameGraph& graph)
{
    const auto sizes = lists();
    for (size_t i = 0; i < Lists; ++i)
        ids_[i] = graph.importBuffer({kListNames[i], std::bit_ceil(sizes[i].size())}, buffers_[i].name());
    const auto texture = [&](size_t i) {
        return graph.importTexture(
            {kTextureNames[i], textures_[i].width(), textures_[i].height(), kFieldFormats[i]},
            textures_[i].name());
    };
    source_.textures = {texture(0), texture(1), {}};
}

void VolumeView::upload(FrameGraph& graph)
{
    graph.addPass("field upload", [&](FrameGraph::Builder& builder) {
        for (ResourceId& id : ids_)
            id = builder.write(id);
        return [ids = ids_, contents = lists()](Backend& backend) {
            for (size_t i = 0; i < Lists; ++i)
                backend.upload(ids[i], contents[i]);
        };
    });
}

void VolumeView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    if (!looseBlobs_.empty())
        addLoose(graph, frame);
    if (!plan_.isEmpty())
        addFields(graph, frame);
}

void VolumeView::addLoose(FrameGraph& graph, const PassFrame& frame)
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
    if (!isKept_ || frame.lights.hostShadow.valid())
        looseSource_.blobLights =
            BlobLightPass::addTo(graph, {looseSource_.blobs, looseSource_.blobLights, frame.lights,
                                         &frame.view, uint32_t(blobs.size())})
                .blobLights;
}

/// The textures hold the light of a frame that was kept; the host's shadow map may have changed under it.
void VolumeView::addFields(FrameGraph& graph, const PassFrame& frame)
{
    importAll(graph);
    if (frame.settings->layerOutputs)
        source_.textures.shares = graph.importTexture(
            {kTextureNames[2], textures_[2].width(), textures_[2].height(), kFieldFormats[2]},
            textures_[2].name());
    if (!isKept_)
        upload(graph);
    if (!isKept_ || frame.lights.hostShadow.valid()) {
        const uint32_t bricks = uint32_t(plan_.bricks().size());
        source_.textures = FieldFillPass::addTo(graph, {frame.blobs, ids_[Fields], ids_[Bricks], ids_[Balls],
                                                        source_.textures, bricks})
                               .textures;
        source_.textures = FieldLightPass::addTo(graph, {ids_[Fields], ids_[Bricks], source_.textures,
                                                         frame.lights, &frame.view, bricks})
                               .textures;
    }
    source_.fields = ids_[Fields];
    source_.table = ids_[Table];
    source_.tiles = ids_[Tiles];
    source_.tileFields = ids_[TileFields];
}

void VolumeView::endFrame(bool)
{
    unused_ = plan_.isEmpty() && looseBlobs_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        release();
}

void VolumeView::rest()
{
    plan_.clear();
    looseBlobs_.clear();
    if (++unused_ == kIdleFrames)
        release();
}

void VolumeView::release()
{
    buffers_ = {};
    looseBuffer_ = {};
    looseLights_ = {};
    textures_ = {};
}

uint64_t VolumeView::bytes() const
{
    uint64_t sum = looseBuffer_.bytes() + looseLights_.bytes();
    for (const GlBuffer& buffer : buffers_)
        sum += buffer.bytes();
    for (const GlTexture& texture : textures_)
        sum += texture.name() != 0 ? texture.bytes() : 0;
    return sum;
}

} // namespace fx::render
