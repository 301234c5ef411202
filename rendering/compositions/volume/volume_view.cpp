#include "rendering/compositions/volume/volume_view.h"

#include "rendering/lights/slices/light_list.h"
#include "rendering/passes/blob_light_pass.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr size_t kBricksOfALayer = size_t(kBrickColumns) * kBrickColumns;
constexpr std::string_view kListNames[] = {"fields",        "field bricks",    "field table",
                                           "field balls",   "field tiles",     "fields of tiles",
                                           "field details", "field materials", "field light stacks"};
constexpr std::string_view kTextureNames[] = {"field medium", "field scatter", "field shares",
                                              "field material 0", "field material 1"};

constexpr int kCoarseVoxels = 96; ///< fields of fewer voxels have kCoarseOctaves of detail
constexpr int kCoarseOctaves = 3;

/// What the GPU gets of the detail of a group.
FieldDetailBlock blockOf(const GroupDetail& detail, int octaves)
{
    const FieldDetailNumbers& numbers = detail.numbers;
    FieldDetailBlock block;
    for (int g = 0; g < 2; ++g)
        for (int row = 0; row < 3; ++row)
            block.rows[3 * g + row] = {detail.toCells[g][0][row], detail.toCells[g][1][row],
                                       detail.toCells[g][2][row], detail.first[g][row]};
    block.erosion = {numbers.length() * detail.scale, numbers.thinnest, numbers.densest, numbers.ramp};
    block.noise = {numbers.gain, numbers.fade, numbers.cooling, numbers.glow};
    const auto size = [&](size_t g) {
        return detail.scale * numbers.generations[g].length / numbers.generations[g].growth;
    };
    block.lumps = {size(0), size(1), detail.factor, float(octaves)};
    return block;
}

} // namespace

VolumeView::VolumeView(const TechniqueSetup& setup)
    : device_(*setup.device), plan_(setup.memory), details_(setup.memory), glow_(*setup.device),
      looseSort_(setup.memory), looseDistances_(setup.memory), looseBlobs_(setup.memory)
{}

base::Status VolumeView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    stacks_ = {};
    std::erase_if(*io.streams, [](const DrawStream& stream) { return stream.source->balls() != nullptr; });
    const HostTargets& targets = in.request->targets;
    details_.clear();
    const int octaves = in.settings->voxels < kCoarseVoxels ? kCoarseOctaves : kMostDetailOctaves;
    for (const GroupDetail& detail : io.details)
        details_.push_back(blockOf(detail, octaves));
    materials_ = details_.empty() ? std::span<const BlobMaterial>() : io.materials;
    plan_.build({io.blobs, io.effects, in.camera, targets.width, targets.height, in.settings->voxels, 0,
                 in.settings->slices.multiple});
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
    return {
        std::as_bytes(plan_.fields()),      std::as_bytes(plan_.bricks()), std::as_bytes(plan_.table()),
        std::as_bytes(plan_.balls()),       std::as_bytes(plan_.tiles()),  std::as_bytes(plan_.tileFields()),
        std::as_bytes(std::span(details_)), std::as_bytes(materials_),     stacks_};
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
        status = glow_.makeRoom(plan_.glows());
    return status && !details_.empty() ? makeLumpTile() : status;
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

base::Status VolumeView::makeLumpTile()
{
    if (lumpTile_.name() != 0)
        return {};
    auto created = GlTexture::createVolume(device_, kLumpTileTexels, kLumpTileTexels, kLumpTileTexels,
                                           glInternalFormat(Format::R32F), "lump tile");
    if (!created)
        return created.status();
    lumpTile_ = std::move(*created);
    hasLumps_ = false;
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
    source_.textures.medium = texture(0);
    source_.textures.scatter = texture(1);
    source_.textures.shares = texture(2);
    source_.textures.material[0] = texture(3);
    source_.textures.material[1] = texture(4);
    glow_.importAll(graph, plan_.glows());
    source_.lumpTile = {};
    if (details_.empty())
        return;
    source_.lumpTile =
        graph.importTexture({"lump tile", kLumpTileTexels, kLumpTileTexels, Format::R32F}, lumpTile_.name());
    if (!hasLumps_)
        source_.lumpTile = LumpTilePass::addTo(graph, source_.lumpTile);
    hasLumps_ = true;
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
void VolumeView::addFields(FrameGraph& graph, PassFrame& frame)
{
    stacks_ = details_.empty() ? std::span<const std::byte>() : frame.lights.stacks;
    if (base::Status status =
            render::makeRoom(device_, buffers_[Stacks], stacks_.size(), "field light stacks");
        !status)
        stacks_ = {}; // light is that of smooth balls
    importAll(graph, frame.settings->layerOutputs);
    const bool corrects =
        !stacks_.empty() && frame.lights.planes.valid() && corrected_ != frame.lights.filled;
    if (!isKept_ || corrects)
        upload(graph);
    if (!isKept_ || corrects || frame.lights.hostShadow.valid()) {
        const uint32_t bricks = uint32_t(plan_.bricks().size());
        source_.textures = FieldFillPass::addTo(graph, {frame.blobs, ids_[Fields], ids_[Bricks], ids_[Balls],
                                                        source_.textures, bricks, ids_[Materials],
                                                        ids_[Details], source_.lumpTile})
                               .textures;
        if (corrects) {
            frame.lights = FieldSlicesPass::addTo(
                graph, {ids_[Fields], ids_[Table], source_.textures.material[1], ids_[Stacks], frame.lights,
                        uint32_t(plan_.fields().size()), uint32_t(stacks_.size() / sizeof(SliceStackBlock))});
            corrected_ = frame.lights.filled;
        }
        if (frame.lights.lights.valid())
            glow_.addPasses(graph,
                            {ids_[Fields],
                             ids_[Table],
                             {},
                             source_.textures,
                             ids_[Details],
                             source_.lumpTile,
                             {},
                             uint32_t(plan_.fields().size()),
                             0},
                            plan_.glows());
        source_.textures =
            FieldLightPass::addTo(graph, {ids_[Fields], ids_[Bricks], source_.textures, frame.lights,
                                          &frame.view, bricks, glow_.light(), glow_.grids()})
                .textures;
    }
    source_.fields = ids_[Fields];
    source_.table = ids_[Table];
    source_.tiles = ids_[Tiles];
    source_.tileFields = ids_[TileFields];
    source_.details = ids_[Details];
}

/// What the frame was to write once is not there.
void VolumeView::forget()
{
    hasLumps_ = false;
    corrected_ = 0;
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
    lumpTile_ = {};
    glow_.release();
}

uint64_t VolumeView::bytes() const
{
    uint64_t sum = looseBuffer_.bytes() + looseLights_.bytes() + glow_.bytes();
    for (const GlBuffer& buffer : buffers_)
        sum += buffer.bytes();
    for (const GlTexture& texture : textures_)
        sum += texture.name() != 0 ? texture.bytes() : 0;
    return sum + (lumpTile_.name() != 0 ? lumpTile_.bytes() : 0);
}

} // namespace fx::render
