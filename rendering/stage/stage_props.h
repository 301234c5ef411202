/// @file stage_props.h
/// Opaque things that stand on a stage beside an effect, for example the logs of a fire.
///
/// Threads: any.
#pragma once

#include "rendering/stage/stage_renderer.h"

#include <glm/vec3.hpp>

namespace fx::render {

/// Where props stand.
struct PropPlacement
{
    glm::vec3 position{0.0f};    ///< [m] of the origin of the props, relative to StageMesh::origin
    float headingDegrees = 0.0f; ///< turns the props about +Y
    float scale = 1.0f;          ///< [m] length of a unit of the props, > 0
};

/// Puts the triangles of `props` between the figures and the rest of the mesh, and counts them in
/// StageMesh::propVertices. On level soil only figures and props cast shadows.
void addStageProps(StageMesh& io, const StageMesh& props, const PropPlacement& placement);

} // namespace fx::render
