#include "rendering/field/field_source.h"

namespace fx::render {

namespace {

constexpr ProgramDesc kPrograms[] = {{"field march", "field/field_march.vert.glsl",
                                      "field/field_march.frag.glsl", nullptr, "FX_LAYERS=0\nFX_DETAIL=0"},
                                     {"field march", "field/field_march.vert.glsl",
                                      "field/field_march.frag.glsl", nullptr, "FX_LAYERS=1\nFX_DETAIL=0"},
                                     {"field march", "field/field_march.vert.glsl",
                                      "field/field_march.frag.glsl", nullptr, "FX_LAYERS=0\nFX_DETAIL=1"},
                                     {"field march", "field/field_march.vert.glsl",
                                      "field/field_march.frag.glsl", nullptr, "FX_LAYERS=1\nFX_DETAIL=1"}};

constexpr float kFar = 1e30f; ///< [m]

} // namespace

const ProgramDesc& fieldMarchProgram(bool layers, bool detail)
{
    return kPrograms[(layers ? 1 : 0) + (detail ? 2 : 0)];
}

/// The first and the last shell go on, so that no rounding leaves anything out.
void FieldSource::placeShells(float nearest, float farthest)
{
    const float thickness = (farthest - nearest) / float(kShells);
    for (uint32_t i = 0; i <= kShells; ++i)
        edges_[i] = farthest - float(i) * thickness;
    for (uint32_t i = 0; i < kShells; ++i) {
        middles_[i] = 0.5f * (edges_[i] + edges_[i + 1]);
        order_[i] = i;
    }
    edges_.front() = kFar;
    edges_.back() = 0.0f;
}

DrawStream FieldSource::stream() const
{
    DrawStream stream;
    stream.count = kShells;
    stream.distances = middles_.data();
    stream.order = order_.data();
    stream.source = this;
    return stream;
}

void FieldSource::read(FrameGraph::Builder& builder) const
{
    for (const ResourceId id : {textures.medium, textures.scatter, textures.shares, textures.material[0],
                                textures.material[1], fields, table, tiles, tileFields, details, lumpTile})
        if (id.valid())
            builder.read(id);
}

void FieldSource::draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const
{
    ViewBlock view = *target.view;
    view.pass.y = edges_[batch.first + batch.count];
    view.pass.z = edges_[batch.first];
    const bool detail = details.valid();
    TextureBinding images[7] = {{0, target.distance}, {1, textures.medium, Sampling::Linear}};
    size_t count = 2;
    if (target.layers || detail)
        images[count++] = {2, textures.scatter, Sampling::Linear};
    if (target.layers)
        images[count++] = {3, textures.shares, Sampling::Linear};
    for (uint32_t g = 0; detail && g < 2; ++g)
        images[count++] = {4 + g, textures.material[g], Sampling::Linear};
    if (detail)
        images[count++] = {6, lumpTile, Sampling::LinearRepeat};
    const BufferBinding buffers[] = {{1, fields}, {2, table}, {3, tiles}, {4, tileFields}, {5, details}};
    DrawCall call;
    call.program = &fieldMarchProgram(target.layers, detail);
    call.targets = target.targets;
    call.textures = std::span(images).first(count);
    call.buffers = std::span(buffers).first(detail ? 5 : 4);
    call.uniforms = asUniforms(view);
    call.blend = Blend::Premultiplied;
    call.vertices = 6;
    call.instances = tileCount;
    backend.draw(call);
}

} // namespace fx::render
