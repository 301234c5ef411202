/// @file gl_faults.h
/// A loader of OpenGL functions that lets one call fail, as if OpenGL had no memory or no working compiler.
#pragma once

#include "fxsdk/fx_context.h"
#include "rendering/gl/gl_functions.h"

#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace fx::test {

/// One loader exists at a time, since functions of OpenGL have no argument for it.
class GlFaults
{
public:
    explicit GlFaults(const render::GlLoader& real);
    ~GlFaults();
    GlFaults(const GlFaults&) = delete;
    GlFaults& operator=(const GlFaults&) = delete;

    FxGlLoader hooks() { return {this, &find}; }

    /// Counts calls that can fail from now on, and lets number `n` fail, counted from 1; 0: none fails.
    /// @param ofCompilers true: only compiling and linking can fail; false: only the other calls
    void failAt(uint64_t n, bool ofCompilers);
    /// Hides the function `name`; empty: none.
    void hide(std::string name) { hidden_ = std::move(name); }
    const std::string& failed() const { return failed_; } ///< name of the call that has failed; empty: none
    const std::set<std::string>& asked() const { return asked_; } ///< all functions that were looked up

private:
    static void* find(void* user, const char* name);

    friend struct FaultyGl;
    bool fails(const char* name, bool isOfCompiler = false);

    render::GlLoader real_;
    std::set<std::string> asked_;
    std::string hidden_;
    std::string failed_;
    uint64_t calls_ = 0;
    uint64_t failing_ = 0;
    bool ofCompilers_ = false;
    GLenum error_ = GL_NO_ERROR;     ///< what the next glGetError returns
    std::set<GLuint> withoutMemory_; ///< buffers whose storage has failed
};

} // namespace fx::test
