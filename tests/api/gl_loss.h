/// @file gl_loss.h
/// A loader of OpenGL functions whose context is lost at one call: from then on no function does anything,
/// all return zero, and glGetError returns GL_CONTEXT_LOST, as KHR_robustness states.
#pragma once

#include "fxsdk/fx_context.h"
#include "rendering/gl/gl_functions.h"

#include <cstdint>
#include <string>

namespace fx::test {

/// One loader exists at a time, since functions of OpenGL have no argument for it.
class GlLoss
{
public:
    explicit GlLoss(const render::GlLoader& real);
    ~GlLoss();
    GlLoss(const GlLoss&) = delete;
    GlLoss& operator=(const GlLoss&) = delete;

    FxGlLoader hooks() { return {this, &find}; }

    /// Counts calls from now on, in a context that is not lost, and loses the context at call number `n`,
    /// counted from 1; 0: never.
    void loseAt(uint64_t n);
    /// Whether the context states that it reports resets. Read when the context is created or restored.
    void setReportsReset(bool reports) { reportsReset_ = reports; }

    bool isLost() const { return isLost_; }
    const std::string& lostIn() const { return lostIn_; } ///< name of the function that was called first
    uint64_t calls() const { return calls_; }             ///< number of all calls since loseAt()
    uint64_t polls() const { return polls_; }             ///< number of those of glGetGraphicsResetStatus

private:
    static void* find(void* user, const char* name);

    friend struct LosingGl;
    bool loses(const char* name);

    render::GlLoader real_;
    std::string lostIn_;
    uint64_t calls_ = 0, polls_ = 0;
    uint64_t losing_ = 0;
    bool isLost_ = false;
    bool reportsReset_ = false;
};

} // namespace fx::test
