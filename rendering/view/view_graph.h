/// @file view_graph.h
/// Declares the passes of one frame of a view, their order and their resources.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/lights/slices/view_lights.h"
#include "rendering/outputs/output_view.h"
#include "rendering/techniques/draw_technique.h"

#include <memory>
#include <span>

namespace fx::render {

/// Inputs of the passes of a frame.
struct ViewGraphInputs
{
    const FrameRequest* request;
    const ViewSettings* settings;
    /// Techniques in the order of their list, after gather(). This span and the next two must stay valid
    /// until the graph has executed.
    std::span<const std::unique_ptr<TechniqueView>> techniques;
    std::span<const DrawBatch> batches;         ///< of media and transparent particles
    std::span<const MediaSource* const> solids; ///< of opaque particles
    ViewLights* lights = nullptr;               ///< gathered; null: nothing is lit
    CompositionView* composition = nullptr;     ///< draws media before `batches`; null: none
    int layerDivisor = 1;                       ///< of this frame, >= that of the settings
    OutputView* outputs = nullptr;              ///< null: the settings ask for none
    const PastFrame* past = nullptr;            ///< of `outputs`
};

/// Resources that exist after the frame besides the host's picture; invalid if they were not requested.
struct ViewGraphOutputs
{
    ResourceId fire, smoke, dust, media, depth, opticalDepth;
    OutputTextures outputs;
    bool anyPass = false; ///< false: the host's picture does not change
};

/// Fills `graph`, which has begun. Passes that nothing calls for are not added: without blobs no media
/// passes, without heat no shimmer, and so on.
ViewGraphOutputs buildViewGraph(FrameGraph& graph, const ViewGraphInputs& in);

} // namespace fx::render
