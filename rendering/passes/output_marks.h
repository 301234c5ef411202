/// @file output_marks.h
/// Whose what is shown is, and how it moves: what the outputs of a view need besides light.
#pragma once

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Velocity and instance of a blob, in the layout of shaders/shared/output_marks.glsl.
struct BlobMark
{
    glm::vec4 velocity;  ///< xyz [m/s] relative to the world
    glm::uvec4 instance; ///< xy its id, low word first
};
static_assert(sizeof(BlobMark) == 32 && offsetof(BlobMark, instance) == 16);

/// [byte] Size of the mark of a fragment of a card, which is written on the GPU, in the layout of the same
/// file.
constexpr size_t kCardMarkBytes = 32;

inline glm::uvec4 instanceWords(uint64_t id)
{
    return {uint32_t(id), uint32_t(id >> 32), 0u, 0u};
}

} // namespace fx::render
