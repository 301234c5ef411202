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

/// As written on the command line.
struct RenderArguments
{
    std::string input;
    std::string output;
    std::string size = "1280x720";
    std::string frames; ///< "A:B", empty for the default
    std::string quality = "high";
    std::string form;        ///< empty: that of the quality
    std::string composition; ///< empty: the scene's
    std::string slabs;       ///< empty: the scene's
    std::string voxels;      ///< empty: the scene's
    std::string renderer = "gl";
    std::string statistics; ///< file, empty for none
    std::string times;      ///< "A,B,..." [s] instead of frames; empty: none
    std::string compute;    ///< empty: that of each emitter
    std::string lights;     ///< a scene file whose lights, sky and exposure are used; empty: the scene's own
    double framesPerSecond = 30.0;
    std::optional<double> time; ///< [s] none: the preset's preview's, or half a second
    std::optional<uint64_t> seed;
    std::optional<float> exposureEv100;
    std::string layerScale = "1";
    float lodBias = 0.0f;
    float impostorPixels = 0.0f; ///< [pixel]
    uint32_t fragmentBudget = 0; ///< 0: none
    std::string outputs;         ///< "id,motion,depth" or some of them; empty: none
    std::string lightSlices;     ///< "off" or the number of planes of the sun; empty: that of the settings
    int lightRefresh = 1;        ///< [frame]
    bool noDazzle = false;
    bool noShimmer = false;
    bool overdraw = false;
    bool overlay = false;
    bool json = false;
    ReferenceArguments reference;
};

/// Checked and understood.
struct RenderPlan
{
    struct Frame
    {
        int64_t number = 0; ///< in file names
        base::Ticks tick = 0;
    };

    OutputTarget output;
    int width = 0;  ///< [pixel]
    int height = 0; ///< [pixel]
    std::vector<Frame> frames;
    bool hasDefaultTime = false; ///< the only frame shows a time that the command line does not name
    bool isSheet = false;        ///< the frames are the pictures of one file, row by row
    double framesPerSecond = 30.0;
    int stepsPerSecond = 60; ///< of the simulation
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

/// Applies the arguments to the settings of a scene. EXR files hold the scene-linear picture that their
/// layers add up to: no tone map, no dazzle, no shimmer.
void applyArguments(const RenderArguments& arguments, OutputKind kind, render::ViewSettings& settings);

} // namespace fx::cli
