/// @file mesh_reader.h
/// Converts Wavefront OBJ files with MTL materials to triangles.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/assets/asset_resolver.h"
#include "rendering/stage/stage_renderer.h"

#include <string>

namespace fx::scene_file {

constexpr size_t kMaxTriangles = 1'000'000;

/// Reads the asset `name`; `resolver` also finds its materials. Polygons are triangulated. Colors are the Kd
/// of the materials, in linear space, clamped to [0, 1]. Without a material, the color is 0.5 gray. Missing
/// normals are replaced by the normals of the triangles. Materials with "illum 7" are water
/// (StageMesh::waterVertices).
/// @param outWarning lists unknown statements of the file; empty if all statements are known
/// @return the resolver's error, Parse, TooLarge
base::Result<render::StageMesh> readMesh(const std::string& name, const asset::AssetResolver& resolver,
                                         std::string& outWarning);

} // namespace fx::scene_file
