#include "rendering/passes/blob_source.h"

namespace fx::render {

namespace {

constexpr ProgramDesc program(const char* defines)
{
    return {"media", "blobs/media.vert.glsl", "blobs/media.frag.glsl", nullptr, defines};
}

// index = small * 12 + form * 4 + detail * 2 + layers
constexpr ProgramDesc kPrograms[kMediaPrograms] = {
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=0"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=0"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=0 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=1 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=0 FX_LAYERS=1 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=0 FX_SMALL=1"),
    program("FX_FORM=2 FX_DETAIL=1 FX_LAYERS=1 FX_SMALL=1"),
};

} // namespace

const ProgramDesc& mediaProgramAt(size_t index)
{
    return kPrograms[index];
}

const ProgramDesc& mediaProgram(BillboardForm form, bool detail, bool layers, bool isSmall)
{
    return kPrograms[(isSmall ? kMediaPrograms / 2 : 0) + size_t(form) * 4 + (detail ? 2 : 0) +
                     (layers ? 1 : 0)];
}

void BlobSource::read(FrameGraph::Builder& builder) const
{
    builder.read(blobs);
    if (blobLights.valid())
        builder.read(blobLights);
}

void BlobSource::draw(Backend& backend, const DrawBatch& batch, const MediaTarget& target) const
{
    QuadInputs inputs{blobs};
    inputs.lights = &target.lights;
    inputs.blobLights = blobLights;
    drawQuads(backend, mediaProgram(form, detail, target.layers, target.isSmall), inputs, batch, target);
}

} // namespace fx::render
