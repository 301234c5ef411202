#include "rendering/compositions/field_media.h"

#include "rendering/field/field_fill_pass.h"
#include "rendering/field/field_volume_pass.h"
#include "rendering/frame/exposure.h"

#include <algorithm>
#include <bit>
#include <cmath>

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
int networkCellsOf(const ViewSettings& settings)
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

FieldMedia::FieldMedia(const TechniqueSetup& setup, Use use)
    : device_(*setup.device), plan_(setup.memory), texelList_(setup.memory), details_(setup.memory),
      voxels_(*setup.device, setup.memory), effects_(setup.memory), groupVolumes_(setup.memory),
      shownVoxels_(setup.memory), fieldVolumes_(setup.memory), use_(use)
{}

bool FieldMedia::asksForNetworks(const ViewSettings& settings)
{
    return networkCellsOf(settings) > 0;
}

void FieldMedia::build(const GatherInputs& in, const GatheredFrame& from)
{
    const bool isShown = use_ == Use::Pictures;
    layers_ = isShown && in.settings->layerOutputs;
    stacks_ = {};
    const HostTargets& targets = in.request->targets;
    details_.clear();
    const int octaves = in.settings->voxels < kCoarseVoxels ? kCoarseOctaves : kMaxDetailOctaves;
    for (const GroupDetail& detail : from.details)
        details_.push_back(detailBlock(detail, octaves));
    materials_ = details_.empty() ? std::span<const BlobMaterial>() : from.materials;
    gatherVolumes(in, from);
    const bool isFilledEarly = isShown && (!details_.empty() || !groupVolumes_.empty());
    blobs_ = isFilledEarly ? from.blobs : std::span<const BlobInstance>();
    networkCells_ = networkCellsOf(*in.settings);
    const FieldPlanInputs inputs{from.blobs,
                                 effects_,
                                 in.camera,
                                 targets.width,
                                 targets.height,
                                 in.settings->voxels,
                                 0,
                                 in.settings->slices.multiple,
                                 networkCells_,
                                 in.settings->slices.automatic,
                                 fieldVolumes_};
    if (!plan_.build(inputs)) {
        leaveFineVolumes();
        plan_.build(inputs);
    }
    wantLevels(in.assets);
    networkCells_ = plan_.hasNetworks() ? networkCells_ : 0;
    texelList_.build(plan_, details_, {from.blobs, materials_});
}

/// Effects whose volume is not in the asset table, or not yet in memory, are drawn as their balls.
void FieldMedia::gatherVolumes(const GatherInputs& in, const GatheredFrame& from)
{
    voxels_.beginFrame();
    exposure_ = exposureFromEv100(in.settings->exposureEv100);
    effects_.assign(from.effects.begin(), from.effects.end());
    groupVolumes_.clear();
    shownVoxels_.clear();
    fieldVolumes_.clear();
    for (BlobEffect& effect : effects_) {
        if (effect.volume < 0)
            continue;
        const GroupVolume& volume = from.volumes[size_t(effect.volume)];
        const std::optional<ShownVoxels> shown = voxels_.find(in.assets, volume);
        effect.volume = shown ? int(groupVolumes_.size()) : -1;
        if (!shown)
            continue;
        groupVolumes_.push_back(volume);
        shownVoxels_.push_back(*shown);
        fieldVolumes_.push_back({volume.origin(), volume.side, volume.isAligned,
                                 float(double(shown->largest) * volume.density), shown->isFine});
    }
}

/// Their finest voxels are too many, and there are no others yet: they are drawn as their balls.
void FieldMedia::leaveFineVolumes()
{
    for (BlobEffect& effect : effects_)
        if (effect.volume >= 0 && fieldVolumes_[size_t(effect.volume)].isFine)
            effect.volume = -1;
}

/// So that the levels are there when the next frames need them.
void FieldMedia::wantLevels(const base::AssetTable* assets)
{
    for (size_t i = 0; assets && i < shownVoxels_.size(); ++i) {
        const auto placed = std::ranges::find(plan_.volumes(), uint32_t(i), &PlacedVolume::volume);
        const bool isPlaced = placed != plan_.volumes().end();
        const bool isLeft = // by leaveFineVolumes()
            std::ranges::none_of(effects_, [&](const auto& effect) { return effect.volume == int(i); });
        if (isLeft || (isPlaced && (placed->level > 0 || placed->wantsCoarser)))
            voxels_.wantCoarser(*assets, shownVoxels_[i]);
    }
}

std::array<std::span<const std::byte>, FieldMedia::Lists> FieldMedia::contents() const
{
    return {std::as_bytes(plan_.fields()),
            std::as_bytes(plan_.bricks()),
            std::as_bytes(plan_.balls()),
            std::as_bytes(texelList_.texels()),
            std::as_bytes(texelList_.tiles()),
            std::as_bytes(materials_),
            std::as_bytes(blobs_),
            stacks_,
            std::as_bytes(plan_.near().bricks()),
            std::as_bytes(plan_.near().parts())};
}

base::Status FieldMedia::makeRoom()
{
    const auto wanted = contents();
    for (size_t i = 0; i < Lists; ++i)
        if (base::Status status =
                render::makeRoom(device_, buffers_[i], wanted[i].size(), kListNames[i].data());
            !status)
            return status;
    base::Status status;
    for (const PlacedVolume& placed : plan_.volumes())
        if (status)
            status = voxels_.makeRoom(shownVoxels_[placed.volume], placed.level);
    for (size_t i = 0; status && i < textures_.size(); ++i)
        if (isUsed(i))
            status = makeTexture(i);
    if (status && !plan_.isEmpty())
        status = makeTexels(texelTexture_, texelList_.texels().size(), kFieldColumns, Format::RGBA32F,
                            "field texels");
    if (status && !plan_.isEmpty())
        status = makeTexels(table_, plan_.table().size(), kTableColumns, Format::R32F, "field table");
    return status && !details_.empty() ? lumpTile_.makeRoom(device_) : status;
}

bool FieldMedia::setStacks(std::span<const std::byte> stacks)
{
    stacks_ = stacks;
    if (render::makeRoom(device_, buffers_[Stacks], stacks_.size(), kListNames[Stacks].data()))
        return true;
    stacks_ = {};
    return false;
}

base::Status FieldMedia::makeTexels(GlTexture& io, size_t count, int columns, Format format, const char* name)
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
bool FieldMedia::isUsed(size_t texture) const
{
    constexpr size_t kChange = 5;
    return texture < 2 || (texture == 2 ? layers_ : !details_.empty()) ||
           (texture == kChange && !plan_.volumes().empty());
}

/// A half more than is needed when it grows, so that it does not grow in each frame.
base::Status FieldMedia::makeTexture(size_t i)
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

void FieldMedia::importAll(FrameGraph& graph)
{
    const auto sizes = contents();
    for (size_t i = 0; i < Lists; ++i)
        ids_[i] = sizes[i].empty() ? ResourceId()
                                   : graph.importBuffer({kListNames[i], std::bit_ceil(sizes[i].size())},
                                                        buffers_[i].name());
    const auto texture = [&](size_t i) {
        return isUsed(i) ? graph.importTexture({kTextureNames[i], textures_[i].width(), textures_[i].height(),
                                                kFieldFormats[i]},
                                               textures_[i].name())
                         : ResourceId();
    };
    const auto texels = [&](const GlTexture& from, Format format, std::string_view name) {
        return graph.importTexture({name, from.width(), from.height(), format}, from.name());
    };
    texturesIds_ = {texture(0),
                    texture(1),
                    texture(2),
                    texels(table_, Format::R32F, "field table"),
                    {texture(3), texture(4)},
                    texture(5)};
    fieldTexels_ = texels(texelTexture_, Format::RGBA32F, "field texels");
    lumpTileId_ = details_.empty() ? ResourceId() : lumpTile_.addTo(graph);
}

void FieldMedia::upload(FrameGraph& graph)
{
    graph.addPass("field upload", [&](FrameGraph::Builder& builder) {
        for (ResourceId& id : ids_)
            id = id.valid() ? builder.write(id) : id;
        return [ids = ids_, lists = contents()](Backend& backend) {
            for (size_t i = 0; i < Lists; ++i)
                if (ids[i].valid())
                    backend.upload(ids[i], lists[i]);
        };
    });
}

void FieldMedia::fill(FrameGraph& graph, ResourceId blobs)
{
    fieldTexels_ = FieldTexelPass::addTo(graph, ids_[Texels], texelList_.texels().size(), fieldTexels_);
    texturesIds_ =
        FieldFillPass::addTo(graph, {blobs, fieldTexels_, ids_[Bricks], ids_[Balls], texturesIds_,
                                     uint32_t(plan_.bricks().size()), ids_[Materials], lumpTileId_})
            .textures;
    fillVolumes(graph, blobs);
}

void FieldMedia::fillVolumes(FrameGraph& graph, ResourceId blobs)
{
    for (const PlacedVolume& placed : plan_.volumes()) {
        if (placed.brickCount == 0)
            continue;
        const GroupVolume& volume = groupVolumes_[placed.volume];
        FieldVolumePass::Inputs in{};
        in.balls = blobs;
        in.fieldTexels = fieldTexels_;
        in.bricks = ids_[Bricks];
        in.brickBalls = ids_[Balls];
        in.textures = texturesIds_;
        in.brickCount = placed.brickCount;
        in.block.first.x = int(placed.firstBrick);
        const double perLevel = std::ldexp(1.0, -placed.level);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column)
                in.block.rows[row][column] = float(volume.toVoxels[column][row] * perLevel);
            in.block.rows[row].w = float(volume.first[row] * perLevel);
        }
        const bool isFire = volume.layer == 0, isDust = volume.layer == 2;
        const float fire = isFire ? 1.0f : volume.fireShare;
        in.block.factors = {float(volume.density), float(volume.density * double(exposure_)),
                            volume.anisotropy, 0.0f};
        in.block.tint = glm::vec4(volume.tint, 1.0f);
        in.block.share = {fire, isDust ? 1.0f - fire : 0.0f, isFire ? 1.0f : 0.0f, isDust ? 1.0f : 0.0f};
        voxels_.import(graph, shownVoxels_[placed.volume], placed.level, in);
        texturesIds_ = FieldVolumePass::addTo(graph, in).textures;
    }
}

FieldGlowPass::Inputs FieldMedia::sources() const
{
    return {.fieldTexels = fieldTexels_,
            .field = texturesIds_,
            .lumpTile = lumpTileId_,
            .detail = !details_.empty(),
            .grids = {},
            .glow = {},
            .fieldCount = uint32_t(plan_.fields().size()),
            .gridCount = 0,
            .extent = {}};
}

void FieldMedia::release()
{
    buffers_ = {};
    textures_ = {};
    texelTexture_ = {};
    table_ = {};
    lumpTile_.release();
    voxels_.release();
}

uint64_t FieldMedia::bytes() const
{
    uint64_t sum = lumpTile_.bytes() + texelTexture_.bytes() + table_.bytes() + voxels_.bytes();
    for (const GlBuffer& buffer : buffers_)
        sum += buffer.bytes();
    for (const GlTexture& texture : textures_)
        sum += texture.bytes();
    return sum;
}

} // namespace fx::render
