/// @file draw_techniques.h
/// The list of drawing techniques. The techniques gather data in the order of the list. Within a stage, they
/// add passes in the same order. A new technique is declared here and added to the list in
/// draw_techniques.cpp.
#pragma once

#include "rendering/techniques/draw_technique.h"

namespace fx::render {

/// Spherical billboards: fire, smoke and dust as balls of medium, with impostors for distant effects.
extern const DrawTechnique kBlobTechnique;

/// Noise coordinates of balls, which make detail move with the balls. The state of kBlobTechnique draws with
/// these coordinates.
extern const DrawTechnique kFieldDetailTechnique;

/// Voxels of volumes, which replace balls. The state of kBlobTechnique draws them.
extern const DrawTechnique kVolumeTechnique;

/// Hierarchies of blocks of medium: their counts. The state of kBlobTechnique draws the balls that they
/// expand to.
extern const DrawTechnique kBlockTechnique;

/// Content of block types, which is drawn as a part of kBlockTechnique.
extern const DrawTechnique kBlockBallTechnique;
extern const DrawTechnique kBlockMaterialTechnique;

/// Shadows of media: timer group and scalability levels of light slices. The passes of light slices are in
/// rendering/lights/slices and belong to every view.
extern const DrawTechnique kLightSliceTechnique;

/// Particles that are drawn as sprites or meshes.
extern const DrawTechnique kSpriteTechnique;

/// Trails of particles.
extern const DrawTechnique kRibbonTechnique;

/// Particles that are simulated on the GPU.
extern const DrawTechnique kGpuParticleTechnique;

/// Lights of particles, from snapshot data of the kind "light". The lights themselves are not drawn.
extern const DrawTechnique kParticleLightTechnique;

/// Heat shimmer: refraction in hot gas.
extern const DrawTechnique kShimmerTechnique;

/// Dazzle: glare of light above the saturation of a sensor.
extern const DrawTechnique kDazzleTechnique;

using DrawTechniques = std::span<const DrawTechnique* const>;

DrawTechniques drawTechniques();

/// Calls effectLights() of rendering/lights/effect_lights.h with the light sources of `techniques`.
size_t effectLights(const base::FrameSnapshot& snapshot, std::span<EffectLight> out,
                    DrawTechniques techniques = drawTechniques());

/// True if a technique of `techniques` draws a kind of `kinds`. The result is EffectContent::isDrawn of an
/// effect that publishes these kinds.
bool isDrawn(std::span<const base::KindDesc* const> kinds, DrawTechniques techniques = drawTechniques());
/// True if a frame with an effect of this content has passes of `technique`.
bool isUsed(const DrawTechnique& technique, const EffectContent& content);

/// Timer groups of the passes of `techniques`, and of the frame's own passes.
PassGroups passGroups(DrawTechniques techniques);

} // namespace fx::render
