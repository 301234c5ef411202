/// @file reference_scene.h
/// Input of a picture of the reference renderer or the path tracer, and hashes that identify the picture.
#pragma once

#include "foundation/math/hash.h"
#include "foundation/result/status.h"
#include "foundation/tasks/task_runner.h"
#include "rendering/reference/render/medium_blobs.h"
#include "rendering/reference/render/opaque_view.h"
#include "rendering/reference/render/reference_camera.h"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace fx::render {

/// The complete input of a picture, except its settings. Spans in `opaque` must stay valid.
struct ReferenceScene
{
    std::vector<MediumBlob> blobs;
    MediumDetails details; ///< detail of `blobs`; empty: blobs are smooth
    OpaqueScene opaque;
    ReferenceCamera camera;
};

/// Hashes the inputs of the picture number by number, because structs have padding. Words are distributed
/// over four chains that run in parallel. Within a chain, each word waits for the previous word.
class KeyHash
{
public:
    /// Version of the arithmetic. It is increased when equal inputs give a different picture.
    static constexpr uint64_t kVersion = 4;

    void add(double x) { addWord(std::bit_cast<uint64_t>(x)); }
    void add(const glm::dvec3& v)
    {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void addWord(uint64_t word)
    {
        uint64_t& chain = chains_[next_++ % chains_.size()];
        chain = base::hashWord(chain, word);
    }
    template <class T>
    void addBytes(std::span<const T> values)
    {
        addWord(base::hashBytes(kVersion, values.data(), values.size_bytes()));
    }
    uint64_t value() const { return base::hashBytes(next_, chains_.data(), sizeof(chains_)); }

private:
    std::array<uint64_t, 4> chains_{kVersion, kVersion, kVersion, kVersion};
    size_t next_ = 0;
};

/// Hashes the scene. The result has the same bits for any number of threads.
void addScene(KeyHash& io, const ReferenceScene& scene, base::TaskRunner& tasks);

/// Checks the scene and the size of the picture.
/// @return InvalidArgument if the size is outside of 1..16384, or if a blob, a light or the camera has
///         impossible values
base::Status checkScene(const ReferenceScene& scene, int width, int height);

/// A copy of the camera whose axes have exactly the lengths that the formulas of the renderers assume.
/// @param camera camera that checkScene() accepts
ReferenceCamera withUnitAxes(const ReferenceCamera& camera);

} // namespace fx::render
