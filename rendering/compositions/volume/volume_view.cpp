#include "rendering/compositions/volume/volume_view.h"

#include "rendering/lights/slices/light_list.h"
#include "rendering/passes/blob_light_pass.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr size_t kBricksOfALayer = size_t(kBrickColumns) * kBrickColumns;
constexpr std::string_view kListNames[] = {
    "fields",          "field bricks", "field balls",        "field list",        "field tiles",
    "field materials", "field blobs",  "field light stacks", "field near bricks", "field near parts"};
constexpr std::string_view kTextureNames[] = {"field medium",     "field scatter",    "field shares",
                                              "field material 0", "field material 1", "field change"};

constexpr int kCoarseVoxels = 96; ///< fields of fewer voxels have kCoarseOctaves of detail

/// Side of the cube of as many cells as a network's grid may have; 0: light is scattered again by a formula,
/// or once.
int networkCells(const ViewSettings& settings)
{
    constexpr int kVoxelsPerCell = 3, kRound = 8, kFewest = 24, kMost = 64;
    if (!settings.slices.network || !settings.slices.multiple)
        return 0;
    if (settings.slices.automatic && settings.voxels < kLeastNetworkVoxels)
        return 0;
    if (settings.slices.networkCells > 0)
        return std::clamp(settings.slices.networkCells / kRound * kRound, kFewest, kMost);
    return std::clamp(settings.voxels / kVoxelsPerCell / kRound * kRound, kFewest, kMost);
}

} // namespace

VolumeView::VolumeView(const TechniqueSetup& setup)
    : device_(*setup.device), plan_(setup.memory), texels_(setup.memory), details_(setup.memory),
      glow_(*setup.device), network_(*setup.device, setup.memory), loose_(setup), looseBlobs_(setup.memory)
{}

base::Status VolumeView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    filledFor_ = nullptr;
    layers_ = in.settings->layerOutputs;
    stacks_ = {};
    const HostTargets& targets = in.request->targets;
    details_.clear();
    const int octaves = in.settings->voxels < kCoarseVoxels ? kCoarseOctaves : kMaxDetailOctaves;
    for (const GroupDetail& detail : io.details)
        details_.push_back(detailBlock(detail, octaves));
    materials_ = details_.empty() ? std::span<const BlobMaterial>() : io.materials;
    blobs_ = details_.empty() ? std::span<const BlobInstance>() : io.blobs;
    networkCells_ = networkCells(*in.settings);
    plan_.build({io.blobs, io.effects, in.camera, targets.width, targets.height, in.settings->voxels, 0,
                 in.settings->slices.multiple, networkCells_, in.settings->slices.automatic});
    networkCells_ = plan_.hasNetworks() ? networkCells_ : 0;
    texels_.build(plan_, details_);
    gatherLoose(in, io);
    eye_ = in.camera->eye;
    return makeRoom(in.settings->layerOutputs);
}

void VolumeView::gatherLoose(const GatherInputs& in, GatheredFrame& io)
{
    loose_.gather(in, io);
    looseBlobs_.clear();
    bool anyDetail = false;
    for (const uint32_t number : plan_.loose()) {
        looseBlobs_.push_back(io.blobs[number]);
        anyDetail = anyDetail || io.blobs[number].medium.z > 0.0f;
    }
    for (const NearBall& ball : plan_.near().balls()) {
        looseBlobs_.push_back(io.blobs[ball.number]);
        looseBlobs_.back().medium.x *= ball.share;
        looseBlobs_.back().medium.z = 0.0f; // the rest of it in the field has none
    }
    looseSource_.detail = in.settings->detail && anyDetail;
    loose_.replaceBalls(looseBlobs_.empty() ? nullptr : &looseSource_);
}

std::array<std::span<const std::byte>, VolumeView::Lists> VolumeView::lists() const
{
    return {std::as_bytes(plan_.fields()),
            std::as_bytes(plan_.bricks()),
            std::as_bytes(plan_.balls()),
            std::as_bytes(texels_.texels()),
            std::as_bytes(texels_.tiles()),
            std::as_bytes(materials_),
            std::as_bytes(blobs_),
            stacks_,
            std::as_bytes(plan_.near().bricks()),
            std::as_bytes(plan_.near().parts())};
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
    for (size_t i = 0; status && i < textures_.size(); ++i)
        if (isUsed(i, layers))
            status = makeTexture(i);
    if (status)
        status = glow_.makeRoom(glows());
    if (status)
        status =
            network_.makeRoom(networkCells_ > 0 ? plan_.glows() : std::span<const FieldGlowBlock>(), eye_);
    if (status && !plan_.isEmpty())
        status = makeTexels(texelTexture_, texels_.texels().size(), kFieldColumns, Format::RGBA32F,
                            "field texels");
    if (status && !plan_.isEmpty())
        status = makeTexels(table_, plan_.table().size(), kTableColumns, Format::R32F, "field table");
    return status && !details_.empty() ? lumpTile_.makeRoom(device_) : status;
}

base::Status VolumeView::makeTexels(GlTexture& io, size_t count, int columns, Format format, const char* name)
{
    const int rows = rowsOfTexels(count, columns);
    if (io.name() != 0 && io.height() >= rows)
        return {};
    io = {};
    auto created = GlTexture::create(device_, columns, rows, glInternalFormat(format), name);
    if (!created)
        return created.status();
    io = std::move(*created);
    return {};
}

/// Whether a texture is needed.
bool VolumeView::isUsed(size_t texture, bool layers) const
{
    return texture < 2 || (texture == 2 ? layers : !details_.empty());
}

/// A half more than is needed when it grows, so that it does not grow in each frame.
base::Status VolumeView::makeTexture(size_t i)
{
    const int layers = int((plan_.bricks().size() + kBricksOfALayer - 1) / kBricksOfALayer);
    const int side = kBrickColumns * kBrickSamples;
    const int there = textures_[i].name() != 0 ? textures_[i].depth() / kBrickSamples : 0;
    if (there >= layers)
        return {};
    const int most = std::max(device_.limits().volumeSize / kBrickSamples, layers);
    const int wanted = there > 0 ? std::min(layers + layers / 2, most) : layers;
    textures_[i] = {};
    auto created = GlTexture::createVolume(device_, side, side, wanted * kBrickSamples,
                                           glInternalFormat(kFieldFormats[i]), kTextureNames[i].data());
    if (!created)
        return created.status();
    textures_[i] = std::move(*created);
    return {};
}

void VolumeView::importAll(FrameGraph& graph, bool layers)
{
    const auto sizes = lists();
    for (size_t i = 0; i < Lists; ++i)
        ids_[i] = sizes[i].empty() ? ResourceId()
                                   : graph.importBuffer({kListNames[i], std::bit_ceil(sizes[i].size())},
                                                        buffers_[i].name());
    const auto texture = [&](size_t i) {
        return isUsed(i, layers) ? graph.importTexture({kTextureNames[i], textures_[i].width(),
                                                        textures_[i].height(), kFieldFormats[i]},
                                                       textures_[i].name())
                                 : ResourceId();
    };
    const auto texels = [&](const GlTexture& from, Format format, std::string_view name) {
        return graph.importTexture({name, from.width(), from.height(), format}, from.name());
    };
    march_.textures = {texture(0),
                       texture(1),
                       texture(2),
                       texels(table_, Format::R32F, "field table"),
                       {texture(3), texture(4)},
                       texture(5)};
    march_.fieldTexels = texels(texelTexture_, Format::RGBA32F, "field texels");
    glow_.importAll(graph, glows());
    network_.importAll(graph);
    march_.lumpTile = details_.empty() ? ResourceId() : lumpTile_.addTo(graph);
}

void VolumeView::upload(FrameGraph& graph)
{
    graph.addPass("field upload", [&](FrameGraph::Builder& builder) {
        for (ResourceId& id : ids_)
            id = id.valid() ? builder.write(id) : id;
        return [ids = ids_, contents = lists()](Backend& backend) {
            for (size_t i = 0; i < Lists; ++i)
                if (ids[i].valid())
                    backend.upload(ids[i], contents[i]);
        };
    });
}

void VolumeView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    slabs_ = frame.settings->slabs;
    loose_.begin(*frame.settings);
    if (!looseBlobs_.empty())
        addLooseBalls(graph, frame);
    if (!plan_.isEmpty())
        addFields(graph, frame);
}

MediaPass::Outputs VolumeView::compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                       const MediaPass::Outputs& under)
{
    FieldMarchPass::Inputs march = march_;
    march.media = &in;
    if (plan_.isEmpty())
        return SlabPass::addTo(
            graph, loose_.list(graph, in, {.maxOfTile = 0, .slabs = slabs_}).inSlabs(in, slabs_), under);
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
    if (!isKept_ || frame.lights.hostShadow.valid())
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
    const bool corrects = !details_.empty() && !plan_.isEmpty() && !lights.stacks.empty() &&
                          lights.planes.valid() && corrected_ != lights.filled;
    if (!corrects)
        return lights;
    stacks_ = lights.stacks;
    if (!render::makeRoom(device_, buffers_[Stacks], stacks_.size(), kListNames[Stacks].data())) {
        stacks_ = {}; // light is that of smooth balls
        return lights;
    }
    importAll(graph, layers_);
    upload(graph);
    fill(graph, ids_[Blobs]);
    filledFor_ = &graph;
    corrected_ = lights.filled;
    return FieldSlicesPass::addTo(graph, {march_.fieldTexels, march_.textures.table, march_.textures.change,
                                          ids_[Stacks], lights, uint32_t(plan_.fields().size()),
                                          uint32_t(stacks_.size() / sizeof(SliceStackBlock))});
}

void VolumeView::fill(FrameGraph& graph, ResourceId blobs)
{
    march_.fieldTexels =
        FieldTexelPass::addTo(graph, ids_[Texels], texels_.texels().size(), march_.fieldTexels);
    march_.textures =
        FieldFillPass::addTo(graph, {blobs, march_.fieldTexels, ids_[Bricks], ids_[Balls], march_.textures,
                                     uint32_t(plan_.bricks().size()), ids_[Materials], march_.lumpTile})
            .textures;
}

/// The textures hold the light of a frame that was kept; the host's shadow map may have changed under it.
void VolumeView::addFields(FrameGraph& graph, PassFrame& frame)
{
    if (filledFor_ != &graph)
        importAll(graph, layers_);
    if (!isKept_ && !filledFor_)
        upload(graph);
    const bool isFilled = filledFor_ != nullptr; // here, or when lights were prepared
    const bool sweeps = !network_.isEmpty() && !network_.isSettled();
    if (!isKept_ || isFilled || sweeps || frame.lights.hostShadow.valid()) {
        if (!isFilled)
            fill(graph, frame.blobs);
        addFieldLight(graph, frame);
    }
    filledFor_ = nullptr;
    march_.tiles = ids_[Tiles];
}

void VolumeView::addFieldLight(FrameGraph& graph, const PassFrame& frame)
{
    FieldLightPass::Inputs light{ids_[Fields], ids_[Bricks], march_.textures,
                                 frame.lights, &frame.view,  uint32_t(plan_.bricks().size())};
    if (frame.lights.lights.valid()) {
        const FieldGlowPass::Inputs in{.fieldTexels = march_.fieldTexels,
                                       .field = march_.textures,
                                       .lumpTile = march_.lumpTile,
                                       .detail = !details_.empty(),
                                       .grids = {},
                                       .glow = {},
                                       .fieldCount = uint32_t(plan_.fields().size()),
                                       .gridCount = 0,
                                       .extent = {}};
        glow_.addPasses(graph, in, glows());
        network_.addPasses(graph, in, frame.lights, isKept_);
    }
    takeNearOut(graph, frame.blobs);
    light.textures = march_.textures;
    light.glow = glow_.light();
    light.network = network_.moments();
    light.networkBlock = network_.block();
    light.grids = network_.isEmpty() ? glow_.grids() : network_.buffer();
    march_.textures = FieldLightPass::addTo(graph, light).textures;
}

void VolumeView::takeNearOut(FrameGraph& graph, ResourceId blobs)
{
    if (!plan_.near().bricks().empty())
        march_.textures = FieldNearPass::addTo(graph, {blobs, march_.fieldTexels, ids_[Bricks],
                                                       ids_[NearBricks], ids_[NearParts], march_.textures,
                                                       uint32_t(plan_.near().bricks().size())})
                              .textures;
}

/// What the frame was to write once is not there.
void VolumeView::forget()
{
    lumpTile_.forget();
    corrected_ = 0;
    filledFor_ = nullptr;
    loose_.forget();
}

void VolumeView::endFrame(bool)
{
    unused_ = plan_.isEmpty() && looseBlobs_.empty() ? unused_ + 1 : 0;
    if (unused_ == kIdleFrames)
        release();
}

void VolumeView::rest()
{
    loose_.forget();
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
    texelTexture_ = {};
    table_ = {};
    lumpTile_.release();
    glow_.release();
    network_.release();
}

uint64_t VolumeView::bytes() const
{
    uint64_t sum =
        looseBuffer_.bytes() + looseLights_.bytes() + glow_.bytes() + network_.bytes() + lumpTile_.bytes();
    for (const GlBuffer& buffer : buffers_)
        sum += buffer.bytes();
    const auto add = [&](const GlTexture& texture) { sum += texture.name() != 0 ? texture.bytes() : 0; };
    for (const GlTexture& texture : textures_)
        add(texture);
    for (const GlTexture* texture : {&texelTexture_, &table_})
        add(*texture);
    return sum;
}

} // namespace fx::render
