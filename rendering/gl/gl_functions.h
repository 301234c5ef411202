/// @file gl_functions.h
/// The OpenGL functions of one context, loaded through the host and counted. Nothing here links an OpenGL
/// library.
///
/// Members carry the functions' names without "gl": gl.DrawArraysInstanced(...). A hook sees every call and
/// can swallow it, which is how tests inject faults.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <cstdint>
#include <functional>

namespace fx::render {

/// The host's loader of OpenGL functions ("glDrawArrays") of the current context; returns null when a
/// function does not exist.
struct GlLoader
{
    void* user = nullptr;
    void* (*getProcAddress)(void* user, const char* name) = nullptr;
};

/// State shared by all functions of one table.
struct GlCallMonitor
{
    uint64_t calls = 0;
    /// Given the name with "gl"; false swallows the call, whose result is then zero. Empty in production.
    std::function<bool(const char* name)> hook;
};

/// One function of the table.
template <class Pointer>
class GlFunction;

template <class R, class... A>
class GlFunction<R(APIENTRY*)(A...)>
{
public:
    R operator()(A... arguments) const
    {
        ++monitor_->calls;
        if (monitor_->hook && !monitor_->hook(name_)) [[unlikely]]
            return R();
        return pointer_(arguments...);
    }

    /// @return false when the loader does not find the function
    bool load(const GlLoader& loader, const char* name, GlCallMonitor& monitor)
    {
        name_ = name;
        monitor_ = &monitor;
        pointer_ = reinterpret_cast<R(APIENTRY*)(A...)>(loader.getProcAddress(loader.user, name));
        return pointer_ != nullptr;
    }

    bool isLoaded() const { return pointer_ != nullptr; }

private:
    R(APIENTRY* pointer_)(A...) = nullptr;
    const char* name_ = nullptr;
    GlCallMonitor* monitor_ = nullptr;
};

/// The table. Neither copied nor moved: its members point at its monitor.
struct GlFunctions
{
    GlFunctions() = default;
    GlFunctions(const GlFunctions&) = delete;
    GlFunctions& operator=(const GlFunctions&) = delete;

    /// @return GlUnsupported naming every function that is missing; then the table must not be used
    base::Status load(const GlLoader& loader);

#define FX_GL(type, name) GlFunction<PFNGL##type##PROC> name;
#include "rendering/gl/gl_functions.inl"
#undef FX_GL

    GlCallMonitor monitor;
};

} // namespace fx::render
