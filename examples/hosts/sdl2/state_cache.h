/// @file state_cache.h
/// The state of OpenGL as an engine remembers it, so that it calls OpenGL only where something changes.
///
/// The cache is true as long as nobody else changes these states. fxView_Render() with saveState = 1 changes
/// none of them: the cache stays valid without a call. With saveState = 0 it is forgotten after
/// fxView_Render(): the next calls then set what they need, whatever OpenGL has.
/// Threads: the GL thread.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <optional>

class StateCache
{
public:
    struct Rectangle
    {
        GLint x = 0, y = 0, width = 0, height = 0;
        bool operator==(const Rectangle&) const = default;
    };

    void useProgram(GLuint program);
    void bindVertexArray(GLuint array);
    void bindFramebuffer(GLuint framebuffer);
    void bindTexture(GLuint unit, GLuint texture); ///< 2-D, units 0 to 3
    void setDepth(bool test, bool write, GLenum function);
    void setBlend(bool isOn);
    void setCull(bool isOn);
    void setViewport(const Rectangle& viewport);

    /// Forgets all: each state is set again when it is used next.
    void forget() { *this = StateCache(calls_); }

    /// Number of remembered values that differ from those of OpenGL, 0 if the cache is true.
    int countFalse() const;
    /// Number of calls of OpenGL by the functions above.
    uint64_t calls() const { return calls_; }

    StateCache() = default;

private:
    explicit StateCache(uint64_t calls) : calls_(calls) {}

    /// Remembers a value. @return whether OpenGL has to be called
    template <class T>
    bool changes(std::optional<T>& known, const T& value)
    {
        if (known == value)
            return false;
        known = value;
        ++calls_;
        return true;
    }
    void setSwitch(std::optional<bool>& known, GLenum what, bool isOn);

    static constexpr GLuint kUnits = 4;
    std::optional<GLuint> program_, vertexArray_, framebuffer_, textures_[kUnits];
    std::optional<bool> depthTest_, depthWrite_, blend_, cull_;
    std::optional<GLenum> depthFunction_;
    std::optional<Rectangle> viewport_;
    uint64_t calls_ = 0;
};
