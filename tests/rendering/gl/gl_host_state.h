/// @file gl_host_state.h
/// A host with unusual OpenGL state, and a probe that reads all state. Both use GL functions that the host
/// loads, and do not use the function table of the library.
#pragma once

#include "rendering/gl/gl_functions.h"

#include <map>
#include <string>
#include <vector>

namespace fx::render {

/// State values by name, such as "GL_BLEND[2]".
using GlProbe = std::map<std::string, std::vector<double>>;

/// Names and values of the states that differ, one line for each.
std::vector<std::string> differences(const GlProbe& before, const GlProbe& after);

/// Objects and calls of a host that shares its context with the library.
class GlHost
{
public:
    explicit GlHost(const GlLoader& loader) : loader_(loader) {}

    /// Sets all state that the probe reads to unusual values: not the default of GL, and not the value that
    /// drawing requires.
    void makeHostile();
    /// Reads all state.
    GlProbe probe();
    /// Deletes all objects of makeHostile(), so that the context can be destroyed.
    void release();

private:
    template <class Function>
    Function load(const char* name) const
    {
        return reinterpret_cast<Function>(loader_.getProcAddress(loader_.user, name));
    }
    void setRaster();
    void setFragments();
    void makeObjects();
    void bindTextures();
    void bindBuffers();

    GlLoader loader_;
    GLuint textures_[7] = {}; ///< textures of the kinds 2-D, 2-D, cube, array, 2-D RGBA32F, 2-D R32F and 3-D
    GLuint samplers_[2] = {};
    GLuint buffers_[3] = {};
    GLuint framebuffers_[2] = {};
    GLuint vertexArray_ = 0;
    GLuint program_ = 0;
    GLuint pipeline_ = 0;
    GLuint renderbuffer_ = 0;
};

} // namespace fx::render
