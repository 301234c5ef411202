/// @file offscreen_gl.h
/// OpenGL without a window, and a picture into which effects are drawn. The example programs use both in
/// place of a game.
///
/// Threads: the thread that created the context.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace example {

/// A current OpenGL 4.5 core context without a surface.
class OffscreenGl
{
public:
    /// Creates the context. Throws std::runtime_error on failure.
    OffscreenGl();
    ~OffscreenGl();
    OffscreenGl(const OffscreenGl&) = delete;
    OffscreenGl& operator=(const OffscreenGl&) = delete;

private:
    void* display_; ///< EGLDisplay
    void* context_; ///< EGLContext
};

/// Finds a function of OpenGL. @param user not used
void* findOffscreenFunction(void* user, const char* name);

/// Writes a PNG file. Throws std::runtime_error on failure.
/// @param rgb 8 bits each, the upper row first
void writePng(const std::string& path, int width, int height, const std::vector<uint8_t>& rgb);

/// The textures that effects are drawn into: exposed color in 32-bit floats, and depth.
class Picture
{
public:
    /// Creates the textures in the current context, which must outlive the picture.
    Picture(int width, int height);
    ~Picture();
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    unsigned color() const { return names_[0]; } ///< GL name of an RGBA32F texture
    unsigned depth() const { return names_[1]; } ///< GL name of a DEPTH_COMPONENT32F texture

    /// Sets all pixels to the color `rgba` and to the depth of the far plane.
    void clear(const float rgba[4]);

    /// Writes the picture to a PNG file. A view must have drawn the picture with FxViewSettings::toneMap.
    /// Throws std::runtime_error on failure.
    void writePng(const std::string& path) const;

private:
    int width_, height_; ///< [pixel]
    unsigned names_[2] = {};
};

} // namespace example
