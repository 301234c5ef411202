/// @file draw_techniques.h
/// The explicit list of what views can draw. A technique joins by a line here; where it is in the list is the
/// order in which it gathers and, within a stage of passes, the order of its passes.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

using DrawTechniques = std::span<const DrawTechnique* const>;

DrawTechniques drawTechniques();

/// effectLights() of the sources of `techniques`.
size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out,
                    DrawTechniques techniques = drawTechniques());

/// EffectContent::isDrawn of an effect that publishes `kinds`.
bool isDrawn(std::span<const base::KindDesc* const> kinds, DrawTechniques techniques = drawTechniques());
/// Whether a frame with an effect of this content has passes of `technique`.
bool isUsed(const DrawTechnique& technique, const EffectContent& content);

/// What the times of passes are added to: those of the frame's own passes and of `techniques`.
PassGroups passGroups(DrawTechniques techniques);

} // namespace fx::render
