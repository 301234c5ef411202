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

/// State of a view for its composition. It gathers after all techniques, and its passes of a stage follow
/// theirs. gather() moves the streams that it draws itself out of GatheredFrame::streams; the media pass
/// draws the others, sorted, over what compose() draws.
class CompositionView : public TechniqueView
{
public:
    /// Whether the last gather() took any stream.
    virtual bool hasMedia() const = 0;

    /// Adds passes that refine light slices, after these have been filled with balls and before any pass
    /// reads them. Called by frames and by the preparation of lights.
    /// @return bindings for the following passes
    [[nodiscard]] virtual LightBindings addLightPasses(FrameGraph&, const LightBindings& lights)
    {
        return lights;
    }

    /// Adds the passes that draw the streams taken by gather(). A frame calls it once or, with layers smaller
    /// than the picture, for each end of the depth of their texels.
    /// @param in as for the media pass; `in.batches` is empty
    /// @param under the targets to draw over; invalid members: none
    /// @return targets as those of the media pass
    [[nodiscard]] virtual MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                                     const MediaPass::Outputs& under) = 0;
};

/// One composition. Has static storage.
struct MediaComposition
{
    Composition value;        ///< of ViewSettings
    std::string_view meaning; ///< one line
    /// Whether balls of medium have to be sorted for it; false: they come as they were gathered.
    bool needsOrder = true;
    /// Creates the state of a view; null: the media pass draws everything.
    std::unique_ptr<CompositionView> (*create)(const TechniqueSetup& setup) = nullptr;
    std::span<const ProgramDesc* const> (*programs)() = nullptr; ///< all programs it may use; null: none
    std::span<const TimedPass> timedPasses = {};                 ///< passes with a timer group of their own
};

} // namespace fx::render
