/// @file scale_figure.h
/// A person of 1.8 m made of tapered capsules, beside which the size of an effect is read.
///
/// Threads: any.
#pragma once

#include "rendering/stage/stage_renderer.h"

#include <glm/vec3.hpp>

namespace fx::render {

constexpr float kFigureHeight = 1.8f; ///< [m] from the soles to the crown

/// Where the figure stands.
struct ScaleFigure
{
    glm::vec3 position{0.0f};    ///< [m] the point between its feet, relative to StageMesh::origin
    float headingDegrees = 0.0f; ///< direction of its face, about +Y; 0: along +Z
};

/// Puts the triangles of a figure in front of those of the mesh, and counts them in
/// StageMesh::figureVertices. On level soil only the figure casts a shadow.
void addScaleFigure(StageMesh& io, const ScaleFigure& figure);

/// Removes all figures.
void removeScaleFigures(StageMesh& io);

} // namespace fx::render
