/// @file offscreen_gl.h
/// OpenGL without a window, and a picture to draw effects into: what these programs need of a game.
///
/// Threads: the thread that made the context.
#pragma once

#include <string>
#include <vector>

namespace example {

/// A current OpenGL 4.5 core context without a surface.
class OffscreenGl
{
public:
    /// Throws std::runtime_error where there is no such context.
    OffscreenGl();
    ~OffscreenGl();
    OffscreenGl(const OffscreenGl&) = delete;
    OffscreenGl& operator=(const OffscreenGl&) = delete;

private:
    void* display_; ///< EGLDisplay
    void* context_; ///< EGLContext
};

/// Finds functions of OpenGL in such a context. @param user is not used
void* findOffscreenFunction(void* user, const char* name);

/// The textures that effects are drawn into: exposed color in 32-bit floats, and depth.
class Picture
{
public:
    /// Needs a current context, which must outlive it.
    Picture(int width, int height);
    ~Picture();
    Picture(const Picture&) = delete;
    Picture& operator=(const Picture&) = delete;

    unsigned color() const { return names_[0]; } ///< GL name of an RGBA32F texture
    unsigned depth() const { return names_[1]; } ///< GL name of a DEPTH_COMPONENT32F texture

    /// Paints `rgba` everywhere, at the far plane.
    void clear(const float rgba[4]);

    /// Writes what toneMap has made of it to a PNG. Throws std::runtime_error where that is not possible.
    void writePng(const std::string& path) const;

private:
    int width_, height_; ///< [pixel]
    unsigned names_[2] = {};
};

} // namespace example
