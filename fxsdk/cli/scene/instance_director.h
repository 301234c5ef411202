/// @file instance_director.h
/// Moves, triggers and changes instances before each step, as the scene file describes.
///
/// The state after a step depends only on the number of the step, not on the frames or seeks before. Threads:
/// the scene thread.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/fxsdk.h"
#include "fxsdk/scene_file/scene_file.h"

#include <vector>

namespace fx::cli {

class InstanceDirector
{
public:
    /// Adds an instance. An instance is not changed if its SceneInstance::play contains no changes.
    void add(const scene_file::SceneInstance& instance, FxInstanceId id);

    /// Plays the events of the next step and moves the instances. The function must be called before each
    /// step of the scene. An event takes place in the step whose beginning is nearest to its time. If the
    /// instance has not started by then, the event takes place in the second step of the instance. At the end
    /// of the step, the instance has the placement that its keys give for that time.
    /// @param from, to begin and end of the step
    base::Status beforeStep(FxScene* scene, base::Ticks from, base::Ticks to);

private:
    /// One instance, and the numbers of its events that have been played so far.
    struct Role
    {
        scene_file::SceneInstance instance;
        FxInstanceId id;
        size_t speeds = 0;
        size_t switches = 0;
        size_t triggers = 0;
        size_t jumps = 0;
        base::Placement place; ///< placement that was last set in the scene
    };

    static base::Status play(FxScene* scene, Role& role, base::Ticks due, base::Ticks to);
    static base::Status change(FxScene* scene, Role& role, base::Ticks due, bool hasStarted);
    static base::Status jump(FxScene* scene, Role& role, base::Ticks due);
    static base::Status move(FxScene* scene, Role& role, base::Ticks to);
    static base::Status tell(FxScene* scene, Role& role, base::Ticks due);

    std::vector<Role> roles_;
};

} // namespace fx::cli
