/// @file host_report.h
/// Measures an example host and prints one line of JSON. A game does not need this file.
///
/// Threads: the GL thread.
#ifndef HOST_REPORT_H
#define HOST_REPORT_H

#include "host_effects.h"
#include "host_options.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A loader that counts the calls of OpenGL before it passes them on. `real` must outlive the effects.
FxGlLoader hostCountCalls(const FxGlLoader* real);

/// Stand before and after fxView_Render(): read GL state and counters while hostReport() measures, and do
/// nothing otherwise.
void hostBeforeEffects(void);
void hostAfterEffects(const FxFrameDef* frame);

typedef struct HostReport
{
    const char* name;         ///< of the host
    const char* targetFormat; ///< GL format that effects are drawn into, and its encoding
    const char* depth;        ///< GL format and convention of depth
    int samples;              ///< of a pixel

    /// Draws a frame as the host always does, up to its picture for the display, without advancing time.
    /// @return 1; 0 after a failure
    int (*draw)(void* host, int withEffects);
    void* host;

    /// Framebuffer of one sample that holds the effects' target, or its resolved samples, after a frame.
    unsigned targetFramebuffer;

    /// Framebuffer of 8 bits that holds the picture for the display after a frame; 0: the window.
    unsigned displayFramebuffer;

    /// 1: the target of the effects stores the picture upside down; 0: from its lower left corner.
    int isMirrored;
} HostReport;

/// Writes the display's picture to options->output, measures and prints. The GL state afterwards is that of
/// the view with saveState = 0.
/// @return 1; 0 after printing what failed
int hostReport(const HostReport* report, const HostOptions* options, HostEffects* effects);

#ifdef __cplusplus
}
#endif

#endif
