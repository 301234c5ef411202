/// @file mesh_reader.h
/// Wavefront OBJ with its MTL to triangles.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/assets/asset_resolver.h"
#include "rendering/stage/stage_renderer.h"

#include <string>

namespace fx::scene_file {

constexpr size_t kMaxTriangles = 1'000'000;

/// Reads asset `name`; materials come through the same resolver. Polygons are triangulated; colors are the
/// materials' Kd, taken as linear and clamped to [0, 1], 0.5 gray without material; missing normals are
/// replaced by those of the triangles.
/// @param outWarning names unknown statements of the file; empty without such
/// @return the resolver's error, Parse, TooLarge
base::Result<render::StageMesh> readMesh(const std::string& name, const asset::AssetResolver& resolver,
                                         std::string& outWarning);

} // namespace fx::scene_file
