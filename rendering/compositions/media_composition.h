/// @file media_composition.h
/// How media that overlap are put together: the interface of a composition, as techniques have one.
///
/// A composition joins by a value of Composition in view_types.h with its name in composition_names.h, a
/// constant in fx_view.h, and a line in the list of media_compositions.cpp. All else iterates over these.
/// Threads: [GL thread].
#pragma once

#include "rendering/passes/media_pass.h"
#include "rendering/techniques/draw_technique.h"

#include <memory>
#include <span>
#include <string_view>

namespace fx::render {

/// What a view keeps for its composition. It is one more part of the view behind its techniques: it gathers
/// after all of them, and its passes of a stage come behind theirs. gather() moves the streams that it draws
/// itself out of GatheredFrame::streams; the media pass draws the others, sorted, over what compose() draws.
class CompositionView : public TechniqueView
{
public:
    /// Whether the last gather() took any stream.
    virtual bool hasMedia() const = 0;

    /// Adds to light slices, right after they have been filled with balls, what the composition makes of
    /// media besides. A frame calls it before all other passes that read them, and so does what prepares its
    /// lights.
    /// @return bindings for what follows
    [[nodiscard]] virtual LightBindings addLightPasses(FrameGraph&, const LightBindings& lights)
    {
        return lights;
    }

    /// Adds the passes that draw what gather() took. A frame calls it once or, with layers smaller than the
    /// picture, for each end of the depth of their texels.
    /// @param in what the media pass would get; `in.batches` is empty
    /// @param under what is drawn over; invalid members: nothing
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
    /// Makes what a view keeps; null: the media pass draws everything.
    std::unique_ptr<CompositionView> (*create)(const TechniqueSetup& setup) = nullptr;
    std::span<const ProgramDesc* const> (*programs)() = nullptr; ///< all that it can need; null: none
    std::span<const TimedPass> timedPasses = {}; ///< those that are not measured with everything else
};

} // namespace fx::render
