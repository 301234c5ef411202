/// @file picture_window.h
/// A part of a picture that is drawn alone, for pictures that would take too long as a whole.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

namespace fx::cli {

/// Pixels of a picture; y counts upwards.
struct PictureWindow
{
    int x = 0, y = 0, width = 0, height = 0;
    int pictureWidth = 0, pictureHeight = 0; ///< [pixel] of the whole picture

    /// Maps clip coordinates of the whole picture to those of the part.
    glm::mat4 clip() const
    {
        const glm::vec2 picture(pictureWidth, pictureHeight), part(width, height);
        const glm::vec2 scale = picture / part;
        const glm::vec2 offset = (picture - 2.0f * glm::vec2(x, y)) / part - 1.0f;
        glm::mat4 matrix(1.0f);
        matrix[0][0] = scale.x;
        matrix[1][1] = scale.y;
        matrix[3] = {offset.x, offset.y, 0.0f, 1.0f};
        return matrix;
    }
    float aspect() const { return float(pictureWidth) / float(pictureHeight); } ///< of the whole picture
};

} // namespace fx::cli
