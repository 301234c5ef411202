/// @file draw_techniques.h
/// The explicit list of drawing techniques. Its order is the order of gathering and, within a stage, of
/// passes. A new technique is one line in this list.
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

/// Timer groups of the frame's own passes and of those of `techniques`.
PassGroups passGroups(DrawTechniques techniques);

} // namespace fx::render
