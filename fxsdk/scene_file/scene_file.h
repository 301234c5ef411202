/// @file scene_file.h
/// Loads a scene (`*.scene.json`) for tools: camera, lights, background, mesh, instances.
///
/// This code is not part of libfxsdk. Threads: any; calls share no data.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/presets/preset_loader.h"
#include "fxsdk/scene_file/camera_path.h"
#include "fxsdk/scene_file/instance_play.h"
#include "rendering/frame/scene_light.h"
#include "rendering/frame/view_types.h"
#include "rendering/stage/stage_renderer.h"
#include "simulation/solver/solver.h"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace fx::scene_file {

/// One effect in the scene.
struct SceneInstance
{
    size_t preset = 0;                          ///< index into SceneFile::presets
    glm::dvec3 position{0.0};                   ///< [m] world
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f}; ///< unit quaternion
    float scale = 1.0f;                         ///< > 0
    double start = 0.0;                         ///< [s] scene time, >= 0
    uint64_t seed = 1;
    sim::InstanceParameters parameters;
    int32_t layer = 0;   ///< see fxScene_SetLayer()
    int32_t sortKey = 0; ///< see fxScene_SetLayer()
    InstancePlay play;   ///< changes of the effect over time

    /// Returns the placement at a scene time [s].
    base::Placement placementAt(double time) const;
};

/// A preset that instances use. Tools with the C API load the preset again from `text`.
struct ScenePreset
{
    std::string name; ///< name of the preset in the scene file
    std::string text; ///< JSON text
    std::string file; ///< path of the preset; empty: the preset is in the library
    std::shared_ptr<const sim::EffectDef> effect;
};

struct SceneFile
{
    std::string name;
    CameraPath camera;
    std::vector<render::SceneLight> lights; ///< lights other than sun and sky
    render::ViewSettings view;              ///< exposure, lighting, shimmer, dazzle, form, tone map, detail
    render::StageBackground background;
    render::StageMesh mesh; ///< mesh of the stage; empty: the scene has no mesh
    /// Path of the mesh; empty: the mesh is in the library, or the scene has no mesh.
    std::string meshFile;
    bool meshCollides = false; ///< true: effects collide with the mesh
    /// [m] cell size of the collision grid; 0: the smallest size that gives at most four million cells.
    float meshCellSize = 0.0f;
    std::vector<ScenePreset> presets;
    std::vector<SceneInstance> instances;
    std::vector<preset::Diagnostic> warnings;
};

/// Returns the drawing hints of the scene: for each member, the greatest value among the presets of the
/// instances.
sim::DrawingHints preferredHints(const SceneFile& scene);

/// [byte] Largest sizes of a scene, of a mesh and of an image.
constexpr uint64_t kSceneBytes = uint64_t(64) << 20;
constexpr uint64_t kMeshBytes = uint64_t(64) << 20;
constexpr uint64_t kImageBytes = uint64_t(256) << 20;

/// Parses, validates and loads a scene.
/// @param resolver finds the mesh, the image and the presets that the scene names
/// @param outDiagnostics receives all findings, including warnings, on success and on failure; may be null
/// @return Parse, TooLarge, Version, Schema, or the error of an asset
base::Result<SceneFile> loadSceneText(std::string_view text, const std::string& displayName,
                                      const asset::AssetResolver& resolver,
                                      std::vector<preset::Diagnostic>* outDiagnostics = nullptr);

/// Loads a scene from a file; assets are searched in the folder of the file.
base::Result<SceneFile> loadSceneFile(const std::string& path,
                                      std::vector<preset::Diagnostic>* outDiagnostics = nullptr);

} // namespace fx::scene_file
