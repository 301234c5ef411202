/// @file render_options.h
/// The arguments of fx render.
#pragma once

#include "foundation/result/status.h"
#include "foundation/time/ticks.h"
#include "fxsdk/cli/render/reference_options.h"
#include "fxsdk/cli/support/output_target.h"
#include "fxsdk/fxsdk.h"
#include "rendering/frame/view_types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace fx::cli {

/// Arguments as they are written on the command line.
struct RenderArguments
{
    std::string input;
    std::string output;
    std::string size = "1280x720";
    std::string frames; ///< "A:B", empty for the default
    std::string quality = "high";
    std::string form;        ///< empty: the form that the quality implies
    std::string composition; ///< empty: as the scene states
    std::string slabs;       ///< empty: as the scene states
    std::string voxels;      ///< empty: as the scene states
    std::string renderer = "gl";
    std::string statistics; ///< file, empty for none
    std::string times;      ///< "A,B,..." [s] instead of frames; empty: none
    std::string compute;    ///< empty: as each emitter states
    std::string lights;     ///< scene file whose lights, sky and exposure are used; empty: those of the input
    double framesPerSecond = 30.0;
    std::optional<double> time; ///< [s] empty: the time of the preset's preview, or 0.5 s
    std::optional<uint64_t> seed;
    std::optional<float> exposureEv100;
    std::string layerScale = "1";
    float lodBias = 0.0f;
    float impostorPixels = 0.0f; ///< [pixel]
    uint32_t fragmentBudget = 0; ///< 0: none
    std::string outputs;         ///< part of "id,motion,depth"; empty: none
    std::string lightSlices;     ///< "off" or the number of planes of the sun; empty: that of the settings
    int lightRefresh = 1;        ///< [frame] interval between updates of light
    bool noDazzle = false;
    bool noShimmer = false;
    bool overdraw = false;
    bool overlay = false;
    bool json = false;
    ReferenceArguments reference;
};

/// Plan of the rendering that the arguments give after checking.
struct RenderPlan
{
    struct Frame
    {
        int64_t number = 0; ///< number in file names
        base::Ticks tick = 0;
    };

    OutputTarget output;
    int width = 0;  ///< [pixel]
    int height = 0; ///< [pixel]
    std::vector<Frame> frames;
    bool hasDefaultTime = false; ///< the only frame shows a time that the command line does not name
    bool isSheet = false;        ///< the frames are arranged row by row as a contact sheet in one file
    double framesPerSecond = 30.0;
    int stepsPerSecond = 60; ///< step rate of the simulation
    uint32_t simulationQuality = FX_QUALITY_DEFAULT;

    int sheetColumns() const; ///< as near to a square as they come
    int sheetRows() const { return (int(frames.size()) + sheetColumns() - 1) / sheetColumns(); }
};

void addRenderOptions(CLI::App& command, RenderArguments& arguments);

/// Converts arguments to a plan and checks what CLI11 cannot check. @return InvalidArgument, which is a usage
/// error
base::Result<RenderPlan> planRender(const RenderArguments& arguments);

/// Prints a summary of the rendering, unless JSON is printed.
void printRendered(const RenderArguments& arguments, const RenderPlan& plan, const std::string& machine);

/// Applies the arguments to the settings of a scene. For EXR files, tone map, dazzle and shimmer are switched
/// off, so that the scene-linear picture equals the sum of its layers.
void applyArguments(const RenderArguments& arguments, OutputKind kind, render::ViewSettings& settings);

} // namespace fx::cli
