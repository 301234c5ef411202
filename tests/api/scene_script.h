/// @file scene_script.h
/// Calls of a host on one scene. The calls are equal in every run: they create, destroy, move, hide and seek
/// instances, and save and restore states. The result must not depend on other threads.
#pragma once

#include "fxsdk/fxsdk.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace fx::test {

class SceneScript
{
public:
    /// Creates a scene that belongs to the calling thread, with its first instances.
    /// @param number selects one of several scripts
    SceneScript(FxContext* context, uint32_t number);

    FxScene* scene() const { return scene_; }
    void play(int frames);
    uint64_t stateHash() const;      ///< hash of the visible state
    uint64_t simulationHash() const; ///< hash of all data on which later steps depend

private:
    static constexpr size_t kMaxInstances = 10;

    void add(FxPresetId preset);
    void addAndUnload();
    void removeOldest();
    void change(FxInstanceId instance);
    void look() const;
    void saveAndRestore();

    FxContext* context_;
    FxScene* scene_ = nullptr;
    uint32_t number_;
    std::array<FxPresetId, 7> presets_{};
    std::vector<FxInstanceId> instances_;
    std::vector<std::byte> state_;
    uint64_t nextSeed_ = 0;
    int frame_ = 0;
};

} // namespace fx::test
