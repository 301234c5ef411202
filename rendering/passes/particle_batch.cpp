#include "rendering/passes/particle_batch.h"

#include <algorithm>

namespace fx::render {

namespace {

constexpr ProgramDesc sprite(const char* defines)
{
    return {"sprites", "sprites/sprite.vert.glsl", "sprites/sprite.frag.glsl", nullptr, defines};
}
constexpr ProgramDesc ribbon(const char* defines)
{
    return {"ribbons", "ribbons/ribbon.vert.glsl", "ribbons/ribbon.frag.glsl", nullptr, defines};
}
constexpr ProgramDesc mesh(const char* defines)
{
    return {"particle meshes", "sprites/particle_mesh.vert.glsl", "sprites/particle_mesh.frag.glsl", nullptr,
            defines};
}

// index = shape * 4 + solid * 2 + layers
constexpr ProgramDesc kPrograms[kParticlePrograms] = {
    sprite("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=0"), sprite("FX_SOLID=0 FX_LAYERS=1 FX_CARDS=0"),
    sprite("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0"), sprite("FX_SOLID=1 FX_LAYERS=1 FX_CARDS=0"),
    ribbon("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=0"), ribbon("FX_SOLID=0 FX_LAYERS=1 FX_CARDS=0"),
    ribbon("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0"), ribbon("FX_SOLID=1 FX_LAYERS=1 FX_CARDS=0"),
    mesh("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=0"),   mesh("FX_SOLID=0 FX_LAYERS=1 FX_CARDS=0"),
    mesh("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0"),   mesh("FX_SOLID=1 FX_LAYERS=1 FX_CARDS=0"),
};

constexpr ProgramDesc kCardPrograms[] = {sprite("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1"),
                                         ribbon("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1"),
                                         mesh("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1")};
static_assert(std::size(kCardPrograms) == size_t(BatchShape::Count));

constexpr ProgramDesc kMarkedCardPrograms[] = {sprite("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1 FX_MARKS=1"),
                                               ribbon("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1 FX_MARKS=1"),
                                               mesh("FX_SOLID=0 FX_LAYERS=0 FX_CARDS=1 FX_MARKS=1")};
constexpr ProgramDesc kMarkedSolidPrograms[] = {sprite("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0 FX_MARKS=1"),
                                                ribbon("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0 FX_MARKS=1"),
                                                mesh("FX_SOLID=1 FX_LAYERS=0 FX_CARDS=0 FX_MARKS=1")};
static_assert(std::size(kMarkedCardPrograms) == size_t(BatchShape::Count) &&
              std::size(kMarkedSolidPrograms) == size_t(BatchShape::Count));

} // namespace

const ProgramDesc& particleProgramAt(size_t index)
{
    return kPrograms[index];
}

const ProgramDesc& cardProgram(BatchShape shape)
{
    return kCardPrograms[size_t(shape)];
}

const ProgramDesc& markedCardProgram(BatchShape shape)
{
    return kMarkedCardPrograms[size_t(shape)];
}

const ProgramDesc& markedSolidProgram(BatchShape shape)
{
    return kMarkedSolidPrograms[size_t(shape)];
}

const ProgramDesc& particleProgram(BatchShape shape, bool isSolid, bool layers)
{
    return kPrograms[size_t(shape) * 4 + (isSolid ? 2 : 0) + (layers ? 1 : 0)];
}

namespace {

const ProgramDesc& programOf(const ParticleBatch& batch, const MediaTarget& target)
{
    if (target.isMarked)
        return markedSolidProgram(batch.shape);
    if (target.cards.valid())
        return target.cards.marks.valid() ? markedCardProgram(batch.shape) : cardProgram(batch.shape);
    return particleProgram(batch.shape, batch.isSolid, target.layers);
}

/// Draws instances `first` to `first + count` of a batch.
void drawBatch(Backend& backend, const ParticleBatch& batch, uint32_t first, uint32_t count,
               const MediaTarget& target, ResourceId depth)
{
    MarkedParticleBlock marked{batch.block, batch.drift, batch.instance};
    ParticleBlock& block = marked.particles;
    block.view = *target.view;
    block.rows[2] = int32_t(first);
    TextureBinding textures[] = {
        {0, target.distance},
        {1, batch.textureId, batch.repeats ? Sampling::TrilinearRepeat : Sampling::Trilinear},
        {2, batch.motionId, Sampling::Trilinear},
        {},
        {}};
    size_t textureCount = 3, bufferCount = 4;
    const BufferPart* parts[] = {&batch.newer, &batch.older, &batch.order, &batch.mesh};
    std::array<BufferBinding, 8> buffers;
    for (uint32_t i = 0; i < 4; ++i) { // what is not there is never read, but something has to be bound
        const BufferPart& part = parts[i]->bytes > 0 ? *parts[i] : batch.newer;
        buffers[i] = {i, part.id, part.offset, part.bytes};
    }
    if (target.lights.lights.valid())
        buffers[bufferCount++] = target.lights.bufferBinding();
    else
        block.shine.y = 0.0f; // nothing is lit
    if (target.lights.planes.valid())
        textures[textureCount++] = target.lights.textureBinding();
    if (target.lights.hostShadow.valid())
        textures[textureCount++] = target.lights.hostShadowBinding();
    if (target.cards.valid()) {
        buffers[bufferCount++] = {kCardHeadBinding, target.cards.heads};
        buffers[bufferCount++] = {kCardNodeBinding, target.cards.nodes};
    }
    if (target.cards.marks.valid())
        buffers[bufferCount++] = {kCardMarkBinding, target.cards.marks};
    DrawCall call;
    call.program = &programOf(batch, target);
    call.targets = target.targets;
    call.textures = {textures, textureCount};
    call.buffers = {buffers.data(), bufferCount};
    call.uniforms = target.isMarked || target.cards.marks.valid() ? asUniforms(marked) : asUniforms(block);
    call.blend = batch.isSolid ? Blend::None : Blend::Premultiplied;
    const bool isMesh = batch.shape == BatchShape::Mesh;
    call.vertices = isMesh ? batch.vertices : batch.vertices * count;
    call.instances = isMesh ? count : 1;
    call.indirect = batch.arguments;
    call.depthTarget = depth;
    call.reversedDepth = true;
    backend.draw(call);
}

} // namespace

void BatchSource::read(FrameGraph::Builder& builder) const
{
    for (const ParticleBatch& batch : batches) {
        for (const BufferPart* part : {&batch.newer, &batch.older, &batch.order, &batch.mesh})
            if (part->bytes > 0)
                builder.read(part->id);
        if (batch.arguments.valid())
            builder.read(batch.arguments);
        builder.read(batch.textureId);
        builder.read(batch.motionId);
    }
}

void BatchSource::draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const
{
    drawBatch(backend, batches[batch.batch], batch.first, batch.count, target, {});
}

bool BatchSource::hasSolids() const
{
    return std::ranges::any_of(batches, [](const ParticleBatch& batch) { return batch.isSolid; });
}

void BatchSource::drawSolids(Backend& backend, const MediaTarget& target, ResourceId depth) const
{
    for (const ParticleBatch& batch : batches)
        if (batch.isSolid)
            drawBatch(backend, batch, 0, batch.instances, target, depth);
}

} // namespace fx::render
