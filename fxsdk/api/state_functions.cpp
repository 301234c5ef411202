// The functions of fx_scene.h that hash, save and restore.
#include "fxsdk/api/scene_object.h"
#include "fxsdk/scene/state_envelope.h"

#include <cstring>
#include <string>

namespace {

using fx::base::Code;
using fx::base::Status;

} // namespace

FxResult fxScene_GetStateHash(FxScene* scene, uint64_t* outHash)
{
    return fx::api::insideScene("fxScene_GetStateHash", scene, [&]() -> Status {
        if (!outHash)
            return fx::api::invalid("outHash is null");
        *outHash = scene->scene.stateHash();
        return {};
    });
}

FxResult fxScene_GetSimulationHash(FxScene* scene, uint64_t* outHash)
{
    return fx::api::insideScene("fxScene_GetSimulationHash", scene, [&]() -> Status {
        if (!outHash)
            return fx::api::invalid("outHash is null");
        *outHash = scene->scene.simulationHash();
        return {};
    });
}

FxResult fxScene_SaveState(FxScene* scene, void* buffer, size_t capacity, size_t* outSize)
{
    return fx::api::insideScene("fxScene_SaveState", scene, [&]() -> Status {
        if (!outSize)
            return fx::api::invalid("outSize is null");
        fx::sim::StateBuffer state(&scene->context->memory);
        scene->scene.save(state);
        const std::span<const std::byte> bytes = state.bytes();
        const size_t size = fx::scene::kStateHeaderBytes + bytes.size();
        if (buffer && capacity < size)
            return {Code::Capacity, "the state takes " + std::to_string(size) + " bytes, the buffer has " +
                                        std::to_string(capacity)};
        if (buffer) {
            auto* out = static_cast<std::byte*>(buffer);
            fx::scene::writeStateHeader(bytes, FX_VERSION, out);
            std::memcpy(out + fx::scene::kStateHeaderBytes, bytes.data(), bytes.size());
        }
        *outSize = size;
        return {};
    });
}

FxResult fxScene_RestoreState(FxScene* scene, const void* state, size_t size)
{
    return fx::api::insideScene("fxScene_RestoreState", scene, [&]() -> Status {
        if (!state)
            return fx::api::invalid("state is null");
        const auto inside = fx::scene::openState({static_cast<const std::byte*>(state), size}, FX_VERSION);
        if (!inside)
            return inside.status();
        return scene->scene.restore(
            *inside, [&](uint64_t fingerprint) { return scene->context->findPreset(fingerprint); });
    });
}
