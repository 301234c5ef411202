/// @file instance_director.h
/// Does to running instances what their scene file says, as a host would, step by step.
///
/// What a step sees depends on nothing but its number: the same for every way to a moment.
/// Threads: the scene thread.
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
    /// Instances without a play are left alone.
    void add(const scene_file::SceneInstance& instance, FxInstanceId id);

    /// To be called before each step of the scene. What has a time happens with the step whose beginning is
    /// nearest to it; to an instance that has not started then, with its second step. At the end of the step
    /// the instance is where its keys have it then.
    /// @param from, to when the step begins and ends
    base::Status beforeStep(FxScene* scene, base::Ticks from, base::Ticks to);

private:
    /// One instance, and how much of its play has happened.
    struct Role
    {
        scene_file::SceneInstance instance;
        FxInstanceId id;
        size_t speeds = 0;
        size_t switches = 0;
        size_t triggers = 0;
        size_t jumps = 0;
        base::Placement place; ///< last one set in the scene
    };

    static base::Status play(FxScene* scene, Role& role, base::Ticks due, base::Ticks to);
    static base::Status change(FxScene* scene, Role& role, base::Ticks due, bool hasStarted);
    static base::Status jump(FxScene* scene, Role& role, base::Ticks due);
    static base::Status move(FxScene* scene, Role& role, base::Ticks to);
    static base::Status tell(FxScene* scene, Role& role, base::Ticks due);

    std::vector<Role> roles_;
};

} // namespace fx::cli
