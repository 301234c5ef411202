/// @file effect_scene.h
/// Runs the effects of a scene file through the C API, as a host does.
///
/// Threads: only the thread that created the object.
#pragma once

#include "foundation/assets/asset_table.h"
#include "foundation/assets/volume_sequence.h"
#include "foundation/result/status.h"
#include "foundation/snapshot/snapshot_ring.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/scene/compute_override.h"
#include "fxsdk/cli/scene/instance_director.h"
#include "fxsdk/fxsdk.h"
#include "fxsdk/scene_file/scene_file.h"

#include <glm/vec4.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fx::cli {

struct EffectSceneOptions
{
    FxGlLoader gl{nullptr, nullptr}; ///< none: simulation only
    int stepsPerSecond = 60;
    uint32_t quality = FX_QUALITY_DEFAULT; ///< FxQuality of the simulation
    std::optional<uint64_t> seed;          ///< seed of instance k is seed + k; empty: the seeds of the file
    /// value "cpu", "gpu" or "auto" for all emitters; empty: as each emitter specifies
    std::string compute = {};
};

/// A moment of the scene as a view shows it: a time between two steps.
struct SceneMoment
{
    base::SnapshotPair snapshots; ///< snapshots of both steps; the older one is null before the second step
    double interpolation = 0;     ///< [1] position between the steps: 0 is the older, 1 the newer
};

class EffectScene
{
public:
    static base::Result<std::unique_ptr<EffectScene>> create(const scene_file::SceneFile& file,
                                                             const EffectSceneOptions& options);
    ~EffectScene();
    EffectScene(const EffectScene&) = delete;
    EffectScene& operator=(const EffectScene&) = delete;

    /// Takes steps until a view shows exactly the time `tick`. `tick` must not decrease from call to call. A
    /// view interpolates between the last two steps, so the clock is one step ahead of the picture.
    /// @return Interrupted when the user asked to stop
    base::Status showMoment(base::Ticks tick);

    /// Copies the last step into a snapshot for renderers. The snapshot is valid until the next call.
    base::Result<const base::FrameSnapshot*> snapshot();

    /// Copies the last two steps, between which a view interpolates. The copy is valid until the next call
    /// of this function or of snapshot().
    base::Result<SceneMoment> moment();

    /// Center and radius [m] of every sprite and mesh of the last step, in the world.
    base::Result<std::vector<glm::vec4>> places();

    /// Number of an instance in the scene file, from 1. @param instance FxInstanceId::bits @return 0 if
    /// unknown
    uint32_t numberOf(uint64_t instance) const;

    base::Result<FxSceneStatistics> statistics() const;
    FxContext* context() const { return context_; }
    const base::AssetTable& assets() const; ///< of the context, to which snapshots refer
    /// Waits until the frames of all sequences that the present moment shows are in memory, so that pictures
    /// do not depend on the disk. @return an error that names the file
    base::Status waitForFrames();
    base::VolumeSequence::Counts volumeCounts() const; ///< of all sequences together
    FxScene* scene() const { return scene_; }

    /// Length of a step.
    base::Ticks step() const { return step_; }

private:
    EffectScene();
    base::Status start(const scene_file::SceneFile& file, const EffectSceneOptions& options);
    base::Status addCollisionMesh(const scene_file::SceneFile& file);
    base::Status addInstances(const scene_file::SceneFile& file, const EffectSceneOptions& options);

    ComputeOverride compute_{""};
    FxContext* context_ = nullptr;
    FxScene* scene_ = nullptr;
    InstanceDirector director_;
    std::vector<uint64_t> instances_; ///< FxInstanceId::bits of the instances, in the order of the file
    bool hasSequences_ = false;       ///< whether presets have volumes that are played
    base::Ticks step_ = 0;
    base::Ticks now_ = 0;
    base::SnapshotSchema schema_;
    std::unique_ptr<base::FrameSnapshot> copy_;  ///< copy of the last step
    std::unique_ptr<base::FrameSnapshot> older_; ///< copy of the step before the last
};

} // namespace fx::cli
