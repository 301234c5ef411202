/// @file media_composition.h
/// Interface of a composition: the way in which overlapping media are combined.
///
/// A composition is registered by a value of Composition in view_types.h with its name in
/// composition_names.h, a constant in fx_view.h, and a line in the list of media_compositions.cpp. Threads:
/// [GL thread].
#pragma once

#include "rendering/passes/media_pass.h"
#include "rendering/techniques/draw_technique.h"

#include <memory>
#include <span>
#include <string_view>

namespace fx::render {

/// State of a view for its composition. Its gather() is called after that of all techniques, and in each
/// stage its passes follow those of the techniques. gather() removes the streams that the composition draws
/// from GatheredFrame::streams. The media pass draws the remaining streams, sorted, over the result of
/// compose().
class CompositionView : public TechniqueView
{
public:
    /// Whether the last gather() removed a stream.
    virtual bool hasMedia() const = 0;

    /// Adds passes that refine light slices. They run after the slices have been filled with balls and before
    /// any pass reads them. Called for each frame, and for ViewRenderer::prepareLights().
    /// @return bindings for the following passes
    [[nodiscard]] virtual LightBindings addLightPasses(FrameGraph&, const LightBindings& lights)
    {
        return lights;
    }

    /// Adds the passes that draw the streams removed by gather(). It is called once per frame; or twice, if
    /// layers are smaller than the picture: for the near and for the far end of the depth range of each
    /// texel.
    /// @param in as for the media pass; `in.batches` is empty
    /// @param under targets that are drawn over; if a member is invalid, a new target is created
    /// @return the targets, as MediaPass returns them
    [[nodiscard]] virtual MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                                     const MediaPass::Outputs& under) = 0;
};

/// Description of one composition. Objects of this type have static storage.
struct MediaComposition
{
    Composition value;        ///< the value in ViewSettings
    std::string_view meaning; ///< description in one line
    /// True: the composition needs balls of medium sorted by distance. False: balls have the order in which
    /// they are gathered.
    bool needsOrder = true;
    /// Creates the composition's state in a view; null: it has no state, and the media pass draws everything.
    std::unique_ptr<CompositionView> (*create)(const TechniqueSetup& setup) = nullptr;
    /// Returns all programs that the composition may use; null: none.
    std::span<const ProgramDesc* const> (*programs)() = nullptr;
    std::span<const TimedPass> timedPasses = {}; ///< passes that have a timer group of their own
};

} // namespace fx::render
