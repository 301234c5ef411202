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

/// State of a view for its composition. The composition gathers after all techniques, and in each stage its
/// passes follow those of the techniques. gather() removes the streams that the composition draws from
/// GatheredFrame::streams. The media pass draws the remaining streams, sorted, over the result of compose().
class CompositionView : public TechniqueView
{
public:
    /// Whether the last gather() took a stream.
    virtual bool hasMedia() const = 0;

    /// Adds passes that refine light slices. They run after the slices have been filled with balls and before
    /// any pass reads them. Called for frames and for the preparation of lights.
    /// @return bindings for the following passes
    [[nodiscard]] virtual LightBindings addLightPasses(FrameGraph&, const LightBindings& lights)
    {
        return lights;
    }

    /// Adds the passes that draw the streams taken by gather(). A frame calls it once. With layers smaller
    /// than the picture, it calls it twice: for the near and the far end of the depth in each texel.
    /// @param in as for the media pass; `in.batches` is empty
    /// @param under the targets to draw over; invalid members: nothing is drawn over
    /// @return the targets, as MediaPass returns them
    [[nodiscard]] virtual MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                                     const MediaPass::Outputs& under) = 0;
};

/// One composition. Has static storage.
struct MediaComposition
{
    Composition value;        ///< the value in ViewSettings
    std::string_view meaning; ///< description in one line
    /// Whether the composition needs sorted balls of medium; false: they have the order of gathering.
    bool needsOrder = true;
    /// Creates the state of a view; null: the media pass draws everything.
    std::unique_ptr<CompositionView> (*create)(const TechniqueSetup& setup) = nullptr;
    std::span<const ProgramDesc* const> (*programs)() = nullptr; ///< all programs that it may use; null: none
    std::span<const TimedPass> timedPasses = {};                 ///< passes with a timer group of their own
};

} // namespace fx::render
