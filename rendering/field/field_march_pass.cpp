#include "rendering/field/field_march_pass.h"

#include "rendering/field/field_texels.h"

namespace fx::render {

namespace {

constexpr ProgramDesc program(const char* vertex, const char* defines)
{
    return {"field march", vertex, "field/field_march.frag.glsl", nullptr, defines};
}
constexpr ProgramDesc ofFields(const char* defines)
{
    return program("field/field_march.vert.glsl", defines);
}
constexpr ProgramDesc withLoose(const char* defines)
{
    return program("slabs/slabs.vert.glsl", defines);
}

// index = loose * 4 + detail * 2 + layers
constexpr ProgramDesc kPrograms[kFieldMarchPrograms] = {
    ofFields("FX_LAYERS=0 FX_DETAIL=0 FX_LOOSE=0"),
    ofFields("FX_LAYERS=1 FX_DETAIL=0 FX_LOOSE=0"),
    ofFields("FX_LAYERS=0 FX_DETAIL=1 FX_LOOSE=0"),
    ofFields("FX_LAYERS=1 FX_DETAIL=1 FX_LOOSE=0"),
    withLoose("FX_LAYERS=0 FX_DETAIL=0 FX_LOOSE=1 FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_NETWORK=0"),
    withLoose("FX_LAYERS=1 FX_DETAIL=0 FX_LOOSE=1 FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_NETWORK=0"),
    withLoose("FX_LAYERS=0 FX_DETAIL=1 FX_LOOSE=1 FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_NETWORK=0"),
    withLoose("FX_LAYERS=1 FX_DETAIL=1 FX_LOOSE=1 FX_BALL_DETAIL=1 FX_FIELD_DETAIL=0 FX_NETWORK=0"),
};

/// Where shaders/field and shaders/slabs read them.
enum : uint32_t
{
    MediumUnit = 1,
    ScatterUnit = 2,
    SharesUnit = 3,
    MaterialUnit = 4,
    BallUnit = 8,
    ListUnit = 9,
    LumpUnit = 10,
};

/// What one draw reads, in arrays of constant size.
struct March
{
    FieldMarchPass::Inputs in;
    MediaPass::Inputs media;

    bool isLoose() const { return in.loose.tiles.valid(); }

    void draw(Backend& backend, std::span<const ResourceId> targets) const
    {
        TextureBinding textures[kMaxTextures];
        BufferBinding buffers[kMaxBuffers];
        ViewBlock block = media.view;
        block.pass.y = in.loose.cards.valid() ? 1.0f : 0.0f;
        block.pass.z = float(in.loose.slabs);
        DrawCall call;
        call.program = &fieldMarchProgram(media.layers, in.lumpTile.valid(), isLoose());
        call.targets = targets;
        call.textures = {textures, bindTextures(textures)};
        call.buffers = {buffers, bindBuffers(buffers)};
        call.uniforms = asUniforms(block);
        call.blend = Blend::Premultiplied;
        call.vertices = 6;
        call.instances = uint32_t(kFieldTiles);
        call.indirect = in.loose.tiles;
        backend.draw(call);
    }

    void read(FrameGraph::Builder& builder) const
    {
        for (const ResourceId id :
             {in.textures.medium, in.textures.scatter, in.textures.shares, in.textures.material[0],
              in.textures.material[1], in.textures.table, in.fieldTexels, in.tiles, in.lumpTile,
              in.loose.tiles, in.loose.lists, in.loose.balls, in.loose.cards.heads, in.loose.cards.nodes,
              media.distance})
            if (id.valid())
                builder.read(id);
        if (isLoose())
            media.lights.read(builder);
    }

private:
    static constexpr size_t kMaxTextures = 13, kMaxBuffers = 5;

    size_t bindTextures(TextureBinding* out) const
    {
        size_t count = 0;
        const auto bind = [&](uint32_t unit, ResourceId id, Sampling sampling) {
            if (id.valid())
                out[count++] = {unit, id, sampling};
        };
        bind(0, media.distance, Sampling::Nearest);
        bind(kFieldTexelUnit, in.fieldTexels, Sampling::Nearest);
        bind(kBrickTableUnit, in.textures.table, Sampling::Nearest);
        bind(MediumUnit, in.textures.medium, Sampling::Linear);
        if (media.layers || in.lumpTile.valid())
            bind(ScatterUnit, in.textures.scatter, Sampling::Linear);
        bind(SharesUnit, in.textures.shares, Sampling::Linear);
        for (uint32_t g = 0; g < 2; ++g)
            bind(MaterialUnit + g, in.textures.material[g], Sampling::Linear);
        bind(LumpUnit, in.lumpTile, Sampling::LinearRepeat);
        bind(BallUnit, in.loose.balls, Sampling::Nearest);
        bind(ListUnit, in.loose.lists, Sampling::Nearest);
        if (isLoose() && media.lights.planes.valid())
            out[count++] = media.lights.textureBinding();
        if (isLoose() && media.lights.hostShadow.valid())
            out[count++] = media.lights.hostShadowBinding();
        return count;
    }

    size_t bindBuffers(BufferBinding* out) const
    {
        size_t count = 0;
        out[count++] = {3, in.tiles};
        if (!isLoose())
            return count;
        const auto orTiles = [&](ResourceId id) { return id.valid() ? id : in.loose.tiles; }; // never read
        out[count++] = {2, in.loose.tiles};
        out[count++] = {kCardHeadBinding, orTiles(in.loose.cards.heads)};
        out[count++] = {kCardNodeBinding, orTiles(in.loose.cards.nodes)};
        if (media.lights.lights.valid())
            out[count++] = media.lights.bufferBinding();
        return count;
    }
};

} // namespace

const ProgramDesc& fieldMarchProgram(bool layers, bool detail, bool loose)
{
    return kPrograms[(loose ? 4 : 0) + (detail ? 2 : 0) + (layers ? 1 : 0)];
}

const ProgramDesc& fieldMarchProgramAt(size_t index)
{
    return kPrograms[index];
}

MediaPass::Outputs FieldMarchPass::addTo(FrameGraph& graph, const Inputs& in, const MediaPass::Outputs& under)
{
    MediaPass::Outputs out = under;
    graph.addPass("field march", [&](FrameGraph::Builder& builder) {
        const March march{in, *in.media};
        march.read(builder);
        const MediaTargets targets(builder, march.media, under);
        out = targets.outputs();
        return [march, targets](Backend& backend) {
            targets.clear(backend);
            march.draw(backend, targets.all());
        };
    });
    return out;
}

} // namespace fx::render
