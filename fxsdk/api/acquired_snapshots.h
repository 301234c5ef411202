/// @file acquired_snapshots.h
/// The last two steps of a scene, held until destruction. [any thread]
#pragma once

#include "fxsdk/scene/scene.h"

namespace fx::api {

class AcquiredSnapshots
{
public:
    explicit AcquiredSnapshots(scene::Scene& scene) : scene_(scene), shown_(scene.acquire()) {}
    ~AcquiredSnapshots() { scene_.release(shown_.snapshots); }
    AcquiredSnapshots(const AcquiredSnapshots&) = delete;
    AcquiredSnapshots& operator=(const AcquiredSnapshots&) = delete;
    /// The newer step; null before the first one.
    const base::FrameSnapshot* newer() const { return shown_.snapshots.newer; }

private:
    scene::Scene& scene_;
    scene::Presentation shown_;
};

} // namespace fx::api
