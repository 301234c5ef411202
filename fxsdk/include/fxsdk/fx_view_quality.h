/// @file fx_view_quality.h
/// Results of the frame budget of a view (FxViewSettings::budgetMilliseconds), and the calibration of the
/// budget. fx_view.h includes this header.
///
/// Threads: [GL thread] for all functions. Ownership: the library copies all arguments.
#ifndef FXSDK_FX_VIEW_QUALITY_H
#define FXSDK_FX_VIEW_QUALITY_H

#include "fxsdk/fx_base.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Values of FxQualityReport::timing.
enum
{
    FX_TIMING_OFF = 0,        ///< no budget is set
    FX_TIMING_GPU = 1,        ///< FX_BUDGET_CLOCK_GPU
    FX_TIMING_CPU = 2,        ///< FX_BUDGET_CLOCK_CPU
    FX_TIMING_UNAVAILABLE = 3 ///< this OpenGL has no timestamps; the settings are used unchanged
};

/// Result of the frame budget. Fill structSize with sizeof before the call.
typedef struct FxQualityReport
{
    uint32_t structSize;         ///< set by the caller
    uint32_t timing;             ///< FX_TIMING_...; with OFF and UNAVAILABLE the other members are 0
    float budgetMilliseconds;    ///< [ms] the budget in use
    uint32_t hasMeasured;        ///< 1: measuredMilliseconds is known; 0: no frame has finished yet
    float measuredMilliseconds;  ///< [ms] time of the last frame whose measurement is available
    float predictedMilliseconds; ///< [ms] expected time of the last frame
    float estimatedError; ///< [1] mean error of the picture's light, compared with the highest settings
    uint32_t saturated;   ///< 1: even the lowest settings are expected to exceed the budget
    uint32_t held;        ///< 1: FxFrameDef::holdQuality was set for the last frame
    uint32_t techniques;  ///< number of techniques for fxView_GetQualityChoice()
    uint64_t switches;    ///< number of frames that changed a setting, since the calibration was set
} FxQualityReport;

/// Quality of one technique in the last frame. Fill structSize with sizeof before the call.
typedef struct FxQualityChoice
{
    uint32_t structSize; ///< set by the caller
    uint32_t step;       ///< scalability level in use, 0..steps - 1, cheapest first
    uint32_t steps;      ///< number of scalability levels of the technique
    float cost;          ///< [1] cost of the level relative to the cost of the highest level
    float error;         ///< [1] error of the level's picture relative to the picture of the highest level
    float weight;        ///< [1] 0..1, approximate fraction of the picture that the technique covers
    float predictedMilliseconds; ///< [ms] expected time of the level in this scene
    uint32_t reserved;           ///< 0
    char technique[32];          ///< "media", "shimmer", "dazzle", or "other" for passes without settings
    char setting[96];            ///< text for display, such as "particles 0.5, kernel, detail on"
} FxQualityChoice;

/// Replaces the calibration of the view. The calibration is a table of costs and errors, in the text format
/// that `fx calibrate` writes. By default, views with a budget use a built-in calibration. The cost model is
/// reset. [GL thread]
/// @param text        UTF-8, need not be zero-terminated; read during the call only; null: the built-in
///         calibration
/// @param length      [byte] length of the text, 1 byte to 64 KiB; 0 if text is null
/// @param displayName used as the file's name in messages; may be null
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_TOO_LARGE, FX_ERROR_PARSE, FX_ERROR_SCHEMA,
///         FX_ERROR_VERSION (the message names line, position and remedy; nothing has changed),
///         FX_ERROR_WRONG_THREAD, FX_ERROR_RE_ENTRANT, FX_ERROR_OUT_OF_MEMORY
FX_API FxResult fxView_SetQualityCalibration(FxView* view, const char* text, size_t length,
                                             const char* displayName);

/// Reads the result of the frame budget in the last frame. [GL thread]
/// @param ioReport structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetQualityReport(FxView* view, FxQualityReport* ioReport);

/// Reads the quality of one technique in the last frame. [GL thread]
/// @param index    0..FxQualityReport::techniques - 1
/// @param ioChoice structSize must be set; other members are overwritten on success, untouched on failure
/// @return FX_OK, FX_ERROR_INVALID_ARGUMENT, FX_ERROR_VERSION (structSize), FX_ERROR_WRONG_THREAD,
///         FX_ERROR_RE_ENTRANT
FX_API FxResult fxView_GetQualityChoice(FxView* view, uint32_t index, FxQualityChoice* ioChoice);

#ifdef __cplusplus
}
#endif

#endif
