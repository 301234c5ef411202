/// @file view_graph.h
/// Declares the passes of one frame of a view, their order and their resources.
#pragma once

#include "rendering/compositions/media_composition.h"
#include "rendering/frame/view_types.h"
#include "rendering/frame_graph/frame_graph.h"
#include "rendering/host_targets/host_copies.h"
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
    /// States of the techniques, in the order of the list of techniques, after gather(). `techniques`,
    /// `batches` and `solids` must stay valid until the graph has executed.
    std::span<const std::unique_ptr<TechniqueView>> techniques;
    std::span<const DrawBatch> batches;         ///< batches of media and transparent particles
    std::span<const MediaSource* const> solids; ///< sources of opaque particles
    ViewLights* lights = nullptr;               ///< lights, which must be gathered; null: no lighting
    CompositionView* composition = nullptr; ///< composition, which draws media before `batches`; null: none
    int layerDivisor = 1;            ///< divisor of layers in this frame, >= ViewSettings::layerDivisor
    OutputView* outputs = nullptr;   ///< outputs of the view; null if the settings request none
    const PastFrame* past = nullptr; ///< previous frame, used for `outputs`
    /// Facts about the targets, and their copies; begin() has been called. Null: the color texture has one
    /// sample and no sRGB format, and the frame lies at its corner.
    const HostTargetFacts* facts = nullptr;
    HostCopies* copies = nullptr;
    bool completes = true; ///< false: another view completes the picture by shimmer, glare and tone mapping
};

/// Resources that exist after the frame, besides the host's picture. Resources that were not requested are
/// invalid.
struct ViewGraphOutputs
{
    ResourceId fire, smoke, dust, media, depth, opticalDepth;
    OutputTextures outputs;
    bool anyPass = false; ///< true: there are passes; false: the host's picture does not change
};

/// Adds all necessary passes of a frame to `graph`, after FrameGraph::begin(). For example, media passes are
/// added only if there are blobs, and the shimmer pass only if there is heat.
ViewGraphOutputs buildViewGraph(FrameGraph& graph, const ViewGraphInputs& in);

} // namespace fx::render
