/// @file render_options.h
/// The arguments of fx render.
#pragma once

#include "foundation/result/status.h"
#include "fxsdk/cli/render/reference_options.h"
#include "fxsdk/cli/support/frame_range.h"
#include "fxsdk/cli/support/output_target.h"
#include "fxsdk/fxsdk.h"
#include "rendering/frame/view_types.h"

#include <glm/vec3.hpp>

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
    std::string frames; ///< range "A:B" of frames; empty: the default
    std::string quality = "high";
    std::string form;        ///< form of billboards; empty: the form that the quality implies
    std::string composition; ///< composition of media; empty: as in the scene
    std::string slabs;       ///< number of slabs; empty: as in the scene
    std::string voxels;      ///< number of voxels; empty: as in the scene
    std::string renderer = "gl";
    std::string statistics; ///< path of the statistics file; empty: none
    std::string times;      ///< times "A,B,..." [s] to render instead of frames; empty: none
    std::string compute; ///< processor of particles, "cpu", "gpu" or "auto"; empty: as each emitter specifies
    /// path of a scene file whose lights, sky and exposure are used; empty: the lights, sky and exposure of
    /// the input
    std::string lights;
    /// "off", or where a figure stands, "X,Y,Z" [m]; empty: as in the preset's preview
    std::string figure;
    std::string stage; ///< stage of a preset, of scene_file::stages(); empty: as in the preset's preview
    double framesPerSecond = 30.0;
    std::optional<double> time; ///< [s] time to render; empty: the time of the preset's preview, or 0.5 s
    std::optional<uint64_t> seed;
    std::optional<float> exposureEv100;
    std::string layerScale = "1";
    float lodBias = 0.0f;
    float impostorPixels = 0.0f;      ///< [pixel] FxViewSettings::lodImpostorPixels
    float blockParallax = 0.5f;       ///< [pixel] FxViewSettings::blockParallax
    float blockError = 4.0f / 255.0f; ///< [1] FxViewSettings::blockError
    uint32_t fragmentBudget = 0;      ///< FxViewSettings::fragmentBudget; 0: no limit
    std::string outputs;              ///< list of outputs, such as "id,motion,depth"; empty: none
    /// "off", or the number of planes of the sun's light slices; empty: as in the settings
    std::string lightSlices;
    int lightRefresh = 1; ///< [frame] interval between updates of light slices
    bool noDazzle = false;
    bool noShimmer = false;
    bool overdraw = false;
    bool overlay = false;
    bool json = false;
    ReferenceArguments reference;

    /// Whether statistics or lines of JSON state the times of frames.
    bool reportsTimes() const { return json || !statistics.empty(); }
};

/// Checked and converted arguments.
struct RenderPlan
{
    using Frame = NumberedFrame;

    OutputTarget output;
    int width = 0;  ///< [pixel]
    int height = 0; ///< [pixel]
    std::vector<Frame> frames;
    /// true if the only frame shows a default time, not a time from the command line
    bool hasDefaultTime = false;
    std::optional<glm::vec3> figure; ///< [m] where a figure stands instead of that of the preset's preview
    bool noFigure = false;           ///< true: no figure is shown
    bool isSheet = false; ///< true if all frames are arranged row by row in one file (contact sheet)
    double framesPerSecond = 30.0;
    int stepsPerSecond = 60; ///< [1/s] step rate of the simulation
    uint32_t simulationQuality = FX_QUALITY_DEFAULT;

    int sheetColumns() const; ///< number of columns for which the contact sheet is nearly square
    int sheetRows() const { return (int(frames.size()) + sheetColumns() - 1) / sheetColumns(); }
};

void addRenderOptions(CLI::App& command, RenderArguments& arguments);

/// Converts arguments to a plan, and checks conditions that CLI11 cannot check. @return InvalidArgument,
/// which is a usage error
base::Result<RenderPlan> planRender(const RenderArguments& arguments);

/// Prints a summary of the rendering, unless JSON is printed.
void printRendered(const RenderArguments& arguments, const RenderPlan& plan, const std::string& machine);

/// Applies the arguments to the settings of a scene. For EXR files, tone map, dazzle and shimmer are switched
/// off, so that the scene-linear picture equals the sum of its layers.
void applyArguments(const RenderArguments& arguments, OutputKind kind, render::ViewSettings& settings);

} // namespace fx::cli
