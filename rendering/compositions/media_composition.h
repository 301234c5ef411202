/// @file media_composition.h
/// Interface of a composition. A composition defines how overlapping media are combined.
///
/// To register a composition, add a value of Composition in view_types.h, a name in composition_names.h, a
/// constant in fx_view.h, and a line in the list of media_compositions.cpp. Threads: [GL thread].
#pragma once

#include "rendering/passes/media_pass.h"
#include "rendering/techniques/draw_technique.h"

#include <memory>
#include <span>
#include <string_view>

namespace fx::render {

/// State of a view for its composition. The gather() of the composition is called after the gather() of all
/// techniques. In each stage, the passes of the composition follow the passes of the techniques. gather()
/// removes the streams that the composition draws from GatheredFrame::streams. The media pass draws the
/// remaining streams, sorted, over the result of compose().
class CompositionView : public TechniqueView
{
public:
    /// True if the last gather() removed a stream.
    virtual bool hasMedia() const = 0;

    /// Adds passes that refine light slices. The passes run after the extinction of balls has been added to
    /// the slices, and before any pass reads the slices. The function is called for each frame and for
    /// ViewRenderer::prepareLights().
    /// @return bindings for the following passes
    [[nodiscard]] virtual LightBindings addLightPasses(FrameGraph&, const LightBindings& lights)
    {
        return lights;
    }

    /// Adds the passes that draw the streams removed by gather(). The function is called once per frame. If
    /// layers are smaller than the picture, it is called twice: for the near and for the far end of the
    /// depth range of each texel.
    /// @param in inputs of the media pass; `in.batches` is empty
    /// @param under targets that are drawn over; if a member is invalid, a new target is created
    /// @return the targets of MediaPass
    [[nodiscard]] virtual MediaPass::Outputs compose(FrameGraph& graph, const MediaPass::Inputs& in,
                                                     const MediaPass::Outputs& under) = 0;
};

/// Description of one composition. Objects of this type have static storage.
struct MediaComposition
{
    Composition value;        ///< value of the composition in ViewSettings
    std::string_view meaning; ///< description in one line
    /// True: the composition needs balls of medium sorted by distance. False: balls are not sorted.
    bool needsOrder = true;
    /// True: the composition draws the tiles of balls, see BallList::tiles. False: techniques must give none.
    bool drawsTiles = false;
    /// True: the picture depends on which balls have been culled, because grids are fitted to the others.
    bool fitsToVisible = false;
    /// Creates the composition's state in a view. Null: the composition has no state, and the media pass
    /// draws all streams.
    std::unique_ptr<CompositionView> (*create)(const TechniqueSetup& setup) = nullptr;
    /// Returns all programs that the composition may use; null: none.
    std::span<const ProgramDesc* const> (*programs)() = nullptr;
    std::span<const TimedPass> timedPasses = {}; ///< passes whose GPU time is measured separately
};

} // namespace fx::render
