#include "rendering/techniques/rows/row_view.h"

#include "rendering/gpu_particles/gpu_order_pass.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/particle_rows/row_casters.h"

namespace fx::render {

namespace {

std::pmr::vector<const RowTechnique*> rowTechniques(const TechniqueSetup& setup)
{
    std::pmr::vector<const RowTechnique*> techniques(setup.memory);
    for (const DrawTechnique* technique : setup.techniques)
        if (technique->rows)
            techniques.push_back(technique->rows);
    return techniques;
}

} // namespace

std::unique_ptr<TechniqueView> makeRowView(const TechniqueSetup& setup)
{
    return std::make_unique<RowView>(setup);
}

RowView::RowView(const TechniqueSetup& setup)
    : techniques_(rowTechniques(setup)),
      merger_(techniques_, setup.schema, setup.memory), single_{ParticleFrame(setup.memory),
                                                                ParticleBuffers(*setup.device, techniques_,
                                                                                setup.memory)},
      joined_{ParticleFrame(setup.memory), ParticleBuffers(*setup.device, techniques_, setup.memory)},
      batches_(setup.memory)
{}

base::Status RowView::gather(const GatherInputs& in, GatheredFrame& io)
{
    isKept_ = false;
    batches_.clear();
    source_.batches = {};
    isMerged_ = in.settings->outputs == 0; // outputs tell instances apart
    if (isMerged_)
        merger_.build(*in.snapshots, in.revisions, in.newerRows, in.olderRows);
    const base::SnapshotPair merged = isMerged_ ? merger_.merged() : base::SnapshotPair();
    ParticleFrameInputs inputs{in.snapshots, in.request, in.settings, in.camera};
    inputs.techniques = techniques_;
    inputs.lod = in.lod;
    inputs.left = taken();
    if (base::Status status = add(single_, inputs, {in.revisions, in.newerRows, in.olderRows}, in.assets, io);
        !status)
        return status;
    inputs.snapshots = &merged;
    inputs.left = {};
    inputs.merger = &merger_;
    if (base::Status status = add(
            joined_, inputs, {merger_.revisions(), merger_.newerRows(), merger_.olderRows()}, in.assets, io);
        !status)
        return status;
    source_.batches = batches_;
    if (in.castsShadows)
        addCasters(in, *io.casters);
    return {};
}

void RowView::addCasters(const GatherInputs& in, std::pmr::vector<MediumCaster>& io) const
{
    const size_t begin = io.size();
    const base::SnapshotPair merged = isMerged_ ? merger_.merged() : base::SnapshotPair();
    RowCasterInputs inputs{in.snapshots, techniques_, in.request->interpolation, in.camera->eye, taken()};
    gatherRowCasters(inputs, io);
    inputs.snapshots = &merged;
    inputs.left = {};
    if (isMerged_)
        gatherRowCasters(inputs, io);
    widenCasters(std::span(io).subspan(begin), io, in.settings->slices.resolution.texels);
}

base::Status RowView::add(Rows& rows, const ParticleFrameInputs& inputs, const UploadRevisions& of,
                          const base::AssetTable* assets, GatheredFrame& io)
{
    rows.frame.build(inputs);
    const bool refused = rows.buffers.refusesGpu();
    if (refused)
        rows.frame.dropComputed();
    base::Status status = rows.buffers.prepare(*inputs.snapshots, of, rows.frame, assets);
    if (!status && rows.buffers.refusesGpu() && !refused) { // the scene will send rows from now on
        rows.frame.dropComputed();
        status = rows.buffers.prepare(*inputs.snapshots, of, rows.frame, assets);
    }
    if (!status)
        return status;
    for (DrawStream stream : rows.frame.streams()) {
        stream.batch += uint32_t(batches_.size());
        stream.source = &source_;
        io.streams->push_back(stream);
    }
    batches_.insert(batches_.end(), rows.frame.batches().begin(), rows.frame.batches().end());
    render::add(rows.frame.fragments(), io.fragments);
    return {};
}

void RowView::keep()
{
    isKept_ = true;
    single_.buffers.keep(single_.frame);
    joined_.buffers.keep(joined_.frame);
}

/// Names of GL objects become resources of the graph; what the GPU computes is computed.
void RowView::addPasses(PassStage stage, FrameGraph& graph, PassFrame& frame)
{
    if (stage != PassStage::Upload)
        return;
    for (ParticleBatch& batch : batches_) {
        for (BufferPart* part : {&batch.newer, &batch.older, &batch.order, &batch.mesh})
            if (part->bytes > 0)
                part->id = graph.importBuffer({"particles", size_t(part->offset + part->bytes)}, part->name);
        batch.textureId = graph.importTexture({"particle frames", 1, 1, Format::RGBA8}, batch.texture);
        batch.motionId = graph.importTexture({"particle motion", 1, 1, Format::RGBA8}, batch.motion);
    }
    const bool hasDepth = frame.request->targets.depth != 0;
    GpuRowsPass::addTo(graph, single_.buffers.jobs(), batches_,
                       hasDepth ? GpuDepth{frame.distance, &frame.request->camera, frame.width, frame.height}
                                : GpuDepth{});
    GpuOrderPass::addTo(graph, single_.frame.gpuOrders(), batches_);
}

void RowView::fence()
{
    single_.buffers.fence();
    joined_.buffers.fence();
}

void RowView::forget()
{
    single_.buffers.forgetComputed();
}

void RowView::rest()
{
    single_.buffers.idle();
    joined_.buffers.idle();
}

void RowView::count(FrameStatistics& statistics) const
{
    for (const Rows* rows : {&single_, &joined_}) {
        const DrawnCounts& drawn = rows->frame.drawn();
        statistics.sprites += drawn.sprites;
        statistics.meshes += drawn.meshes;
        statistics.ribbonPieces += drawn.ribbonPieces;
        statistics.particles += drawn.sprites + drawn.meshes + drawn.ribbonPieces;
        statistics.particlesOrdered += rows->frame.orderedRows();
        statistics.particlesThinned += rows->frame.thinnedRows();
        statistics.sortedElements += isKept_ ? 0 : rows->frame.orderedRows();
        statistics.uploadedBytes += rows->buffers.uploadedBytes();
        statistics.keptRowBytes += rows->buffers.keptBytes();
        statistics.sharedRowBytes += rows->buffers.sharedBytes();
    }
    for (const ParticleBatch& batch : batches_)
        statistics.gpuParticles += batch.isComputed ? batch.instances : 0;
}

uint64_t RowView::bytes() const
{
    return single_.buffers.bytes() + joined_.buffers.bytes();
}

} // namespace fx::render
