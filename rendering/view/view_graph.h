/// @file view_graph.h
/// Declares the passes of one frame of a view: which exist, in what order, and what they hand to each other.
#pragma once

#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/gpu_particles/gpu_order_pass.h"
#include "rendering/gpu_particles/gpu_rows_pass.h"
#include "rendering/passes/blob_instance.h"
#include "rendering/passes/heat_shimmer_pass.h"
#include "rendering/passes/impostor_pass.h"
#include "rendering/passes/particle_batch.h"

#include <span>

namespace fx::render {

/// What a frame's passes are made from.
struct ViewGraphInputs
{
    const FrameRequest* request;
    const ViewSettings* settings;
    std::span<const BlobInstance> blobs; ///< must stay until the graph has executed, as must the next two
    std::span<ParticleBatch> batches; ///< their GL objects are given; what they are in the graph is filled in
    std::span<const MediaRun> runs;   ///< of blobs and of batches that do not hide
    std::span<const HotArea> hotAreas; ///< where blobs bend light; must stay as well
    bool anyDetail;
    uint32_t dazzleHistory;  ///< GL buffer of sizeof(DazzleHistory); 0 when dazzle is off
    int layerDivisor = 1;    ///< of this frame, >= that of the settings
    uint32_t blobBuffer = 0; ///< GL buffer for the blobs; 0: one of the graph's own
    bool blobsAreIn = false; ///< that buffer holds them already, and the next that of the impostors
    std::span<const ImpostorInstance> impostors = {}; ///< farthest first; must stay, as must the next three
    std::span<const BlobInstance> takenBlobs = {};    ///< of pictures that are taken in this frame
    std::span<const uint32_t> takenTiles = {};        ///< where each picture is kept
    std::span<const MediaRun> takenRuns = {};         ///< one of all blobs, when a picture is taken
    uint32_t impostorBuffer = 0;                      ///< GL buffer for the impostors
    uint32_t impostorAtlas = 0;                       ///< GL texture of the pictures
    std::span<const GpuRowsJob> gpuRows = {};         ///< what computes rows of batches
    std::span<const GpuOrderJob> gpuOrders = {};      ///< and their orders
};

/// Resources that exist after the frame besides the host's picture; invalid where they were not asked for.
struct ViewGraphOutputs
{
    ResourceId fire, smoke, dust, media, depth, opticalDepth, overdraw;
    int layerWidth = 0, layerHeight = 0; ///< [texel] of what media and overdraw were drawn to
    bool dazzled = false;                ///< the glare ran, so its history is that of this frame
    bool anyPass = false;                ///< false: the host's picture is already what it should be
};

/// Fills `graph`, which has begun. Passes that nothing calls for are not added: without blobs no media
/// passes, without heat no shimmer, and so on.
ViewGraphOutputs buildViewGraph(FrameGraph& graph, const ViewGraphInputs& in);

} // namespace fx::render
