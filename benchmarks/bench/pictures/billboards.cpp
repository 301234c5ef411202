// fx bench billboards: the GPU's billboards against the reference renderer: 1, 10 and 270 blobs that stand
// alone, that overlap, and that overlap and are drawn front to back instead of back to front. Prints one JSON
// object a case and form: relative errors of the channels that are brighter than a thousandth of the
// brightest, and the least time of a frame (not of those in wrong order: a view sorts, so that each blob is
// drawn in a frame of its own there).
#include "benchmarks/accuracy/accuracy_technique.h"
#include "benchmarks/bench/bench_measurement.h"
#include "benchmarks/bench/bench_program.h"
#include "benchmarks/scenes/card_picture.h"
#include "fxsdk/cli/support/json_line.h"
#include "rendering/reference/render/reference_renderer.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>

namespace fx::cli {
namespace {

using Cards = std::vector<Card>;

constexpr float kField = 2.4f; ///< [m] that the width of the picture shows

struct Options
{
    int width = 480;
    int height = 300;
    int repeat = 5;
    bool isSmall = false;
};

/// RGB of each pixel, rows from the top.
std::vector<double> referencePicture(const base::FrameSnapshot& snapshot, const Options& options)
{
    render::ReferenceScene scene;
    scene.blobs = render::mediumOf({&snapshot, nullptr}, 1.0).blobs;
    scene.opaque.isEmpty = true;
    scene.camera.orthographic = true;
    scene.camera.halfHeight = 0.5 * double(kField) * options.height / options.width;
    scene.camera.nearDistance = 0.0;
    render::ReferenceSettings settings;
    settings.width = options.width;
    settings.height = options.height;
    settings.exposure = 1.0;
    settings.integral.scheme = render::highScheme();
    const auto tasks = base::makeTbbRunner();
    render::ReferenceRenderer renderer;
    if (!renderer.build(scene, settings, *tasks).ok() || !renderer.render(nullptr, {}).ok())
        fail("the reference renderer refuses the scene");
    std::vector<double> picture;
    for (size_t i = 0; i < renderer.pixels(0).size(); ++i)
        for (uint32_t c = 0; c < 3; ++c)
            picture.push_back(double(renderer.pixels(c)[i]));
    return picture;
}

/// As referencePicture() gives it.
std::vector<double> read(CardPicture& picture, const Options& options)
{
    const std::vector<float> texels = picture.read();
    const size_t row = size_t(options.width) * 3;
    std::vector<double> out;
    for (size_t y = size_t(options.height); y-- > 0;)
        out.insert(out.end(), texels.begin() + std::ptrdiff_t(y * row),
                   texels.begin() + std::ptrdiff_t((y + 1) * row));
    return out;
}

/// @return [ms]
double draw(CardPicture& picture, const base::FrameSnapshot& snapshot)
{
    double milliseconds = 0.0;
    if (const base::Status status = picture.draw(snapshot, &milliseconds); !status)
        fail(status.message());
    return milliseconds;
}

struct Case
{
    std::string name;
    Cards cards;
    bool isSortedWrong = false;
};

std::vector<Case> allCases()
{
    std::vector<Case> cases;
    for (const uint32_t count : {1u, 10u, 270u})
        cases.push_back({"isolated-" + std::to_string(count), isolatedCards(count)});
    for (const bool isWrong : {false, true})
        for (const uint32_t count : {10u, 270u})
            cases.push_back({(isWrong ? "sorted-wrong-" : "overlapping-") + std::to_string(count),
                             overlappingCards(count), isWrong});
    return cases;
}

/// @return [ms] least time of a frame, or 0 for those in wrong order
double drawCase(CardPicture& drawing, const Case& scene, int repeat)
{
    if (!scene.isSortedWrong) {
        double least = 1e30;
        for (int i = 0; i < repeat; ++i) { // each frame shows a new step, as that of a game does
            const base::FrameSnapshot snapshot = drawing.snapshotOf(scene.cards);
            drawing.clear();
            least = std::min(least, draw(drawing, snapshot));
        }
        return least;
    }
    Cards cards = scene.cards;
    std::stable_sort(cards.begin(), cards.end(), [](const Card& a, const Card& b) { return a.z < b.z; });
    drawing.clear();
    for (const Card& card : cards)
        draw(drawing, drawing.snapshotOf({&card, 1}));
    return 0.0;
}

AccuracySample errorsOf(const std::vector<double>& drawn, const std::vector<double>& reference)
{
    const double brightest = *std::max_element(reference.begin(), reference.end());
    std::vector<double> errors;
    for (size_t i = 0; i < reference.size(); ++i)
        if (reference[i] > 1e-3 * brightest)
            errors.push_back(drawn[i] / reference[i] - 1.0);
    AccuracySample sample;
    storeErrors(std::move(errors), sample);
    return sample;
}

void measure(Options options)
{
    if (options.isSmall)
        options.width = 240, options.height = 150, options.repeat = 1;
    const auto picture = taken(CardPicture::create(options.width, options.height, kField));
    CardPicture& drawing = *picture;
    Machine machine = readMachine();
    machine.glRenderer = drawing.renderer();
    constexpr std::pair<const char*, render::BillboardForm> kForms[] = {
        {"kernel", render::BillboardForm::Kernel},
        {"planar", render::BillboardForm::Planar},
        {"constant", render::BillboardForm::Constant}};
    bool asStated = true;
    for (const Case& scene : allCases()) {
        const std::vector<double> reference = referencePicture(drawing.snapshotOf(scene.cards), options);
        for (const auto& [form, value] : kForms) {
            drawing.settings().form = value;
            const double milliseconds = drawCase(drawing, scene, options.repeat);
            const AccuracySample sample = errorsOf(read(drawing, options), reference);
            nlohmann::json line = {{"name", "billboards_gl"},
                                   {"scene", scene.name},
                                   {"variant", form},
                                   {"blobs", scene.cards.size()},
                                   {"width", options.width},
                                   {"height", options.height},
                                   {"error_p50", sample.errorP50},
                                   {"error_p99", sample.errorP99},
                                   {"error_max", sample.errorMax},
                                   {"bias", sample.bias}};
            if (milliseconds > 0.0)
                line["ms_frame"] = milliseconds;
            printJsonLine(withMachine(line, machine));
            asStated = asStated && (value != render::BillboardForm::Kernel ||
                                    scene.name.rfind("isolated", 0) != 0 || sample.errorP99 < 1e-3);
        }
    }
    if (!asStated)
        fail("a blob that stands alone must be what the reference shows");
}

void addOptions(CLI::App& command, int& outExitCode)
{
    auto options = std::make_shared<Options>();
    addSizeOption(command, options->width, options->height);
    addRepeatOption(command, options->repeat);
    addSmallOption(command, options->isSmall);
    setMeasurement(command, outExitCode, [options] { measure(*options); });
}

} // namespace

BenchMeasurement billboardsBench()
{
    return {"billboards",
            "Errors of the GPU's billboards against the reference renderer, and the time of a frame",
            addOptions};
}

} // namespace fx::cli
