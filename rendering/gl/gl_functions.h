/// @file gl_functions.h
/// The OpenGL functions of one context. The host's loader loads the functions, and their calls are counted.
/// The library does not link to an OpenGL library.
///
/// Members have the names of the functions without "gl": gl.DrawArraysInstanced(...). A hook is called
/// before every GL call, and can suppress the call. Tests use the hook to inject faults. When the context is
/// lost, the table calls OpenGL no more, so that owners of GL objects forget their names without deleting
/// them.
#pragma once

#include "foundation/result/status.h"

#include <GL/glcorearb.h>

#include <cstdint>
#include <functional>

namespace fx::render {

/// The host's loader. The loader returns a function of the current context by its name ("glDrawArrays"), or
/// null if the function does not exist.
struct GlLoader
{
    void* user = nullptr;
    void* (*getProcAddress)(void* user, const char* name) = nullptr;
};

/// State shared by all functions of one table.
struct GlCallMonitor
{
    uint64_t calls = 0;
    /// True: the context of the table is lost. No function is called any more; all return zero and change no
    /// output.
    bool isLost = false;
    /// Called before each GL function, with the name of the function including "gl". If the hook returns
    /// false, the GL call is suppressed and returns zero. Only tests set a hook.
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
        if (monitor_->isLost) [[unlikely]]
            return R();
        ++monitor_->calls;
        if (monitor_->hook && !monitor_->hook(name_)) [[unlikely]]
            return R();
        return pointer_(arguments...);
    }

    /// Loads the function.
    /// @return false if the loader does not find the function
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

/// The table of functions. It must be neither copied nor moved, because its members point to `monitor`.
struct GlFunctions
{
    GlFunctions() = default;
    GlFunctions(const GlFunctions&) = delete;
    GlFunctions& operator=(const GlFunctions&) = delete;

    /// Loads all functions.
    /// @return GlUnsupported with all missing functions in the message; then the table must not be used
    base::Status load(const GlLoader& loader);

#define FX_GL(type, name) GlFunction<PFNGL##type##PROC> name;
#include "rendering/gl/gl_functions.inl"
#undef FX_GL

    GlCallMonitor monitor;
};

} // namespace fx::render
