/// @file output_marks.h
/// Marks store the instance and the velocity of drawn elements, for the outputs of a view (view_output).
#pragma once

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>

namespace fx::render {

/// Velocity and instance of a blob, in the layout of shaders/shared/output_marks.glsl.
struct BlobMark
{
    glm::vec4 velocity;  ///< xyz velocity in the world [m/s]
    glm::uvec4 instance; ///< xy id of the instance, low word first
};
static_assert(sizeof(BlobMark) == 32 && offsetof(BlobMark, instance) == 16);

/// [byte] Size of the mark of a card's fragment. shaders/shared/output_marks.glsl defines its layout.
constexpr size_t kCardMarkBytes = 32;

inline glm::uvec4 instanceWords(uint64_t id)
{
    return {uint32_t(id), uint32_t(id >> 32), 0u, 0u};
}

} // namespace fx::render
