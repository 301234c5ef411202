#include "rendering/compositions/slabs/slab_passes.h"

#include "rendering/field/field_texels.h"
#include "rendering/passes/output_marks.h"

#include <algorithm>
#include <bit>

namespace fx::render {

namespace {

constexpr ProgramDesc program(const char* defines)
{
    return {"slabs", "slabs/slabs.vert.glsl", "slabs/slabs.frag.glsl", nullptr, defines};
}

#define FX_SLAB_PROGRAMS(slabs, network, blocks)                                                             \
    program("FX_BALL_DETAIL=0 FX_FIELD_DETAIL=0 FX_LAYERS=0" slabs network blocks),                          \
        program("FX_BALL_DETAIL=0 FX_FIELD_DETAIL=0 FX_LAYERS=1" slabs network blocks),                      \
        program("FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_LAYERS=0" slabs network blocks),                      \
        program("FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_LAYERS=1" slabs network blocks),                      \
        program("FX_BALL_DETAIL=1 FX_FIELD_DETAIL=1 FX_LAYERS=0" slabs network blocks),                      \
        program("FX_BALL_DETAIL=1 FX_FIELD_DETAIL=1 FX_LAYERS=1" slabs network blocks)

#define FX_SLAB_PROGRAMS_OF(blocks)                                                                          \
    FX_SLAB_PROGRAMS(" FX_SLABS=6", " FX_NETWORK=0", blocks),                                                \
        FX_SLAB_PROGRAMS(" FX_SLABS=16", " FX_NETWORK=0", blocks),                                           \
        FX_SLAB_PROGRAMS(" FX_SLABS=6", " FX_NETWORK=1", blocks),                                            \
        FX_SLAB_PROGRAMS(" FX_SLABS=16", " FX_NETWORK=1", blocks)

// index = blocks * 24 + network * 12 + (16 slabs) * 6 + SlabDetail * 2 + layers
constexpr ProgramDesc kPrograms[kSlabPrograms] = {FX_SLAB_PROGRAMS_OF(" FX_BLOCKS=0"),
                                                  FX_SLAB_PROGRAMS_OF(" FX_BLOCKS=1")};
#undef FX_SLAB_PROGRAMS_OF
#undef FX_SLAB_PROGRAMS

constexpr ProgramDesc kBallPrograms[] = {
    {"slab balls", nullptr, nullptr, "slabs/slab_balls.comp.glsl", "FX_FIELD_DETAIL=0 FX_BLOCKS=0"},
    {"slab balls", nullptr, nullptr, "slabs/slab_balls.comp.glsl", "FX_FIELD_DETAIL=1 FX_BLOCKS=0"},
    {"slab balls", nullptr, nullptr, "slabs/slab_balls.comp.glsl", "FX_FIELD_DETAIL=0 FX_BLOCKS=1"},
    {"slab balls", nullptr, nullptr, "slabs/slab_balls.comp.glsl", "FX_FIELD_DETAIL=1 FX_BLOCKS=1"},
};

constexpr uint32_t kLumpUnit = 10;          ///< as in shaders/field/field_detail.glsl
constexpr uint32_t kRecordBinding = 7;      ///< as in shaders/slabs/slab_balls.comp.glsl
constexpr uint32_t kAtlasUnit = 12;         ///< as in shaders/blocks/block_chord.glsl
constexpr uint32_t kMaterialBinding = 4;    ///< as in shaders/slabs/slab_balls.comp.glsl
constexpr uint32_t kNetworkUnit = 3;        ///< as in shaders/network/network_gather.glsl
constexpr uint32_t kNetworkGridBinding = 3; ///< as in shaders/field/field_glow.glsl
constexpr size_t kCardBytes = 32;
constexpr size_t kTileBytes = 16;
constexpr uint32_t kBallColumns = 2048; ///< as in shaders/slabs/slab_balls.glsl
constexpr int kBallTexels = 11;         ///< likewise
constexpr int kTextureSide = 16384;     ///< [texel] that every OpenGL 4.5 has
constexpr uint32_t kListColumns = 4096; ///< likewise

int tilesAlong(int texels)
{
    return (texels + kSlabTile - 1) / kSlabTile;
}

size_t headWords(int width, int height)
{
    return 4 + size_t(tilesAlong(width)) * size_t(tilesAlong(height)) + size_t(width) * size_t(height);
}

ResourceId makeBuffer(FrameGraph::Builder& builder, std::string_view name, size_t bytes)
{
    return builder.write(builder.create(BufferDesc{name, std::bit_ceil(bytes)}));
}

} // namespace

const ProgramDesc& slabProgram(int slabs, SlabDetail detail, bool layers, bool network, bool blocks)
{
    return kPrograms[(blocks ? 24 : 0) + (network ? 12 : 0) + (slabs > 6 ? 6 : 0) + 2 * size_t(detail) +
                     (layers ? 1 : 0)];
}

const ProgramDesc& slabBallsProgram(bool detail, bool blocks)
{
    return kBallPrograms[(blocks ? 2 : 0) + (detail ? 1 : 0)];
}

const ProgramDesc& slabProgramAt(size_t index)
{
    return kPrograms[index];
}

CardLists SlabCardPass::addTo(FrameGraph& graph, const Inputs& in)
{
    CardLists cards;
    if (in.batches.empty())
        return cards;
    graph.addPass("slab cards", [&](FrameGraph::Builder& builder) {
        const MediaPass::Inputs& media = *in.media;
        for (const DrawBatch& batch : in.batches)
            batch.source->read(builder);
        builder.read(media.distance);
        media.lights.read(builder);
        const size_t words = headWords(media.width, media.height);
        cards.heads = builder.write(builder.create(BufferDesc{"card heads", words * 4}));
        cards.nodes = makeBuffer(builder, "cards", size_t(in.capacity) * kCardBytes);
        if (in.marks)
            cards.marks = makeBuffer(builder, "marks of cards", size_t(in.capacity) * kCardMarkBytes);
        const ResourceId fragments =
            builder.write(builder.create({"cards of texels", media.width, media.height, Format::R32F}));
        return [media, cards, fragments, words, batches = in.batches](Backend& backend) {
            const BufferBinding buffers[] = {{kCardHeadBinding, cards.heads},
                                             {kCardNodeBinding, cards.nodes}};
            DispatchCall empty;
            empty.program = &kSlabCardsProgram;
            empty.buffers = buffers;
            empty.groups[0] = uint32_t((words + 63) / 64);
            backend.dispatch(empty);
            backend.clear(fragments, {0.0f, 0.0f, 0.0f, 0.0f});
            MediaTarget target{&media.view, media.distance, {&fragments, 1},
                               false,       media.isSmall,  media.lights};
            target.cards = cards;
            for (const DrawBatch& batch : batches)
                batch.source->draw(backend, batch, target);
        };
    });
    return cards;
}

SlabDetailPass::Outputs SlabDetailPass::addTo(FrameGraph& graph, const BallDetails& in)
{
    if (in.materials.empty())
        return {};
    Outputs out{{}, {}, in.lumpTile};
    ResourceId list;
    graph.addPass("slab detail upload", [&](FrameGraph::Builder& builder) {
        list = makeBuffer(builder, "slab details", in.details.size_bytes());
        out.materials = makeBuffer(builder, "slab materials", in.materials.size_bytes());
        return [list, in, materials = out.materials](Backend& backend) {
            backend.upload(list, std::as_bytes(in.details));
            backend.upload(materials, std::as_bytes(in.materials));
        };
    });
    out.texels = FieldTexelPass::addTo(graph, list, in.details.size() * kDetailTexels, {});
    return out;
}

ResourceId SlabBallPass::addTo(FrameGraph& graph, const BallList& list, const SlabDetailPass::Outputs& detail,
                               const ViewBlock& view, bool readsTiles)
{
    ResourceId texture;
    if (list.instances.empty())
        return texture;
    graph.addPass("slab balls", [&](FrameGraph::Builder& builder) {
        builder.read(list.balls);
        builder.read(list.lights);
        const ResourceId records = readsTiles ? list.tiles.records : ResourceId();
        for (const ResourceId id : {detail.texels, detail.materials, records})
            if (id.valid())
                builder.read(id);
        const uint32_t count = uint32_t(list.instances.size());
        const uint32_t most = uint32_t(kTextureSide / kBallTexels);
        const uint32_t needed = (count + kBallColumns - 1) / kBallColumns;
        const int rows = int(std::max(std::min(std::bit_ceil(needed), most), needed)) * kBallTexels;
        texture =
            builder.write(builder.create({"balls as texels", int(kBallColumns), rows, Format::RGBA32F}));
        ViewBlock block = view;
        block.pass.y = float(count); // exact up to 2^24
        block.pass.z = float(kBlobLightBytes / sizeof(glm::vec4));
        return [block, texture, count, detail, records, given = list.balls,
                lights = list.lights](Backend& backend) {
            const bool hasDetail = detail.texels.valid();
            BufferBinding buffers[4] = {{0, given}, {kBlobLightBinding, lights}};
            size_t bufferCount = 2;
            if (hasDetail)
                buffers[bufferCount++] = {kMaterialBinding, detail.materials};
            if (records.valid())
                buffers[bufferCount++] = {kRecordBinding, records};
            const ImageBinding images[] = {{0, texture}};
            const TextureBinding textures[] = {{kFieldTexelUnit, detail.texels}};
            DispatchCall call;
            call.program = &slabBallsProgram(hasDetail, records.valid());
            call.buffers = std::span(buffers).first(bufferCount);
            call.textures = std::span(textures).first(hasDetail ? 1 : 0);
            call.images = images;
            call.uniforms = asUniforms(block);
            call.groups[0] = (count + 63) / 64;
            backend.dispatch(call);
        };
    });
    return texture;
}

SlabTilePass::Outputs SlabTilePass::addTo(FrameGraph& graph, const Inputs& in)
{
    Outputs out;
    const uint32_t columns = uint32_t(tilesAlong(in.width)), rows = uint32_t(tilesAlong(in.height));
    const size_t tiles = size_t(columns) * rows;
    const uint64_t room = std::clamp<uint64_t>(in.entries, 1, kMaxListedBalls);
    ResourceId rects;
    graph.addPass("slab upload", [&](FrameGraph::Builder& builder) {
        rects = makeBuffer(builder, "tiles of balls", std::max<size_t>(in.rects.size_bytes(), 64));
        out.tiles = makeBuffer(builder, "slab tiles", sizeof(SlabTileCounts) + tiles * kTileBytes);
        return [rects, tiles = out.tiles, given = in.rects](Backend& backend) {
            const SlabTileCounts none{6, 0, {0, 0}, 0, 0, {0, 0}};
            backend.upload(rects, std::as_bytes(given));
            backend.upload(tiles, asUniforms(none));
        };
    });
    graph.addPass("slab tiles", [&](FrameGraph::Builder& builder) {
        builder.read(rects);
        for (const ResourceId id : {in.cards.heads, in.fieldTiles})
            if (id.valid())
                builder.read(id);
        out.tiles = builder.write(out.tiles);
        const int listRows = int(std::bit_ceil(uint32_t((room + kListColumns - 1) / kListColumns)));
        out.lists =
            builder.write(builder.create({"balls of tiles", int(kListColumns), listRows, Format::R32UI}));
        const uint64_t most = in.entries <= kMaxListedBalls
                                  ? in.maxOfTile
                                  : std::min<uint64_t>(in.maxOfTile, kMaxListedBalls / tiles);
        struct Block
        {
            glm::ivec4 counts;
            glm::vec4 window;
        };
        const Block block{{int(in.rects.size()), int(columns), int(most), in.cards.valid() ? 1 : 0},
                          {float(in.width), float(in.height), in.flip, in.fieldTiles.valid() ? 1.0f : 0.0f}};
        return [block, rects, out, columns, rows, heads = in.cards.heads,
                fields = in.fieldTiles](Backend& backend) {
            const auto orTiles = [&](ResourceId id) { return id.valid() ? id : out.tiles; }; // never read
            const BufferBinding buffers[] = {
                {1, rects}, {2, out.tiles}, {3, orTiles(fields)}, {kCardHeadBinding, orTiles(heads)}};
            DispatchCall call;
            call.program = &kSlabTilesProgram;
            const ImageBinding images[] = {{0, out.lists}};
            call.buffers = buffers;
            call.images = images;
            call.uniforms = asUniforms(block);
            call.groups[0] = columns;
            call.groups[1] = rows;
            backend.dispatch(call);
        };
    });
    return out;
}

uint32_t SlabPass::maxOfTile(int slabs, SlabDetail detail, bool layers, size_t fields, bool blocks,
                             bool isCut)
{
    const uint32_t readsOfWindow =
        isCut ? 4 : 3;                      // rangeOf(), passedIn() twice, passedUpTo(), in slab_window.glsl
    constexpr uint32_t kTurnsOfField = 100; // of addEroded() in slab_detail.glsl, run between fields too
    constexpr uint32_t kGroups[] = {2, 4};  // of slabs that are filled at a time, see slabs.frag.glsl
    const bool isGrouped = detail == SlabDetail::OfFields || (layers && detail == SlabDetail::None);
    const uint32_t groups = isGrouped ? kGroups[slabs > 6 ? 1 : 0] : 1;
    const uint64_t ofFields =
        detail == SlabDetail::OfFields ? uint64_t(kTurnsOfField) * groups * (2 * fields + 1) : 0;
    const uint32_t left = kMaxLoopTurns - uint32_t(std::min<uint64_t>(ofFields, kMaxLoopTurns / 8));
    return left / (blocks ? 3 : 1) / (readsOfWindow + groups); // of a block, two loops of one turn
}

MediaPass::Outputs SlabPass::addTo(FrameGraph& graph, const Inputs& in, const MediaPass::Outputs& under)
{
    MediaPass::Outputs out = under;
    graph.addPass("slabs", [&](FrameGraph::Builder& builder) {
        const MediaPass::Inputs& media = *in.media;
        const bool hasNetworks = in.networks.moments.valid();
        // light along rays is that of balls with tiles only
        const BlobLightPass::Networks networks = in.blocks.valid() ? in.networks : BlobLightPass::Networks{};
        for (const ResourceId id :
             {in.balls, in.blocks.atlas, in.cards.heads, in.cards.nodes, in.fieldDetail.texels,
              in.fieldDetail.lumpTile, networks.moments, networks.grids})
            if (id.valid())
                builder.read(id);
        builder.read(in.tiles.tiles);
        builder.read(in.tiles.lists);
        builder.read(media.distance);
        media.lights.read(builder);
        const MediaTargets targets(builder, media, under);
        out = targets.outputs();
        return [view = media.view, distance = media.distance, lights = media.lights, balls = in.balls,
                cards = in.cards, tiles = in.tiles, detail = in.fieldDetail, atlas = in.blocks.atlas,
                networks,
                program = &slabProgram(in.slabs, in.detail, media.layers, hasNetworks, in.blocks.valid()),
                targets](Backend& backend) {
            targets.clear(backend);
            ViewBlock block = view;
            block.pass.y = cards.valid() ? 1.0f : 0.0f;
            block.pass.z = float(networks.block);
            block.pass.w = float(networks.gridCount);
            TextureBinding textures[9] = {{0, distance}, {9, tiles.lists}};
            size_t textureCount = 2;
            if (balls.valid())
                textures[textureCount++] = {8, balls};
            if (atlas.valid())
                textures[textureCount++] = {kAtlasUnit, atlas, Sampling::Linear};
            if (networks.moments.valid())
                textures[textureCount++] = {kNetworkUnit, networks.moments, Sampling::Linear};
            if (lights.planes.valid())
                textures[textureCount++] = lights.textureBinding();
            if (lights.hostShadow.valid())
                textures[textureCount++] = lights.hostShadowBinding();
            if (detail.texels.valid()) {
                textures[textureCount++] = {kFieldTexelUnit, detail.texels};
                textures[textureCount++] = {kLumpUnit, detail.lumpTile, Sampling::LinearRepeat};
            }
            const auto orTiles = [&](ResourceId id) { return id.valid() ? id : tiles.tiles; }; // never read
            BufferBinding buffers[5] = {{2, tiles.tiles},
                                        {kCardHeadBinding, orTiles(cards.heads)},
                                        {kCardNodeBinding, orTiles(cards.nodes)}};
            size_t bufferCount = 3;
            if (lights.lights.valid())
                buffers[bufferCount++] = lights.bufferBinding();
            if (networks.grids.valid())
                buffers[bufferCount++] = {kNetworkGridBinding, networks.grids};
            DrawCall call;
            call.program = program;
            call.targets = targets.all();
            call.textures = {textures, textureCount};
            call.buffers = {buffers, bufferCount};
            call.uniforms = asUniforms(block);
            call.blend = Blend::Premultiplied;
            call.vertices = 6;
            call.indirect = tiles.tiles;
            backend.draw(call);
        };
    });
    return out;
}

} // namespace fx::render
